//! The events, slips, status and transitions of a step, for the output.

use crate::event::{Event, MAX_EVENTS, Status};
use crate::real::Real;
use crate::transition::Transitions;
use heapless::Vec;

/// What happens during a step, collected for the output.
#[derive(Clone, Debug, Default)]
pub(crate) struct Log<R> {
    pub(crate) events: Vec<Event, MAX_EVENTS>,
    pub(crate) slips: u32,
    pub(crate) longest_slip: R,
    pub(crate) status: Status,
    /// The body was last left out of balance because no motion was consistent.
    pub(crate) ambiguous: bool,
    pub(crate) transitions: Transitions,
}

impl<R: Real> Log<R> {
    /// Adds an event; a run of equal ones counts once.
    pub(crate) fn event(&mut self, event: Event) {
        if self.events.last() != Some(&event) {
            // A full list keeps the first events of the frame.
            let _ = self.events.push(event);
        }
    }
    /// Counts a slip of the given length that ended at mu_d N.
    pub(crate) fn slip(&mut self, length: R) {
        self.slips = self.slips.saturating_add(1);
        self.longest_slip = self.longest_slip.max(length.abs());
        self.event(Event::Slip);
    }
    /// The most severe status. An ambiguity within the step does not count if the body came to rest after all.
    pub(crate) fn final_status(&self) -> Status {
        if self.ambiguous {
            self.status.max(Status::Ambiguous)
        } else {
            self.status
        }
    }
    /// The status, if the body was not brought to balance.
    pub(crate) fn unrest(&self) -> Status {
        Self::unrest_of(self.final_status())
    }
    /// The part of a status that means the pose is not a balance.
    pub(crate) fn unrest_of(status: Status) -> Status {
        match status {
            Status::Ok | Status::EventLimit | Status::Twist => Status::Ok,
            grave => grave,
        }
    }
    /// Keeps the most severe status.
    pub(crate) fn limit(&mut self, status: Status) {
        self.status = self.status.max(status);
    }
}
