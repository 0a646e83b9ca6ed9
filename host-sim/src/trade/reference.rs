//! The reference of every setting of a memory length: f64 with path evolution at the finest rate, and its answer at any instant
//! between two of its frames.

use stiction_core::{Evolution, Output, Solver, State, StateKind, narrow_hand};
use stiction_scene::{HostSolver, InputError, Sample};

use super::setting::FINEST;
use super::suite::Case;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Truth {
    /// x, y (m), theta (rad)
    pub(super) pose: [f64; 3],
    pub(super) state: StateKind,
    /// Slips since the start.
    pub(super) slips: u64,
}

impl Truth {
    /// Adds the number of earlier slips.
    fn of(output: &Output<f64>, slips: u64) -> Self {
        let [x, y] = output.position;
        Self {
            pose: [x, y, output.angle.radians()],
            state: output.state,
            slips: slips + u64::from(output.slips),
        }
    }
}

pub(super) struct Reference {
    solver: HostSolver<f64>,
    frames: Vec<(f64, State<f64>, Truth)>,
}

impl Reference {
    /// Two instants that differ by less than this (s) are the same.
    const INSTANT: f64 = 1e-6 / FINEST;

    pub(super) fn new(case: &Case) -> Result<Self, InputError> {
        let solver = Solver::new(case.scene.scene()?, Evolution::Path);
        let mut frames: Vec<(f64, State<f64>, Truth)> = Vec::with_capacity(case.frame_count());
        for sample in case.path.frames(Some(FINEST)) {
            let hand = narrow_hand(&sample.hand);
            let (state, output) = match frames.last() {
                None => solver.start(hand),
                Some((_, state, _)) => {
                    let mut state = state.clone();
                    let output = solver.step(&mut state, hand);
                    (state, output)
                }
            };
            let slips = frames.last().map_or(0, |(.., truth)| truth.slips);
            frames.push((sample.t, state, Truth::of(&output, slips)));
        }
        Ok(Self { solver, frames })
    }

    pub(super) fn slips(&self) -> u64 {
        self.frames.last().map_or(0, |(.., truth)| truth.slips)
    }

    /// The reference at the instants of samples: a frame's, or that of one additional step from the previous frame. The run
    /// itself uses only its own frames.
    pub(super) fn at(&self, samples: impl Iterator<Item = Sample>) -> Vec<Truth> {
        let truth = |sample: Sample| {
            let later = |(t, ..): &(f64, _, _)| *t <= sample.t + Self::INSTANT;
            let reached = self.frames.partition_point(later).saturating_sub(1);
            let (t, state, truth) = &self.frames[reached];
            if sample.t - t <= Self::INSTANT {
                return *truth;
            }
            let mut state = state.clone();
            let output = self.solver.step(&mut state, narrow_hand(&sample.hand));
            Truth::of(&output, truth.slips)
        };
        samples.map(truth).collect()
    }
}
