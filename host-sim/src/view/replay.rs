//! A path that the hand follows, tick by tick, with snapshots on the way: a seek goes on from the nearest one before.

use std::sync::Arc;

use stiction_scene::{HandPath, Sample};

use super::pair::Pair;
use super::recording::Recording;
use super::step_times::StepTimes;
use crate::body::Setting;

/// Ticks from one snapshot to the next.
const SNAPSHOT_EVERY: usize = 500;
/// The longest path that is replayed (s).
const LONGEST: f64 = 3600.0;
/// Hertz.
const RATE: f64 = 1000.0;

/// The hand at every tick.
#[derive(Clone, Debug)]
pub(super) enum Way {
    /// Resampled at the ticks.
    Path(Arc<HandPath>),
    /// As it was recorded.
    Recorded(Arc<Recording>),
}

impl Way {
    /// How many ticks.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Path(path) => path.frame_count(Some(RATE)),
            Self::Recorded(recording) => recording.len(),
        }
    }

    /// From its first tick to its last (s).
    pub(super) fn seconds(&self) -> f64 {
        self.len().saturating_sub(1) as f64 / RATE
    }

    /// Whether it can be followed.
    ///
    /// # Errors
    /// It is too long.
    pub(super) fn check(&self) -> Result<(), String> {
        match self.seconds() {
            ..=LONGEST => Ok(()),
            seconds => Err(format!(
                "the path is {seconds:?} s long, allowed: up to {LONGEST} s"
            )),
        }
    }

    fn sample(&self, k: usize) -> Option<Sample> {
        match self {
            Self::Path(path) => path.sample(k, RATE),
            Self::Recorded(recording) => recording.get(k).map(|hand| Sample {
                t: k as f64 / RATE,
                hand: hand.hand(),
            }),
        }
    }
}

/// A path that is followed.
pub(super) struct Replay {
    /// What the state calls it.
    pub(super) what: String,
    pub(super) way: Way,
    /// The tick that the body is at.
    pub(super) at: usize,
    /// The tick that is sought.
    sought: Option<usize>,
    /// At ticks 0, n, 2 n ... as far as the path was followed.
    snapshots: Vec<Pair>,
    /// The setting has changed on the way.
    changed: bool,
}

impl Replay {
    /// A path from its beginning, and both bodies there.
    ///
    /// # Errors
    /// The scene cannot be used.
    pub(super) fn begin(what: String, way: Way, setting: &Setting) -> Result<(Self, Pair), String> {
        let sample = way
            .sample(0)
            .ok_or("the path is empty, allowed: at least one sample")?;
        let pair = Pair::start(setting, sample.t, &sample.hand)?;
        let replay = Self {
            what,
            way,
            at: 0,
            sought: None,
            snapshots: vec![pair.snapshot()],
            changed: false,
        };
        Ok((replay, pair))
    }

    /// From its first tick to its last (s).
    pub(super) fn seconds(&self) -> f64 {
        self.way.seconds()
    }

    /// Where it is (s).
    pub(super) fn position(&self) -> f64 {
        self.at as f64 / RATE
    }

    fn last(&self) -> usize {
        self.way.len().saturating_sub(1)
    }

    /// It is at the end.
    pub(super) fn is_over(&self) -> bool {
        self.at >= self.last() && !self.is_seeking()
    }

    /// There is a tick to go to.
    pub(super) fn is_seeking(&self) -> bool {
        self.sought.is_some()
    }

    /// The hand where it is.
    pub(super) fn sample(&self) -> Option<Sample> {
        self.way.sample(self.at)
    }

    /// Goes to the next tick; nothing at the end.
    pub(super) fn next(&mut self) -> Option<Sample> {
        let sample = self.way.sample(self.at + 1)?;
        self.at += 1;
        Some(sample)
    }

    /// Whether the setting has changed since this was asked last.
    pub(super) fn takes_change(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    /// As [`Self::next`], and the body follows.
    pub(super) fn advance(&mut self, pair: &mut Pair, times: &mut StepTimes) -> Option<Sample> {
        let sample = self.next()?;
        if let Way::Recorded(recording) = &self.way
            && let Some(setting) = recording.change_at(self.at)
        {
            // As it was when it was recorded, or, where it was changed since, as far as it can be.
            self.changed |= pair.change(setting).is_ok();
        }
        pair.step(sample.t, &sample.hand, times);
        if self.at == self.snapshots.len() * SNAPSHOT_EVERY {
            self.snapshots.push(pair.snapshot());
        }
        Some(sample)
    }

    /// Seeks a time (s): from the nearest snapshot before it, or from here where that is nearer. [`Self::approach`] goes on.
    ///
    /// # Errors
    /// The scene cannot be used.
    pub(super) fn seek(&mut self, seconds: f64, pair: &mut Pair) -> Result<(), String> {
        let tick = (seconds * RATE).round().clamp(0.0, self.last() as f64) as usize;
        if self.snapshots.is_empty() {
            let first = self.way.sample(0).ok_or("the path is empty")?;
            self.snapshots
                .push(Pair::start(&pair.setting, first.t, &first.hand)?);
        }
        let nearest = (tick / SNAPSHOT_EVERY).min(self.snapshots.len() - 1);
        let from = nearest * SNAPSHOT_EVERY;
        if tick < self.at || self.at < from {
            let missed = pair.counts.missed;
            *pair = self.snapshots[nearest].snapshot();
            pair.counts.missed = missed;
            self.at = from;
        }
        self.sought = (tick > self.at).then_some(tick);
        Ok(())
    }

    /// One tick towards the one that is sought.
    pub(super) fn approach(&mut self, pair: &mut Pair, times: &mut StepTimes) {
        let arrived =
            self.advance(pair, times).is_none() || self.sought.is_none_or(|tick| self.at >= tick);
        if arrived {
            self.sought = None;
        }
    }

    /// The setting has changed: the snapshots are of another one.
    pub(super) fn forget(&mut self) {
        self.snapshots.clear();
    }
}
