//! The compared engines: an engine takes the hand's pose once per frame and returns the body's pose. This file contains
//! the trait, and its implementation for this repository's solver.

use std::hint::black_box;

use stiction_core::{Evolution, Hand, State, narrow_hand};
use stiction_scene::{HostSolver, Sample};

use crate::case::{Case, Pose};

/// An engine with a case set up.
pub(crate) trait Engine {
    /// The hand's pose in the engine's own numbers.
    type Hand: Copy;
    fn name() -> String;
    /// The case before its first frame.
    fn new(case: &Case) -> Self;
    /// From the path's numbers to the engine's.
    fn hand(sample: &Sample) -> Self::Hand;
    fn step(&mut self, hand: Self::Hand);
    fn pose(&self) -> Pose;
}

/// This repository's solver as the program runs it: f32, exact events between the frames.
pub(crate) struct Stiction {
    solver: HostSolver<f32>,
    state: State<f32>,
    pose: [f32; 3],
}

impl Engine for Stiction {
    type Hand = Hand<f32>;

    fn name() -> String {
        format!("stiction {}", env!("CARGO_PKG_VERSION"))
    }

    fn new(case: &Case) -> Self {
        let scene = case.scene.scene().expect("a bundled scene is sound");
        let solver = HostSolver::new(scene, Evolution::Path);
        let (state, _) = solver.start(Self::hand(case.first()));
        Self {
            solver,
            state,
            pose: case.scene.start.map(|x| x as f32),
        }
    }

    fn hand(sample: &Sample) -> Hand<f32> {
        narrow_hand(&sample.hand)
    }

    /// With the forces, which the other engine has after a step as well.
    fn step(&mut self, hand: Hand<f32>) {
        let output = self.solver.step(&mut self.state, hand);
        black_box(self.solver.wrench(&self.state));
        black_box(self.solver.contacts(&self.state));
        let [x, y] = output.position;
        self.pose = [x, y, output.angle.radians()];
    }

    fn pose(&self) -> Pose {
        self.pose.map(f64::from)
    }
}
