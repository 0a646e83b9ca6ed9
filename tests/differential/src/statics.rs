//! The uniform statics: without corners among half-planes, with them among obstacles.

use crate::subject::{Digits, Made, Solver, Subject};
use stiction_core::{Evolution, Fixed};
use stiction_judge::{Contact, Frame};
use stiction_statics::{Output, Solver as Core, State};
use stiction_tests::Number;
use stiction_tests::obstacles::Among;
use stiction_tests::obstacles::scene::{CORNERS, SURFACES, VERTICES};
use stiction_tests::run::planar;

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
    if among.obstacles.is_empty() {
        let solver = among.setup.described::<R, _>(|scene| Core::new(scene));
        return run::<R, 0>(solver.map_err(|error| error.to_string())?, evolution);
    }
    let solver = among
        .within::<R>()
        .described::<R, _>(|scene| Core::new(scene));
    run::<R, CORNERS>(solver.map_err(|error| error.to_string())?, evolution)
}

fn run<R: Number + 'static, const C: usize>(
    solver: Core<R, VERTICES, SURFACES, C>,
    evolution: Evolution,
) -> Made {
    Ok(Box::new(Run {
        solver: solver.with_evolution(evolution),
        state: None,
    }))
}

struct Run<R: Number, const C: usize> {
    solver: Core<R, VERTICES, SURFACES, C>,
    state: Option<State<R>>,
}

impl<R: Number, const C: usize> Run<R, C> {
    fn frame(&self, state: &State<R>, output: &Output<R::Si>, hand: [f64; 3]) -> Frame {
        let wide = R::wide;
        let [x, y] = output.position;
        let pose = [wide(x), wide(y), R::wide_angle(output.angle)];
        let contact = |c: &stiction_core::Contact<R::Si>| Contact {
            touch: c.touch,
            point: c.point.map(wide),
            direction: Some(c.direction.map(wide)),
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
            contacts: self.solver.contacts(state).iter().map(contact).collect(),
            complete: true,
            wrench: [wide(fx), wide(fy), wide(wrench.moment)],
            slips: output.slips,
            events: output.events().to_vec(),
            status: output.status,
            behind: None,
        }
    }
}

impl<R: Number, const C: usize> Subject for Run<R, C> {
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
