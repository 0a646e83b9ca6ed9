//! What happens during a step, collected for its output.

use crate::event::{Event, MAX_EVENTS, StateKind, Status};
use crate::real::Real;
use heapless::Vec;

/// What happened, in order. Their number takes a byte: so the log of a step is short enough to be cleared without a call.
pub(crate) type Events = Vec<Event, MAX_EVENTS, u8>;

/// Events, slips, status and cost of a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Log<R> {
    pub(crate) events: Events,
    pub(crate) slips: u32,
    pub(crate) longest_slip: R,
    pub(crate) status: Status,
    /// The contacts that the body rests on hold it with reactions beyond the limit: a status, if the body still does at the end of the step.
    pub(crate) jammed: bool,
    /// Pieces.
    pub(crate) work: u32,
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
    /// Keeps the most severe status.
    pub(crate) fn limit(&mut self, status: Status) {
        self.status = self.status.max(status);
    }
    /// One more contact.
    pub(crate) fn touch(&mut self, before: StateKind, after: StateKind) {
        self.event(match (before, after) {
            (StateKind::NonContact | StateKind::SingleVertex, StateKind::Edge) => Event::Land,
            (StateKind::NonContact | StateKind::SingleVertex, StateKind::Locked)
            | (
                StateKind::Edge | StateKind::TwoVertex | StateKind::Corner | StateKind::Locked,
                _,
            ) => Event::Jam,
            (
                StateKind::NonContact | StateKind::SingleVertex,
                StateKind::NonContact
                | StateKind::SingleVertex
                | StateKind::TwoVertex
                | StateKind::Corner,
            ) => Event::Touch,
        });
    }
    /// Contacts take the place of others, no more than there were.
    pub(crate) fn replace(&mut self, before: StateKind, after: StateKind) {
        if before == after {
            return;
        }
        self.open(before, StateKind::SingleVertex);
        if after != StateKind::SingleVertex {
            self.touch(StateKind::SingleVertex, after);
        }
    }
    /// Contacts open, others last.
    pub(crate) fn open(&mut self, before: StateKind, after: StateKind) {
        self.event(match before {
            StateKind::Edge => Event::Tip,
            StateKind::TwoVertex | StateKind::Corner => Event::Lift,
            StateKind::NonContact | StateKind::SingleVertex | StateKind::Locked => match after {
                StateKind::Edge | StateKind::TwoVertex | StateKind::Corner => Event::Lift,
                StateKind::NonContact | StateKind::SingleVertex | StateKind::Locked => Event::Tip,
            },
        });
    }
}
