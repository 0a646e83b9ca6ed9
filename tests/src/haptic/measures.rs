//! How far whole runs of the same hand differ, and what they contain: from the frames of runs to samples and counts.

use crate::number::Number;
use crate::random::Scenario;
use crate::run::{Frame, run};
use crate::setup::Setup;
use stiction_core::{Evolution, StateKind};

/// A whole run, with every frame of the hand cut into `parts` equal ones.
pub fn led<R: Number>(scenario: &Scenario, evolution: Evolution, parts: usize) -> Vec<Frame> {
    run::<R>(&scenario.setup, evolution, &scenario.hands(parts))
}

/// Compares whole runs with those of f64 by path evolution.
pub fn against_f64<R: Number>(
    scenarios: impl IntoIterator<Item = Scenario>,
    evolution: Evolution,
    parts: usize,
) -> Comparison {
    let mut comparison = Comparison::default();
    for scenario in scenarios {
        let reference = led::<f64>(&scenario, Evolution::Path, 1);
        let run = led::<R>(&scenario, evolution, parts);
        comparison.add(&scenario.setup, &run, &reference);
    }
    comparison
}

/// Runs compared with reference runs of the same hand.
#[derive(Clone, Debug, Default)]
pub struct Comparison {
    /// Distance of the poses (L) in every frame in which the body touches in either run.
    pub errors: Samples,
    /// Slips of the runs.
    pub slips: u64,
    /// Slips of the reference runs.
    pub reference_slips: u64,
}

impl Comparison {
    /// Adds a run. If the frames of the run are cut, only the poses at the samples of the reference are compared.
    ///
    /// # Panics
    /// If the number of the run's frames does not match that of the reference.
    pub fn add(&mut self, setup: &Setup, run: &[Frame], reference: &[Frame]) {
        let parts = (run.len() - 1) / (reference.len() - 1);
        assert_eq!(
            (reference.len() - 1) * parts + 1,
            run.len(),
            "the runs do not have the same hand"
        );
        let l = setup.size();
        for (a, b) in run.iter().step_by(parts).zip(reference) {
            if touches(a) || touches(b) {
                self.errors.add(distance(setup, a.pose, b.pose) / l);
            }
        }
        self.slips += slips(run);
        self.reference_slips += slips(reference);
    }
}

/// How often runs are in each state.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Frames by state, in the order of [`StateKind::ALL`].
    states: [u64; StateKind::ALL.len()],
}

impl Tally {
    /// Adds a run.
    pub fn add(&mut self, run: &[Frame]) {
        for frame in run {
            for (count, state) in self.states.iter_mut().zip(StateKind::ALL) {
                *count += u64::from(state == frame.state);
            }
        }
    }
    /// The fraction of all frames in which the body touches.
    pub fn share_in_contact(&self) -> f64 {
        let frames: u64 = self.states.iter().sum();
        self.contact() as f64 / frames as f64
    }
    /// The fraction of the frames in contact that are in this state.
    pub fn share_of_contact(&self, state: StateKind) -> f64 {
        self.count(|s| s == state) as f64 / self.contact() as f64
    }
    fn contact(&self) -> u64 {
        self.count(|s| s != StateKind::NonContact)
    }
    fn count(&self, wanted: impl Fn(StateKind) -> bool) -> u64 {
        let counts = StateKind::ALL.into_iter().zip(self.states);
        counts.filter(|&(s, _)| wanted(s)).map(|(_, n)| n).sum()
    }
}

/// Numbers whose quantiles are of interest. NaN counts as larger than all others.
#[derive(Clone, Debug, Default)]
pub struct Samples(Vec<f64>);

impl Samples {
    /// Adds a number.
    pub fn add(&mut self, value: f64) {
        self.0.push(value);
    }
    /// The smallest number that is at least as large as this fraction of them: 1 gives the largest. Without numbers, 0.
    pub fn quantile(&mut self, part: f64) -> f64 {
        let Some(last) = self.0.len().checked_sub(1) else {
            return 0.0;
        };
        let rank = (part * self.0.len() as f64).ceil() as usize;
        let rank = rank.saturating_sub(1).min(last);
        *self.0.select_nth_unstable_by(rank, f64::total_cmp).1
    }
    /// The sum.
    pub fn sum(&self) -> f64 {
        self.0.iter().sum()
    }
    /// The mean; 0 without numbers.
    pub fn mean(&self) -> f64 {
        self.sum() / self.0.len().max(1) as f64
    }
}

/// The number of slips of a whole run.
fn slips(run: &[Frame]) -> u64 {
    run.iter().map(|frame| u64::from(frame.slips)).sum()
}

/// How far apart two poses of the body are: the displacement of the vertex that moves farthest (m).
fn distance(setup: &Setup, a: [f64; 3], b: [f64; 3]) -> f64 {
    let way = |&v: &[f64; 2]| {
        let ([ax, ay], [bx, by]) = (setup.world(a, v), setup.world(b, v));
        (ax - bx).hypot(ay - by)
    };
    // A maximum must not hide values that are not finite.
    let worse = |a: f64, b: f64| if b > a || b.is_nan() { b } else { a };
    setup.vertices.iter().map(way).fold(0.0, worse)
}

fn touches(frame: &Frame) -> bool {
    frame.state != StateKind::NonContact
}
