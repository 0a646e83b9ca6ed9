//! True traces: the solver's answers as they appear in a trace, number by number.

use std::fmt::Display;

use stiction_core::{Fixed, Hand, Output, Real, SiFloat, Solver, State, narrow_hand};
use stiction_judge::{Bounds, Contact, Evolution, Frame, Scene};
use stiction_scene::{HostSolver, Indices, Motion, SceneFile, Source};

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
    let (scene, indices) = file.written.scene_in().expect("a scene");
    let solver: HostSolver<R> = Solver::new(scene, evolution);
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
        printed_frame::<R>(
            sample.t,
            (&solver, state.as_ref().expect("one"), &output),
            (indices.as_ref(), !file.obstacles.is_empty()),
        )
    };
    path.frames(file.hand.rate).map(frame).collect()
}

/// A number as read back from a trace.
fn printed(x: impl Display) -> f64 {
    x.to_string().parse().expect("a number")
}

fn printed_frame<R: Real<Si: SiFloat + Display>>(
    t: f64,
    (solver, state, output): (&HostSolver<R>, &State<R>, &Output<R::Si>),
    (indices, has_obstacles): (Option<&Indices>, bool),
) -> Frame {
    let placed = |[x, y]: [R::Si; 2], angle: R::Si| [printed(x), printed(y), printed(angle)];
    let contact = |contact: &stiction_core::Contact<R::Si>| Contact {
        touch: indices.map_or(contact.touch, |indices| indices.touch(contact.touch)),
        point: contact.point.map(printed),
        direction: has_obstacles.then(|| contact.direction.map(printed)),
        normal: printed(contact.normal),
        friction: printed(contact.friction),
        sliding: Some(contact.sliding),
    };
    let (hand, wrench) = (state.hand(), solver.wrench(state));
    Frame {
        t,
        hand: placed(hand.position, hand.angle.radians()),
        held: output.held,
        pose: placed(output.position, output.angle.radians()),
        depth: printed(output.depth),
        state: output.state,
        contacts: solver.contacts(state).iter().map(contact).collect(),
        complete: true,
        wrench: placed(wrench.force, wrench.moment),
        slips: output.slips,
        events: output.events().to_vec(),
        status: output.status,
        behind: None,
    }
}
