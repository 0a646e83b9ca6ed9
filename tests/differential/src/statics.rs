//! The uniform statics: contacts on half-planes so far.

use crate::subject::{Digits, Made, Solver, Subject};
use stiction_core::{Evolution, Fixed};
use stiction_judge::{Contact, Frame, Touch};
use stiction_statics::{Output, Solver as Core, State};
use stiction_tests::obstacles::Among;
use stiction_tests::obstacles::scene::{SURFACES, VERTICES};
use stiction_tests::run::planar;
use stiction_tests::{Number, Setup};

/// The uniform statics in its number types.
pub const STATICS: [Solver; 6] = [
    Solver::new("new-f64", Digits::F64, path::<f64>),
    Solver::new("new-f32", Digits::F32, path::<f32>),
    Solver::new("new-fixed", Digits::Fixed, path::<Fixed>),
    Solver::new("new-f64-frame", Digits::F64, frame::<f64>),
    Solver::new("new-f32-frame", Digits::F32, frame::<f32>),
    Solver::new("new-fixed-frame", Digits::Fixed, frame::<Fixed>),
];

fn path<R: Number + 'static>(among: &Among) -> Made {
    made::<R>(among, Evolution::Path)
}

fn frame<R: Number + 'static>(among: &Among) -> Made {
    made::<R>(among, Evolution::Frame)
}

fn made<R: Number + 'static>(among: &Among, evolution: Evolution) -> Made {
    if !among.obstacles.is_empty() {
        return Err("obstacles".to_owned());
    }
    let solver = among.setup.described::<R, _>(|scene| Core::new(scene));
    Ok(Box::new(Run::<R> {
        solver: solver
            .map_err(|error| error.to_string())?
            .with_evolution(evolution),
        state: None,
        setup: among.setup.clone(),
    }))
}

struct Run<R: Number> {
    solver: Core<R, VERTICES, SURFACES, 0>,
    state: Option<State<R>>,
    setup: Setup,
}

impl<R: Number> Run<R> {
    fn frame(&self, state: &State<R>, output: &Output<R::Si>, hand: [f64; 3]) -> Frame {
        let wide = R::wide;
        let [x, y] = output.position;
        let pose = [wide(x), wide(y), R::wide_angle(output.angle)];
        let contacts = self.solver.contacts(state);
        let at = |touch: Touch, point: [R::Si; 2]| match touch.vertex() {
            Some(vertex) => self.setup.world(pose, self.setup.vertices[vertex]),
            None => point.map(wide),
        };
        let contact = |c: &stiction_core::Contact<R::Si>| Contact {
            touch: c.touch,
            point: at(c.touch, c.point),
            direction: None,
            normal: wide(c.normal),
            friction: wide(c.friction),
            sliding: Some(c.sliding),
        };
        let wrench = self.solver.wrench(state);
        let [fx, fy] = wrench.force;
        Frame {
            t: 0.0,
            hand: hand.map(R::rounded),
            held: output.held,
            pose,
            depth: 0.0,
            state: output.state,
            contacts: contacts.iter().map(contact).collect(),
            complete: true,
            wrench: [wide(fx), wide(fy), wide(wrench.moment)],
            slips: output.slips,
            events: output.events().to_vec(),
            status: output.status,
            behind: None,
        }
    }
}

impl<R: Number> Subject for Run<R> {
    fn start(&mut self, hand: [f64; 3]) -> Frame {
        let (state, output) = self.solver.start(planar::<R>(hand));
        let frame = self.frame(&state, &output, hand);
        self.state = Some(state);
        frame
    }

    fn step(&mut self, hand: [f64; 3]) -> Frame {
        let Some(mut state) = self.state.take() else {
            return self.start(hand);
        };
        let output = self.solver.step(&mut state, planar::<R>(hand));
        let frame = self.frame(&state, &output, hand);
        self.state = Some(state);
        frame
    }
}
