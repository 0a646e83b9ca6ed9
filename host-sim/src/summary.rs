//! The summary of a run: time in each state and in slides, slips, the largest force, the worst residual of the balance, the
//! limits that applied to answers, the insertion of a peg, and the solver's run time.

mod insertion;
mod nearest;

use std::collections::BTreeMap;
use std::fmt;
use std::time::Duration;

use stiction_core::{StateKind, Status};

use crate::balance::{Imbalance, Residual};
use insertion::Insertions;
use nearest::Nearest;
use stiction_live::record::{Frame, Run};

/// Sums and extremes over the frames of a run.
#[derive(Clone, Debug)]
pub(crate) struct Summary {
    title: String,
    pub(crate) residual: Residual,
    pub(crate) frames: u64,
    span: Option<(f64, f64)>,
    pub(crate) seconds: [f64; StateKind::ALL.len()],
    /// Time during which something slid (s).
    sliding: f64,
    pub(crate) slips: u64,
    pub(crate) longest_slip: f64,
    pub(crate) limited: BTreeMap<Status, u64>,
    nearest: Nearest,
    /// For a scene that has a peg and a hole.
    insertions: Option<Insertions>,
    solver_time: Duration,
}

impl Summary {
    pub(crate) fn new(run: &Run) -> Self {
        let (number, evolution) = (run.number.name(), run.evolution.name());
        Self {
            title: format!("{} ({number}, {evolution})", run.scene.title),
            residual: Residual::new(&run.scene),
            frames: 0,
            span: None,
            seconds: [0.0; StateKind::ALL.len()],
            sliding: 0.0,
            slips: 0,
            longest_slip: 0.0,
            limited: BTreeMap::new(),
            nearest: Nearest::new(&run.scene),
            insertions: run.meter.clone().map(Insertions::new),
            solver_time: Duration::ZERO,
        }
    }

    /// Adds a frame; the time since the previous frame counts for its state.
    pub(crate) fn add(&mut self, frame: &Frame) {
        self.frames += 1;
        let (first, last) = self.span.unwrap_or((frame.t, frame.t));
        self.span = Some((first, frame.t));
        if let Some(k) = StateKind::ALL
            .iter()
            .position(|state| *state == frame.state)
        {
            self.seconds[k] += frame.t - last;
        }
        if frame.contacts.iter().any(|contact| contact.sliding != 0) {
            self.sliding += frame.t - last;
        }
        self.slips += u64::from(frame.slips);
        self.longest_slip = self.longest_slip.max(frame.longest_slip);
        if frame.status != Status::Ok {
            *self.limited.entry(frame.status).or_default() += 1;
        }
        self.residual.add(frame);
        self.nearest.add(frame);
        if let Some(insertions) = &mut self.insertions {
            insertions.add(frame);
        }
    }

    /// From the first frame to the last (s).
    pub(crate) fn duration(&self) -> f64 {
        let (first, last) = self.span.unwrap_or_default();
        last - first
    }

    pub(crate) fn set_solver_time(&mut self, time: Duration) {
        self.solver_time = time;
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let duration = self.duration();
        writeln!(f, "{}", self.title)?;
        writeln!(
            f,
            "  {:<18}{:>10}   over {duration:.3} s",
            "frames", self.frames
        )?;
        let states = StateKind::ALL.map(StateKind::name);
        let times = states.into_iter().zip(self.seconds);
        for (name, seconds) in times.chain([("sliding", self.sliding)]) {
            if seconds > 0.0 {
                let percent = 100.0 * seconds / duration;
                writeln!(f, "  {name:<18}{seconds:>10.3} s {percent:>6.1} %")?;
            }
        }
        if let Some(text) = self.nearest.text() {
            writeln!(f, "  {text}")?;
        }
        writeln!(
            f,
            "  {:<18}{:>10}   longest {:.3} mm",
            "slips",
            self.slips,
            1e3 * self.longest_slip
        )?;
        let largest_force = self.residual.largest_force();
        let Imbalance { force, moment } = self.residual.relative();
        writeln!(f, "  {:<18}{largest_force:>10.4} N", "largest force")?;
        writeln!(
            f,
            "  {:<18}{force:>10.1e}   forces, of the largest force",
            "worst residual"
        )?;
        writeln!(
            f,
            "  {:<18}{moment:>10.1e}   moments, of that force times the body size",
            ""
        )?;
        let limited: u64 = self.limited.values().sum();
        let kinds: Vec<String> = (self.limited.iter())
            .map(|(status, count)| format!("{} {count}", status.name()))
            .collect();
        writeln!(
            f,
            "  {:<18}{limited:>10}   {}",
            "frames not ok",
            kinds.join(", ")
        )?;
        if let Some(insertions) = &self.insertions {
            write!(f, "{insertions}")?;
        }
        let nanoseconds = self.solver_time.as_secs_f64() * 1e9 / self.frames.max(1) as f64;
        writeln!(
            f,
            "  {:<18}{nanoseconds:>10.0} ns per frame, measured around the solver's steps",
            "mean time"
        )
    }
}
