//! The progress of a sweep, on standard error: a bar on a terminal, otherwise a line every ten seconds.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar};

use crate::progress::bar;
use crate::report;

/// Completed rows out of all.
pub(super) struct Progress {
    bar: ProgressBar,
    /// When the last line was written, if there is no terminal.
    reported: Option<Instant>,
    begun: Instant,
    before: u64,
}

impl Progress {
    const INTERVAL: Duration = Duration::from_secs(10);

    /// Begins with `done` of `total` rows complete.
    pub(super) fn new(done: u64, total: u64, quiet: bool) -> Self {
        let bar = match quiet {
            true => ProgressBar::hidden(),
            false => bar(total, "{bar:40} {pos} of {len} rows, {per_sec}, {eta} left"),
        };
        bar.set_position(done);
        bar.reset_eta();
        let now = Instant::now();
        Self {
            reported: (!quiet && !io::stderr().is_terminal()).then_some(now),
            bar,
            begun: now,
            before: done,
        }
    }

    /// Reports that `done` rows are complete.
    pub(super) fn set(&mut self, done: u64, total: u64) {
        self.bar.set_position(done);
        let Some(reported) = &mut self.reported else {
            return;
        };
        if reported.elapsed() < Self::INTERVAL {
            return;
        }
        *reported = Instant::now();
        let rate = (done - self.before) as f64 / self.begun.elapsed().as_secs_f64();
        let left = HumanDuration(Duration::from_secs_f64((total - done) as f64 / rate));
        report::tell(format_args!(
            "{done} of {total} rows, {rate:.1}/s, {left} left"
        ));
    }
}
