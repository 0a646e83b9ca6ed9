//! The place between the solver and those who watch it: the newest record, what led to it, and the state. The solver puts
//! things there only where nobody is reading at that moment, else with its next tick: it waits for no one.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use stiction_insertion::Meter;
use stiction_scene::SceneFile;

use super::counts::Counts;
use super::echo::Echo;
use super::pair::{Comparison, SlipMark};
use super::recording::Recording;
use crate::board::Fares;
use crate::record::Frame;

/// So many records of the past are kept.
const KEPT: usize = 1024;

/// The newest there is.
#[derive(Clone, Debug)]
pub(super) struct Latest {
    pub(super) tick: u64,
    pub(super) frame: Arc<Frame>,
    pub(super) scene: Arc<SceneFile>,
    /// Whitney's meter, where the scene has a peg and a hole.
    pub(super) meter: Option<Arc<Meter>>,
    /// The numbers have the digits of f32.
    pub(super) single: bool,
    /// A client, and what it sent with the newest sample that is in the record.
    pub(super) echo: Option<Echo>,
    pub(super) reference: Comparison,
    pub(super) counts: Counts,
    pub(super) slips: Arc<[SlipMark]>,
    /// Median and worst time of a step (s), on this computer.
    pub(super) step: Option<[f32; 2]>,
    /// How the board fares that has the solver.
    pub(super) board: Option<Fares>,
    pub(super) position: Option<f64>,
}

/// What is shown.
#[derive(Debug, Default)]
pub(super) struct Shown {
    /// Of the newest publication.
    pub(super) serial: u64,
    pub(super) latest: Option<Latest>,
    /// The last records, the oldest first, of one scene and one run; the running number of the next one.
    records: VecDeque<Arc<Frame>>,
    next_record: u64,
    /// The state as a message, and its running number.
    pub(super) state: Arc<str>,
    pub(super) state_serial: u64,
    /// The recording that can be downloaded.
    pub(super) recorded: Option<Arc<Recording>>,
}

impl Shown {
    /// The records since one, and the number of the next one to come.
    pub(super) fn since(&self, next: u64) -> (impl ExactSizeIterator<Item = &Arc<Frame>>, u64) {
        let first = self.next_record - self.records.len() as u64;
        let skip = next.saturating_sub(first).min(self.records.len() as u64) as usize;
        (self.records.range(skip..), self.next_record)
    }
}

/// What waits to be shown.
#[derive(Debug, Default)]
pub(super) struct Pending {
    records: Vec<Arc<Frame>>,
    /// What was shown before is of another run.
    clear: bool,
    state: Option<Arc<str>>,
    recorded: Option<Arc<Recording>>,
    /// There is something new.
    any: bool,
}

impl Pending {
    /// A record.
    pub(super) fn record(&mut self, frame: &Arc<Frame>) {
        if self.records.len() == KEPT {
            // Whoever holds the lock for a second does not get them all.
            self.records.clear();
        }
        self.records.push(Arc::clone(frame));
        self.any = true;
    }

    /// Another run begins.
    pub(super) fn clear(&mut self) {
        self.records.clear();
        self.clear = true;
        self.any = true;
    }

    pub(super) fn state(&mut self, message: String) {
        self.state = Some(message.into());
        self.any = true;
    }

    pub(super) fn recorded(&mut self, recording: Arc<Recording>) {
        self.recorded = Some(recording);
        self.any = true;
    }

    /// Nothing waits.
    pub(super) const fn is_shown(&self) -> bool {
        !self.any
    }

    /// Something is new though no record is.
    pub(super) fn touch(&mut self) {
        self.any = true;
    }
}

/// What is shown, to be read by many.
#[derive(Debug, Default)]
pub(super) struct Feed {
    shown: Mutex<Shown>,
}

impl Feed {
    /// Reads. Not for long: nothing new is shown meanwhile.
    pub(super) fn read(&self) -> MutexGuard<'_, Shown> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Shows what waits, unless somebody is reading.
    pub(super) fn show(&self, pending: &mut Pending, latest: impl FnOnce() -> Latest) {
        if !pending.any {
            return;
        }
        let Ok(mut shown) = self.shown.try_lock() else {
            return;
        };
        shown.serial += 1;
        shown.latest = Some(latest());
        if pending.clear {
            shown.records.clear();
        }
        for frame in pending.records.drain(..) {
            if shown.records.len() == KEPT {
                shown.records.pop_front();
            }
            shown.records.push_back(frame);
            shown.next_record += 1;
        }
        if let Some(state) = pending.state.take() {
            shown.state = state;
            shown.state_serial += 1;
        }
        if pending.recorded.is_some() {
            shown.recorded = pending.recorded.take();
        }
        pending.clear = false;
        pending.any = false;
    }
}
