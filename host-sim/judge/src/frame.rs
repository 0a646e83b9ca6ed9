//! A record of a trace: SI units, world frame, angles unwrapped; and how the hand moves from one record to the next.

use crate::touch::share_vertex;
use stiction_core::{Event, StateKind as State, Status, Touch};

/// All events, in the order of messages.
pub(crate) const EVENTS: [Event; 11] = [
    Event::Touch,
    Event::Lift,
    Event::Slip,
    Event::Tip,
    Event::Land,
    Event::Snap,
    Event::Jam,
    Event::Grasp,
    Event::Release,
    Event::Slide,
    Event::Stop,
];

/// All statuses, in the order of messages and reports.
pub const STATUSES: [Status; 9] = [
    Status::Ok,
    Status::EventLimit,
    Status::IterationLimit,
    Status::Ambiguous,
    Status::Saturated,
    Status::HeldLast,
    Status::Jammed,
    Status::Behind,
    Status::Twist,
];

/// A contact of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The pair of touching features.
    pub touch: Touch,
    /// Where they touch (m).
    pub point: [f64; 2],
    /// The unit normal n towards the body, if the trace contains it.
    pub direction: Option<[f64; 2]>,
    /// N (N), on the body along n.
    pub normal: f64,
    /// T (N), on the body along the tangent (n_y, -n_x).
    pub friction: f64,
    /// 1 if it slides with the hand along the tangent, -1 if against it; 0 if it sticks. `None` in an older trace, in which
    /// contacts only stick and slip.
    pub sliding: Option<i8>,
}

impl Contact {
    /// Whether it sticks, or the trace does not report slides.
    pub(crate) fn rests(&self) -> bool {
        self.sliding.unwrap_or(0) == 0
    }
}

/// One record.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Time (s).
    pub t: f64,
    /// Hand: x, y (m), phi (rad).
    pub hand: [f64; 3],
    /// The hand holds the body.
    pub held: bool,
    /// Body: x, y (m), theta (rad).
    pub pose: [f64; 3],
    /// Depth coordinate (m).
    pub depth: f64,
    /// The contact state.
    pub state: State,
    /// The contacts.
    pub contacts: Vec<Contact>,
    /// False if the format had no space for all contacts.
    pub complete: bool,
    /// Force (N) and moment about the holding point (N·m) of the hand's springs on the body.
    pub wrench: [f64; 3],
    /// Slips that ended at mu_d N.
    pub slips: u32,
    /// What happened, in order; a run of equal events counts once.
    pub events: Vec<Event>,
    /// What limited the answer.
    pub status: Status,
    /// The fraction of the hand's displacement that the body has not yet followed, if the trace contains it.
    pub behind: Option<f64>,
}

impl Frame {
    /// Whether several contacts are all of one vertex, about which the body can turn.
    pub(crate) fn is_in_corner(&self) -> bool {
        let Some((first, others)) = self.contacts.split_first() else {
            return false;
        };
        let shares = |other: &Contact| share_vertex(first.touch, other.touch);
        !others.is_empty() && others.iter().all(shares)
    }

    /// Whether the body has followed the reported hand and is in balance with it: then every law applies.
    pub(crate) const fn is_followed(&self) -> bool {
        matches!(
            self.status,
            Status::Ok | Status::Twist | Status::EventLimit | Status::IterationLimit
        )
    }

    pub(crate) fn has_contacts_of(&self, other: &Self) -> bool {
        self.contacts.len() == other.contacts.len()
            && (self.contacts.iter()).all(|contact| other.contact(contact.touch).is_some())
    }

    /// Whether a hand holds the body in balance, with contacts that are all known.
    pub(crate) const fn is_usable(&self) -> bool {
        self.held && self.complete && self.is_followed()
    }

    /// Whether the hand grasped the body or let go of it.
    pub(crate) fn is_taken(&self) -> bool {
        let taken = |event: &Event| matches!(event, Event::Grasp | Event::Release);
        self.events.iter().any(taken)
    }

    /// Whether it has contacts and reports for each whether it slides.
    pub(crate) fn tells_slides(&self) -> bool {
        !self.contacts.is_empty() && (self.contacts.iter()).all(|contact| contact.sliding.is_some())
    }

    pub(crate) fn slides(&self) -> bool {
        !self.contacts.iter().all(Contact::rests)
    }

    /// The contact between the features of `touch`.
    pub(crate) fn contact(&self, touch: Touch) -> Option<&Contact> {
        (self.contacts.iter()).find(|contact| contact.touch == touch)
    }

    pub(crate) fn meets_obstacles(&self) -> bool {
        let mut touches = self.contacts.iter().map(|contact| contact.touch);
        touches.any(|touch| touch.obstacle().is_some())
    }
}
