//! The core as it is: among half-planes with the model that it has for them, otherwise with the one for obstacles.

use crate::subject::{Digits, Made, Solver, Subject};
use stiction_core::{Evolution, Fixed, Full, Hand, Solver as Core, State};
use stiction_judge::Frame;
use stiction_tests::Number;
use stiction_tests::laws::judged;
use stiction_tests::obstacles::scene::{SURFACES, Scene, VERTICES};
use stiction_tests::obstacles::{Among, Run};
use stiction_tests::run::{self, planar};

/// The core in its number types and evolutions.
pub const OLD: [Solver; 6] = [
    Solver::new("old-f64", Digits::F64, path::<f64>),
    Solver::new("old-f32", Digits::F32, path::<f32>),
    Solver::new("old-fixed", Digits::Fixed, path::<Fixed>),
    Solver::new("old-f64-frame", Digits::F64, frame::<f64>),
    Solver::new("old-f32-frame", Digits::F32, frame::<f32>),
    Solver::new("old-fixed-frame", Digits::Fixed, frame::<Fixed>),
];

fn path<R: Number + 'static>(among: &Among) -> Made {
    made::<R>(among, Evolution::Path)
}

fn frame<R: Number + 'static>(among: &Among) -> Made {
    made::<R>(among, Evolution::Frame)
}

fn made<R: Number + 'static>(among: &Among, evolution: Evolution) -> Made {
    if among.obstacles.is_empty() {
        let scene = among.setup.scene_of::<R, VERTICES, SURFACES, Full>();
        let solver = Core::new(scene.map_err(|error| error.to_string())?, evolution);
        let state = solver
            .start(Hand::new(R::si(0.0), R::si(0.0), R::si(0.0)))
            .0;
        return Ok(Box::new(Planes { solver, state }));
    }
    let scene = among.within::<R>().scene::<R>();
    Ok(Box::new(Obstacles {
        scene: scene.map_err(|error| error.to_string())?,
        evolution,
        run: None,
    }))
}

struct Planes<R: Number> {
    solver: Core<R, VERTICES, SURFACES, Full>,
    state: State<R>,
}

impl<R: Number> Subject for Planes<R> {
    fn start(&mut self, hand: [f64; 3]) -> Frame {
        let (state, output) = self.solver.start(planar::<R>(hand));
        self.state = state;
        judged(0, &run::Frame::new(&self.solver, &self.state, &output))
    }

    fn step(&mut self, hand: [f64; 3]) -> Frame {
        let output = self.solver.step(&mut self.state, planar::<R>(hand));
        judged(0, &run::Frame::new(&self.solver, &self.state, &output))
    }
}

struct Obstacles<R: Number> {
    scene: Scene<R>,
    evolution: Evolution,
    run: Option<Run<R>>,
}

impl<R: Number> Subject for Obstacles<R> {
    fn start(&mut self, hand: [f64; 3]) -> Frame {
        let run = Run::of(self.scene.clone(), self.evolution, planar::<R>(hand));
        self.run.insert(run).frame.clone()
    }

    fn step(&mut self, hand: [f64; 3]) -> Frame {
        match &mut self.run {
            Some(run) => run.step(hand).clone(),
            None => self.start(hand),
        }
    }
}
