//! True traces: the solver's answers as they appear in a trace, number by number.

use std::fmt::Display;

use stiction_core::{Fixed, Full, Hand, Output, Real, SiFloat, Solver, State, narrow_hand};
use stiction_judge::{Bounds, Contact, Evolution, Frame, Scene};
use stiction_scene::{Among, HostModel, HostSolver, Indices, Motion, SceneFile, Source};

/// A number type of the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Number {
    Double,
    Single,
    Fixed,
}

impl Number {
    pub(crate) const ALL: [Self; 3] = [Self::Double, Self::Single, Self::Fixed];

    pub(crate) const fn bounds(self) -> Bounds {
        match self {
            Self::Double => Bounds::DOUBLE,
            Self::Single | Self::Fixed => Bounds::SINGLE,
        }
    }
}

pub(crate) const EVOLUTIONS: [Evolution; 2] = [Evolution::Path, Evolution::Frame];

/// A true trace, and its origin.
#[derive(Clone, Debug)]
pub(crate) struct Truth {
    pub(crate) name: String,
    pub(crate) number: Number,
    pub(crate) evolution: Evolution,
    pub(crate) scene: Scene,
    pub(crate) frames: Vec<Frame>,
}

/// The solver's answers to the hand of a scene file.
pub(crate) fn truth(name: &str, text: &str, number: Number, evolution: Evolution) -> Truth {
    let file = SceneFile::parse(Source::new(name, text), f64::from(f32::MAX)).expect("a scene");
    let frames = match number {
        Number::Double => of_number::<f64>(&file, evolution),
        Number::Single => of_number::<f32>(&file, evolution),
        Number::Fixed => of_number::<Fixed>(&file, evolution),
    };
    Truth {
        name: name.to_owned(),
        number,
        evolution,
        scene: Scene::parse(Source::new(name, text)).expect("a scene"),
        frames,
    }
}

fn of_number<R: Real<Si: SiFloat + Display>>(file: &SceneFile, evolution: Evolution) -> Vec<Frame> {
    if file.obstacles.is_empty() {
        of_model::<R, Full>(file, evolution)
    } else {
        of_model::<R, Among>(file, evolution)
    }
}

fn of_model<R: Real<Si: SiFloat + Display>, M: HostModel>(
    file: &SceneFile,
    evolution: Evolution,
) -> Vec<Frame> {
    let (scene, indices) = M::scene::<R>(file).expect("a scene");
    let solver: HostSolver<R, M> = Solver::new(scene, evolution);
    let Some(Motion::Keyframes(path)) = &file.hand.motion else {
        panic!("a scene with keyframes");
    };
    let mut state: Option<State<R>> = None;
    let frame = |sample: stiction_scene::Sample| {
        let hand: Hand<R::Si> = narrow_hand(&sample.hand);
        let output = match &mut state {
            Some(state) => solver.step(state, hand),
            None => {
                let (started, output) = solver.start(hand);
                state = Some(started);
                output
            }
        };
        printed_frame::<R, M>(
            sample.t,
            (&solver, state.as_ref().expect("one"), &output),
            indices.as_ref(),
        )
    };
    path.frames(file.hand.rate).map(frame).collect()
}

/// A number as read back from a trace.
fn printed(x: impl Display) -> f64 {
    x.to_string().parse().expect("a number")
}

fn printed_frame<R: Real<Si: SiFloat + Display>, M: HostModel>(
    t: f64,
    (solver, state, output): (&HostSolver<R, M>, &State<R>, &Output<R::Si>),
    indices: Option<&Indices>,
) -> Frame {
    let placed = |[x, y]: [R::Si; 2], angle: R::Si| [printed(x), printed(y), printed(angle)];
    let touches = M::touches(solver, state);
    let contact = |(k, contact): (usize, &stiction_core::Contact<R::Si>)| {
        let touching = touches.as_ref().and_then(|all| all.get(k).copied());
        let of_surface = stiction_core::Touch::Surface {
            vertex: contact.vertex,
            surface: contact.surface,
        };
        let touch = touching.map_or(of_surface, |touching| touching.touch);
        Contact {
            touch: indices.map_or(touch, |indices| indices.touch(touch)),
            point: contact.point.map(printed),
            direction: touching.map(|touching| touching.direction.map(printed)),
            normal: printed(contact.normal),
            friction: printed(contact.friction),
            sliding: Some(contact.sliding),
        }
    };
    let (hand, wrench) = (state.hand(), solver.wrench(state));
    Frame {
        t,
        hand: placed(hand.position, hand.angle.radians()),
        held: output.held,
        pose: placed(output.position, output.angle.radians()),
        depth: printed(output.depth),
        state: output.state,
        contacts: (solver.contacts(state).iter().enumerate())
            .map(contact)
            .collect(),
        complete: true,
        wrench: placed(wrench.force, wrench.moment),
        slips: output.slips,
        events: output.events().to_vec(),
        status: output.status,
        behind: None,
    }
}
