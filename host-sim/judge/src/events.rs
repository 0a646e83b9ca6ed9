//! Events from frame to frame: contacts appear and disappear as reported, the body moves if an event says so, slips are counted, and a
//! balance snaps where its branch folds and nowhere else.
//!
//! **Contacts.** `touch`, `land` and `jam` add contacts, `lift` and `tip` remove some; among half-planes no other event does. Each leads
//! from certain states to certain states, and a run of equal events is reported once. So the reported events must lead from the state of
//! the previous frame to that of this one; otherwise they are not what happened. Among obstacles, a slip or slide can replace contacts by
//! others without an event.

use std::cmp::Ordering;

use stiction_core::{Event, Evolution, StateKind as State, Touch};

use crate::finding::{Bounds, Finding, law};
use crate::frame::{Contact, Frame};
use crate::model::{Grip, Model};
use crate::obstacles::placed;
use crate::pairs::Facing;
use crate::pin::{Foot, Pin, Spot, follow};
use crate::slide::is_idle;
use crate::slip::{EVENTS, Step};
use crate::vector::{between, distance, length, sub};

/// Positions that differ by at most this many roundings of the farthest coordinate are equal.
const SAME: f64 = 8.0;

pub(crate) struct Events<'a> {
    pub(crate) model: &'a Model,
    pub(crate) last: &'a Frame,
    pub(crate) next: &'a Frame,
}

impl Events<'_> {
    /// The findings on events in a frame, given the previous one; if the hand did not hold in both, only those on contacts and slips.
    pub(crate) fn findings(
        &self,
        bounds: &Bounds,
        evolution: Evolution,
        grip: Option<&Grip>,
    ) -> Vec<Finding> {
        let (model, frames) = (self.model, (self.last, self.next));
        let whether = |law: &'static str, holds: Option<bool>| {
            holds.map(|holds| Finding::whether(law, holds))
        };
        let all = [
            whether(law::COME_AND_GO, is_accounted(model, evolution, frames)),
            whether(law::SLIPS, are_counted(self.next)),
            whether(law::MOVES, moves(model, bounds, grip, frames)),
        ];
        all.into_iter().flatten().collect()
    }
}

/// Whether the event adds a contact.
const fn brings(event: Event) -> bool {
    matches!(event, Event::Touch | Event::Land | Event::Jam)
}

/// Whether the event removes a contact.
const fn takes(event: Event) -> bool {
    matches!(event, Event::Lift | Event::Tip)
}

/// Whether a contact may be replaced at an end of its side without an event.
fn passes_on(model: &Model, last: &Frame, next: &Frame) -> bool {
    let glides = |event: &Event| matches!(event, Event::Slip | Event::Slide | Event::Stop);
    let moves = last.slides() || next.slides() || next.events.iter().any(glides);
    // A flat contact gets a new end when another contact appears or disappears.
    let is_locked = [last, next]
        .iter()
        .any(|frame| frame.state == State::Locked);
    !model.scene.obstacles.is_empty() && (moves || (is_locked && !next.events.is_empty()))
}

/// Whether contacts appear and disappear as reported. `None` if a list ended before the frame did.
fn is_accounted(
    model: &Model,
    evolution: Evolution,
    (last, next): (&Frame, &Frame),
) -> Option<bool> {
    if !last.complete || !next.complete || next.events.len() >= EVENTS {
        return None;
    }
    let brings = next.events.iter().any(|&event| brings(event));
    let takes = next.events.iter().any(|&event| takes(event));
    let reported = (next.contacts.len().cmp(&last.contacts.len()), brings, takes);
    let sets = if passes_on(model, last, next) {
        match reported {
            (Ordering::Equal, false, false) | (Ordering::Greater, true, false) => true,
            (Ordering::Less, false, true) | (_, true, true) => true,
            // Another contact may replace the one that opened.
            (Ordering::Equal, false, true) => next.events.len() > 1,
            _ => false,
        }
    } else {
        let comes = !next
            .contacts
            .iter()
            .all(|c| last.contact(c.touch).is_some());
        let goes = !last
            .contacts
            .iter()
            .all(|c| next.contact(c.touch).is_some());
        (comes, goes) == (brings, takes) || (brings && takes)
    };
    Some(sets && leads(model, evolution, last, next))
}

/// A state, and whether its contacts slide, as far as it is reported.
type Stage = (State, bool);

/// Whether the events lead from one frame to another.
fn leads(model: &Model, evolution: Evolution, last: &Frame, next: &Frame) -> bool {
    let among_obstacles = !model.scene.obstacles.is_empty();
    let mut stages = vec![(last.state, last.slides())];
    for (i, &event) in next.events.iter().enumerate() {
        // A sliding contact slips when the hand jumps, as it does after the first event of a frame, when the angle snaps, or at an end
        // of a side.
        let snapped = next.events[..i].contains(&Event::Snap);
        let passed = among_obstacles && (i > 0 || !next.has_contacts_of(last));
        let jumps = passed || snapped || (evolution == Evolution::Frame && i > 0);
        let passes = among_obstacles && next.events.len() > 1;
        let mut reached: Vec<Stage> = Vec::new();
        let mut ahead = stages;
        // A run of equal events is reported once.
        while let Some(stage) = ahead.pop() {
            for next in after(stage, event, [passes, jumps]) {
                if !reached.contains(&next) {
                    reached.push(next);
                    ahead.push(next);
                }
            }
        }
        stages = reached;
    }
    // If no event is reported, other laws judge the slides.
    let is_next = |&(state, slides): &Stage| {
        state == next.state && (next.events.is_empty() || slides == next.slides())
    };
    stages.iter().any(is_next)
}

/// The stages that an event can lead to. A slide begins and ends as reported, and ends without an event if nothing touches any more.
fn after((state, slides): Stage, event: Event, [passes, jumps]: [bool; 2]) -> Vec<Stage> {
    use State::{Corner, Edge, Locked, NonContact, SingleVertex, TwoVertex};
    let glides = matches!(state, SingleVertex | Edge | TwoVertex);
    let all: &[State] = match (event, state) {
        (Event::Touch, NonContact) => &[SingleVertex, TwoVertex, Corner],
        (Event::Touch, SingleVertex) => &[TwoVertex, Corner],
        (Event::Land, NonContact | SingleVertex) => &[Edge],
        (Event::Jam, _) => &[Locked],
        (Event::Tip, Edge | Locked) => &[SingleVertex],
        (Event::Lift, SingleVertex | Edge) => &[NonContact],
        // At an end of a side, another contact may replace the one of the two that opened.
        (Event::Lift, TwoVertex) if passes => &[NonContact, SingleVertex, TwoVertex],
        (Event::Lift, TwoVertex | Corner) => &[NonContact, SingleVertex],
        (Event::Lift, Locked) => &[NonContact, Edge, TwoVertex, Corner],
        (Event::Slide, _) if glides && !slides => return vec![(state, true)],
        (Event::Stop, _) if slides => return vec![(state, false)],
        (Event::Slip, _) if glides && (!slides || jumps) => return vec![(state, slides)],
        (Event::Snap, _) => return vec![(state, slides)],
        (Event::Grasp, _) => return vec![(state, slides)],
        // After a release, nothing slides.
        (Event::Release, _) => return vec![(state, slides), (state, false)],
        _ => &[],
    };
    // A sliding contact that opens and closes again immediately has not stopped.
    let lasts = |&state: &State| match state {
        NonContact if slides => vec![(state, false), (state, true)],
        NonContact => vec![(state, false)],
        _ => vec![(state, slides)],
    };
    all.iter().flat_map(lasts).collect()
}

/// Whether `slips` is at least the number of slips in `events`, and both are zero or neither is.
fn are_counted(next: &Frame) -> Option<bool> {
    let runs = next
        .events
        .iter()
        .filter(|&&event| event == Event::Slip)
        .count();
    if next.events.len() >= EVENTS {
        return None;
    }
    Some((runs == 0) == (next.slips == 0) && next.slips as usize >= runs)
}

/// Positions in the two frames that differ by no more than this are equal (m).
fn same(model: &Model, bounds: &Bounds, last: &Frame, next: &Frame) -> f64 {
    SAME * bounds.rounding * model.reach(last).max(model.reach(next))
}

/// Whether the body is where it was to within a few roundings, in position and angle.
fn is_still(model: &Model, bounds: &Bounds, last: &Frame, next: &Frame) -> bool {
    let same = same(model, bounds, last, next);
    let ways = placed(model, last.pose)
        .into_iter()
        .zip(placed(model, next.pose));
    ways.map(|(a, b)| distance(a, b)).fold(0.0, f64::max) <= same
        && model.size * (next.pose[2] - last.pose[2]).abs() <= same
}

/// Whether events that move the body have moved it, and a slip its contacts. If the force on the contacts is only rounding, a slip may
/// be that short.
fn moves(
    model: &Model,
    bounds: &Bounds,
    grip: Option<&Grip>,
    (last, next): (&Frame, &Frame),
) -> Option<bool> {
    let is_taken = |event: &Event| matches!(event, Event::Grasp | Event::Release);
    let reported: Vec<Event> = (next.events.iter().copied())
        .filter(|event| !is_taken(event))
        .collect();
    if reported.is_empty() || !next.has_contacts_of(last) || reported.len() >= EVENTS {
        return None;
    }
    // Events of a body that is out of balance may lead nowhere: contacts open and close again at the same place.
    if !next.is_followed() {
        return None;
    }
    let is_idle = |contact| grip.is_some_and(|grip| is_idle(model, bounds, grip, next, contact));
    if reported.contains(&Event::Slip) && next.contacts.iter().all(is_idle) {
        return None;
    }
    let same = same(model, bounds, last, next);
    let stays = |contact: &Contact| {
        let before = last.contact(contact.touch);
        let way = before.map(|before| {
            sub(
                model.mark(next.pose, contact),
                model.mark(last.pose, before),
            )
        });
        way.is_some_and(|way| length(way) <= same)
    };
    let slips_alone = reported
        .iter()
        .all(|event| matches!(event, Event::Slip | Event::Snap));
    if slips_alone && reported.contains(&Event::Slip) && next.contacts.iter().all(stays) {
        return Some(false);
    }
    // The start or end of a slide may be reported for a body that is only about to move.
    let is_about_to = matches!(reported[..], [Event::Slide | Event::Stop]);
    Some(is_about_to || !is_still(model, bounds, last, next))
}

/// Whether a balance snaps where its branch folds, and only there.
pub(crate) fn snaps(step: &Step<'_>) -> Option<bool> {
    let (last, next) = (step.last, step.next);
    let reported = match next.events.as_slice() {
        [] => false,
        [Event::Snap] => true,
        _ => return None,
    };
    if !next.has_contacts_of(last)
        || last.state != next.state
        || ![last, next].into_iter().all(Frame::is_usable)
    {
        return None;
    }
    let contact = match next.state {
        State::Edge | State::Locked => return Some(!reported),
        // Two sliding contacts may have a fold of their own.
        State::TwoVertex => return (!last.slides() && !next.slides()).then_some(!reported),
        State::NonContact => None,
        State::SingleVertex | State::Corner => Some(next.contacts.first()?),
    };
    let slide = match contact.and_then(|contact| contact.sliding) {
        None | Some(0) if !last.slides() => None,
        Some(sign) if sign != 0 && last.contacts[0].sliding == Some(sign) => Some(f64::from(sign)),
        _ => return None,
    };
    let touch = contact.map(|contact| contact.touch);
    let turns = matches!(touch, Some(Touch::Corner { .. }));
    if slide.is_some() && (turns || step.model.scene.stiffness_rotation == 0.0) {
        return None;
    }
    let pin = |part| pinned(step, (touch, slide), part);
    let Some(turn) = follow(pin, last.pose[2], 1.0) else {
        return Some(reported);
    };
    let is_followed = pin(1.0).on_one_branch(turn, next.pose[2]);
    Some(reported != is_followed)
}

/// The body turning about its previous contact, with a sliding contact, or about the hand.
fn pinned<'a>(step: &Step<'a>, (touch, slide): (Option<Touch>, Option<f64>), part: f64) -> Pin<'a> {
    let (model, last) = (step.model, step.last);
    let hand = between(last.hand, step.next.hand, part);
    let (facing, spot) = match touch {
        Some(touch) => (model.facing(touch), model.spot(last.pose, touch)),
        None => (
            Facing::World([0.0, 1.0]),
            Spot {
                held: step.grip.point,
                at: [hand[0], hand[1]],
            },
        ),
    };
    let foot = Foot {
        model,
        grip: step.grip,
        facing,
        shortest: model.carried(step.next, step.bounds),
    };
    match (touch, slide) {
        (Some(touch), Some(sign)) => {
            let face = model.face(last.pose, touch);
            foot.sliding(spot, hand, sign * face.friction_dynamic)
        }
        _ => foot.pinned(spot, hand),
    }
}
