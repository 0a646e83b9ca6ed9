//! The uniform statics: contacts on half-planes so far.

use crate::subject::{Digits, Made, Solver, Subject};
use stiction_core::Fixed;
use stiction_judge::{Contact, Frame};
use stiction_statics::{Output, Solver as Core, State};
use stiction_tests::obstacles::Among;
use stiction_tests::obstacles::scene::{SURFACES, VERTICES};
use stiction_tests::run::planar;
use stiction_tests::{Number, Setup};

/// The uniform statics in its number types.
pub const STATICS: [Solver; 3] = [
    Solver::new("new-f64", Digits::F64, made::<f64>),
    Solver::new("new-f32", Digits::F32, made::<f32>),
    Solver::new("new-fixed", Digits::Fixed, made::<Fixed>),
];

fn made<R: Number + 'static>(among: &Among) -> Made {
    if !among.obstacles.is_empty() {
        return Err("obstacles".to_owned());
    }
    let solver = among.setup.described::<R, _>(|scene| Core::new(scene));
    Ok(Box::new(Run::<R> {
        solver: solver.map_err(|error| error.to_string())?,
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
        let contact = |c: &stiction_core::Contact<R::Si>| Contact {
            touch: c.touch,
            point: match c.touch.vertex() {
                Some(vertex) => self.setup.world(pose, self.setup.vertices[vertex]),
                None => c.point.map(wide),
            },
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
            held: true,
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
