//! The place between the solver and those who watch it: the newest record, what led to it, and the state. The solver puts
//! things there only where nobody is reading at that moment, else with its next tick: it waits for no one.

use std::ops::Deref;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use stiction_live::feed::{Latest, Pending, Shown};

use super::recording::Recording;

/// What is shown, and the recording that can be downloaded.
#[derive(Debug, Default)]
pub(super) struct Showcase {
    shown: Shown,
    pub(super) recorded: Option<Arc<Recording>>,
}

impl Deref for Showcase {
    type Target = Shown;

    fn deref(&self) -> &Shown {
        &self.shown
    }
}

/// What is shown, to be read by many.
#[derive(Debug, Default)]
pub(super) struct Feed {
    shown: Mutex<Showcase>,
}

impl Feed {
    /// Reads. Not for long: nothing new is shown meanwhile.
    pub(super) fn read(&self) -> MutexGuard<'_, Showcase> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Shows what waits, unless somebody is reading.
    pub(super) fn show(
        &self,
        (pending, recorded): (&mut Pending, &mut Option<Arc<Recording>>),
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
