//! What every setting is measured against: f64 with path evolution at the finest rate, and its answer at any instant
//! between two of its frames.

use stiction_core::{Output, State, StateKind};

use super::setting::{FINEST, Setting};
use super::suite::Case;
use crate::hand_path::Sample;
use crate::number::narrow_hand;
use crate::scene_file::HostSolver;
use crate::source::InputError;

/// Where the body is at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Truth {
    /// x, y (m), theta (rad)
    pub(super) pose: [f64; 3],
    pub(super) state: StateKind,
}

impl Truth {
    fn of(output: &Output<f64>) -> Self {
        let [x, y] = output.position;
        Self {
            pose: [x, y, output.angle.radians()],
            state: output.state,
        }
    }
}

/// A run of the reference.
pub(super) struct Reference {
    solver: HostSolver<f64>,
    frames: Vec<(f64, State<f64>, Truth)>,
    /// Slips of the whole run.
    pub(super) slips: u64,
}

impl Reference {
    /// Two instants that differ by less (s) are the same.
    const INSTANT: f64 = 1e-6 / FINEST;

    pub(super) fn new(case: &Case) -> Result<Self, InputError> {
        let solver = Setting::REFERENCE.solver(case.scene.scene()?);
        let mut frames: Vec<(f64, State<f64>, Truth)> = Vec::with_capacity(case.frame_count());
        let mut slips = 0;
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
            slips += u64::from(output.slips);
            frames.push((sample.t, state, Truth::of(&output)));
        }
        Ok(Self {
            solver,
            frames,
            slips,
        })
    }

    /// The truth at the instants of samples: a frame's, or that of one step more from the frame before. The run itself
    /// goes through its own frames alone.
    pub(super) fn at(&self, samples: impl Iterator<Item = Sample>) -> Vec<Truth> {
        let truth = |sample: Sample| {
            let later = |(t, ..): &(f64, _, _)| *t <= sample.t + Self::INSTANT;
            let reached = self.frames.partition_point(later).saturating_sub(1);
            let (t, state, truth) = &self.frames[reached];
            if sample.t - t <= Self::INSTANT {
                return *truth;
            }
            let mut state = state.clone();
            Truth::of(&self.solver.step(&mut state, narrow_hand(&sample.hand)))
        };
        samples.map(truth).collect()
    }
}
