//! A path that the hand follows, tick by tick, with snapshots taken during the replay: a seek continues from the nearest
//! earlier one.

use std::fmt::Debug;
use std::sync::Arc;

use stiction_scene::{HandPath, Sample};

use crate::body::Setting;
use crate::guide::HandPose;
use crate::pair::Pair;
use crate::step_times::StepTimes;

/// Ticks between two snapshots.
const SNAPSHOT_EVERY: usize = 500;
/// Longest path that can be replayed (s).
const LONGEST: f64 = 3600.0;
/// Ticks that a demonstration rests at its end: time to look at the result.
const REST: u32 = 1000;
/// Tick rate (Hz).
const RATE: f64 = 1000.0;

/// A hand that was recorded tick by tick, with the changes of the setting.
pub trait Recorded: Debug + Send + Sync {
    /// Returns the number of ticks.
    fn count(&self) -> usize;
    /// Returns the hand of a tick.
    fn get(&self, k: usize) -> Option<&HandPose>;
    /// Returns the setting that begins with a tick.
    fn change_at(&self, k: usize) -> Option<&Setting>;
}

/// The hand at every tick.
#[derive(Clone, Debug)]
pub enum Way {
    /// A path, resampled at the ticks.
    Path(Arc<HandPath>),
    /// A path that is repeated until somebody takes the hand.
    Demonstration(Arc<HandPath>),
    /// A recording, tick by tick.
    Recorded(Arc<dyn Recorded>),
}

impl Way {
    /// Returns the number of ticks.
    pub fn count(&self) -> usize {
        match self {
            Self::Path(path) | Self::Demonstration(path) => path.frame_count(Some(RATE)),
            Self::Recorded(recording) => recording.count(),
        }
    }

    /// Returns the duration from the first tick to the last (s).
    pub fn seconds(&self) -> f64 {
        self.count().saturating_sub(1) as f64 / RATE
    }

    /// Checks that it can be followed.
    ///
    /// # Errors
    /// It is too long.
    pub fn check(&self) -> Result<(), String> {
        match self.seconds() {
            ..=LONGEST => Ok(()),
            seconds => Err(format!(
                "the path is {seconds:?} s long, allowed: up to {LONGEST} s"
            )),
        }
    }

    fn sample(&self, k: usize) -> Option<Sample> {
        match self {
            Self::Path(path) | Self::Demonstration(path) => path.sample(k, RATE),
            Self::Recorded(recording) => recording.get(k).map(|hand| Sample {
                t: k as f64 / RATE,
                hand: hand.hand(),
            }),
        }
    }
}

/// A path that is being followed.
pub struct Replay {
    /// Its name in the state.
    pub what: String,
    /// The path.
    pub way: Way,
    /// The present tick.
    pub at: usize,
    /// The tick to go to.
    sought: Option<usize>,
    /// At ticks 0, n, 2 n ... as far as the path has been followed.
    snapshots: Vec<Pair>,
    /// Whether the setting has changed during the replay.
    changed: bool,
    /// Ticks rested at the end.
    rested: u32,
}

impl Replay {
    /// Starts a path from its beginning. Returns it with both bodies there.
    ///
    /// # Errors
    /// The scene cannot be used.
    pub fn begin(what: String, way: Way, setting: &Setting) -> Result<(Self, Pair), String> {
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
            rested: 0,
        };
        Ok((replay, pair))
    }

    /// Returns the duration from the first tick to the last (s).
    pub fn seconds(&self) -> f64 {
        self.way.seconds()
    }

    /// Returns the present time of the path (s).
    pub fn position(&self) -> f64 {
        self.at as f64 / RATE
    }

    fn last(&self) -> usize {
        self.way.count().saturating_sub(1)
    }

    /// Returns whether it is at the end.
    pub fn is_over(&self) -> bool {
        self.at >= self.last() && !self.is_seeking()
    }

    /// Returns whether it repeats until somebody takes the hand.
    pub const fn is_demonstration(&self) -> bool {
        matches!(self.way, Way::Demonstration(_))
    }

    /// Counts a tick at the end. Returns whether it is time to begin again.
    pub fn rest(&mut self) -> bool {
        self.rested = self.rested.saturating_add(1);
        self.is_demonstration() && self.rested >= REST
    }

    /// Returns whether a seek is in progress.
    pub fn is_seeking(&self) -> bool {
        self.sought.is_some()
    }

    /// Returns the hand at the present tick.
    pub fn sample(&self) -> Option<Sample> {
        self.way.sample(self.at)
    }

    /// Goes to the next tick. Returns nothing at the end.
    pub fn go_on(&mut self) -> Option<Sample> {
        let sample = self.way.sample(self.at + 1)?;
        self.at += 1;
        Some(sample)
    }

    /// Returns whether the setting has changed since the last call.
    pub fn takes_change(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    /// Goes to the next tick as [`Self::go_on`] does, and the body follows.
    pub fn advance(&mut self, pair: &mut Pair, times: &mut StepTimes) -> Option<Sample> {
        let sample = self.go_on()?;
        if let Way::Recorded(recording) = &self.way
            && let Some(setting) = recording.change_at(self.at)
        {
            // As during the recording; or, if the scene was changed since, as far as possible.
            self.changed |= pair.change(setting).is_ok();
        }
        pair.step(sample.t, &sample.hand, times);
        if self.at == self.snapshots.len() * SNAPSHOT_EVERY {
            self.snapshots.push(pair.snapshot());
        }
        Some(sample)
    }

    /// Seeks a time (s): from the nearest earlier snapshot, or from the present tick if that is nearer. [`Self::approach`]
    /// continues.
    ///
    /// # Errors
    /// The scene cannot be used.
    pub fn seek(&mut self, seconds: f64, pair: &mut Pair) -> Result<(), String> {
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
        self.rested = 0;
        self.sought = (tick > self.at).then_some(tick);
        Ok(())
    }

    /// Makes one tick towards the tick to go to.
    pub fn approach(&mut self, pair: &mut Pair, times: &mut StepTimes) {
        let arrived =
            self.advance(pair, times).is_none() || self.sought.is_none_or(|tick| self.at >= tick);
        if arrived {
            self.sought = None;
        }
    }

    /// Drops the snapshots after a change of the setting: they belong to the old one.
    pub fn forget(&mut self) {
        self.snapshots.clear();
    }
}
