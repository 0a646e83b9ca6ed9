//! What a status excuses, and whether its frame shows the reported condition.
//!
//! * `held-last` and `saturated`: the hand's sample was not used, so the record repeats that of the previous frame except for its time.
//! * `event-limit`: there are as many events as the limit. The frame is in balance, and judged like any other.
//! * `behind`: the remaining fraction of the hand's displacement is reported.
//! * `jammed` and `ambiguous`: see [`of_balance`].
//! * `iteration-limit` and `twist` excuse nothing.

use stiction_core::{Event, StateKind as State, Status};

use crate::bearing::Bearing;
use crate::finding::Bounds;
use crate::frame::Frame;
use crate::model::{Grip, Model};
use crate::slip::{EVENTS, Step};
use crate::touch::Face;
use crate::yielding::can_move;

/// If the contacts of a body at one place have opened and closed this often, they would do so without end: the body has no more contacts
/// than this that could be the first to open.
const ROUNDS: usize = 4;

/// The smallest number of slips that justifies `event-limit`.
const SLIPS: u32 = 100;

/// Whether a status agrees with its frame alone, and with the previous frame.
pub(crate) fn reported(last: Option<&Frame>, next: &Frame) -> bool {
    let left = next.behind.is_some_and(|part| part > 0.0 && part <= 1.0);
    match next.status {
        Status::HeldLast | Status::Saturated => last.is_none_or(|last| repeats(last, next)),
        Status::EventLimit => next.slips >= SLIPS || next.events.len() >= EVENTS,
        Status::Behind => left,
        Status::Ok
        | Status::IterationLimit
        | Status::Ambiguous
        | Status::Jammed
        | Status::Twist => true,
    }
}

/// Whether a frame repeats another, except for the time, for a hand that does not hold, and for one that lets go.
fn repeats(last: &Frame, next: &Frame) -> bool {
    let lets_go = next.events == [Event::Release];
    let is_free = !last.held && !next.held;
    let same_forces = next.wrench == last.wrench && next.contacts == last.contacts;
    (is_free || next.hand == last.hand)
        && next.pose == last.pose
        && next.has_contacts_of(last)
        && (lets_go || (same_forces && next.events.is_empty() && next.slips == 0))
}

/// Whether a body that is reported to be out of balance could neither stay in balance nor move. `None` if no such status is reported.
pub(crate) fn of_balance(step: &Step<'_>) -> Option<bool> {
    let next = step.next;
    if next.status != Status::Ambiguous {
        return None;
    }
    // Nothing happens under a hand at rest: the finding on the previous frame holds for this one.
    let goes_on = step.last.status == next.status && repeats(step.last, next);
    if !next.complete || !next.held || goes_on {
        return None;
    }
    Some(is_stuck(step.model, step.bounds, step.grip, next))
}

/// Whether no reactions within friction bear the load of a body with several contacts, and no motion follows it; or whether motions
/// have followed one another without end.
fn is_stuck(model: &Model, bounds: &Bounds, grip: &Grip, frame: &Frame) -> bool {
    let several = matches!(
        frame.state,
        State::TwoVertex | State::Locked | State::Corner
    );
    let mu: fn(&Face) -> f64 = if frame.tells_slides() {
        |face| face.friction_dynamic
    } else {
        |face| face.friction_static
    };
    let contacts = Bearing::new(model, bounds, grip, frame, mu);
    let limit = model.limit();
    let opens = frame.events.iter().filter(|&&event| event == Event::Lift);
    let goes_round = frame.events.len() >= EVENTS || opens.count() >= ROUNDS;
    let stays = goes_round || (several && !can_move(model, grip, frame));
    stays && !contacts.bears(frame.hand, bounds.slip, limit)
}
