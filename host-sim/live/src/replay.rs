//! A path that the hand follows, tick by tick, with snapshots on the way: a seek goes on from the nearest one before.

use std::fmt::Debug;
use std::sync::Arc;

use stiction_scene::{HandPath, Sample};

use crate::body::Setting;
use crate::guide::HandPose;
use crate::pair::Pair;
use crate::step_times::StepTimes;

/// Ticks from one snapshot to the next.
const SNAPSHOT_EVERY: usize = 500;
/// The longest path that is replayed (s).
const LONGEST: f64 = 3600.0;
/// Ticks that a demonstration rests at its end: so long one looks at what has become of the body.
const REST: u32 = 1000;
/// Hertz.
const RATE: f64 = 1000.0;

/// A hand that was recorded tick by tick, with the settings on the way.
pub trait Recorded: Debug + Send + Sync {
    /// How many ticks.
    fn count(&self) -> usize;
    /// The hand of a tick.
    fn get(&self, k: usize) -> Option<&HandPose>;
    /// The setting that begins with a tick.
    fn change_at(&self, k: usize) -> Option<&Setting>;
}

/// The hand at every tick.
#[derive(Clone, Debug)]
pub enum Way {
    /// Resampled at the ticks.
    Path(Arc<HandPath>),
    /// The same, over and over, until somebody takes the hand.
    Demonstration(Arc<HandPath>),
    /// As it was recorded.
    Recorded(Arc<dyn Recorded>),
}

impl Way {
    /// How many ticks.
    pub fn count(&self) -> usize {
        match self {
            Self::Path(path) | Self::Demonstration(path) => path.frame_count(Some(RATE)),
            Self::Recorded(recording) => recording.count(),
        }
    }

    /// From its first tick to its last (s).
    pub fn seconds(&self) -> f64 {
        self.count().saturating_sub(1) as f64 / RATE
    }

    /// Whether it can be followed.
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

/// A path that is followed.
pub struct Replay {
    /// What the state calls it.
    pub what: String,
    /// The path.
    pub way: Way,
    /// The tick that the body is at.
    pub at: usize,
    /// The tick that is sought.
    sought: Option<usize>,
    /// At ticks 0, n, 2 n ... as far as the path was followed.
    snapshots: Vec<Pair>,
    /// The setting has changed on the way.
    changed: bool,
    /// Ticks that it has rested at its end.
    rested: u32,
}

impl Replay {
    /// A path from its beginning, and both bodies there.
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

    /// From its first tick to its last (s).
    pub fn seconds(&self) -> f64 {
        self.way.seconds()
    }

    /// Where it is (s).
    pub fn position(&self) -> f64 {
        self.at as f64 / RATE
    }

    fn last(&self) -> usize {
        self.way.count().saturating_sub(1)
    }

    /// It is at the end.
    pub fn is_over(&self) -> bool {
        self.at >= self.last() && !self.is_seeking()
    }

    /// It goes on until somebody takes the hand.
    pub const fn is_demonstration(&self) -> bool {
        matches!(self.way, Way::Demonstration(_))
    }

    /// A tick at the end. Whether it is time to begin again.
    pub fn rest(&mut self) -> bool {
        self.rested = self.rested.saturating_add(1);
        self.is_demonstration() && self.rested >= REST
    }

    /// There is a tick to go to.
    pub fn is_seeking(&self) -> bool {
        self.sought.is_some()
    }

    /// The hand where it is.
    pub fn sample(&self) -> Option<Sample> {
        self.way.sample(self.at)
    }

    /// Goes to the next tick; nothing at the end.
    pub fn go_on(&mut self) -> Option<Sample> {
        let sample = self.way.sample(self.at + 1)?;
        self.at += 1;
        Some(sample)
    }

    /// Whether the setting has changed since this was asked last.
    pub fn takes_change(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    /// As [`Self::go_on`], and the body follows.
    pub fn advance(&mut self, pair: &mut Pair, times: &mut StepTimes) -> Option<Sample> {
        let sample = self.go_on()?;
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

    /// One tick towards the one that is sought.
    pub fn approach(&mut self, pair: &mut Pair, times: &mut StepTimes) {
        let arrived =
            self.advance(pair, times).is_none() || self.sought.is_none_or(|tick| self.at >= tick);
        if arrived {
            self.sought = None;
        }
    }

    /// The setting has changed: the snapshots are of another one.
    pub fn forget(&mut self) {
        self.snapshots.clear();
    }
}
