//! The cost of a frame: its time on this computer, its instructions or cycles and memory on emulated chips.

use std::hint::black_box;
use std::time::{Duration, Instant};

use stiction_core::{Hand, Real};
use stiction_scene::HostSolver;

use super::chip::Chip;

/// The cost of a setting on an emulated chip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Emulated {
    /// The count per frame, see [`Chip::unit`]: mean.
    pub mean: f64,
    /// The count of the worst frame.
    pub worst: u32,
    /// Flash (bytes).
    pub flash: u64,
    /// State of a run (bytes).
    pub state: u32,
    /// Deepest stack (bytes).
    pub stack: u32,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Cost {
    /// Time of a frame on this computer (ns), mean.
    pub(super) host: f64,
    /// On each of [`Chip::ALL`], if it was counted.
    pub(super) emulated: [Option<Emulated>; Chip::ALL.len()],
}

/// Number of runs, of which the fastest counts: it was disturbed least.
pub(super) const REPEATS: usize = 5;

/// The time of all steps through a path, without the start.
pub(super) fn time<R: Real>(solver: &HostSolver<R>, hands: &[Hand<R::Si>]) -> Duration {
    let Some((&first, rest)) = hands.split_first() else {
        return Duration::ZERO;
    };
    let run = |_| {
        let (mut state, _) = solver.start(first);
        let begun = Instant::now();
        for &hand in rest {
            black_box(solver.step(&mut state, black_box(hand)));
        }
        begun.elapsed()
    };
    (0..REPEATS).map(run).min().unwrap_or_default()
}
