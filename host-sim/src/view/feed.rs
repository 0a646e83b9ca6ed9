//! The exchange between the solver and its readers: the newest record, the events that led to it, and the state. The solver
//! writes to it only if nobody is reading at that moment, otherwise with its next tick: it waits for no one.

use std::ops::Deref;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use stiction_live::feed::{Latest, Pending, Shown};

use super::recording::LiveRecording;

/// The published data, and the recording that can be downloaded.
#[derive(Debug, Default)]
pub(super) struct Showcase {
    shown: Shown,
    pub(super) recorded: Option<Arc<LiveRecording>>,
}

impl Deref for Showcase {
    type Target = Shown;

    fn deref(&self) -> &Shown {
        &self.shown
    }
}

/// The published data, with many readers.
#[derive(Debug, Default)]
pub(super) struct SharedFeed {
    shown: Mutex<Showcase>,
}

impl SharedFeed {
    /// Locks the data for reading. Only briefly: nothing new is published meanwhile.
    pub(super) fn read(&self) -> MutexGuard<'_, Showcase> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Publishes the pending data, unless somebody is reading.
    pub(super) fn show(
        &self,
        pending: &mut Pending,
        recorded: &mut Option<Arc<LiveRecording>>,
        latest: impl FnOnce() -> Latest,
    ) {
        if pending.is_shown() {
            return;
        }
        let Ok(mut show) = self.shown.try_lock() else {
            return;
        };
        show.shown.show(pending, latest());
        if recorded.is_some() {
            show.recorded = recorded.take();
        }
    }
}
