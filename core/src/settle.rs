//! 4: the transition table (STATICS 8) at work: (state, trigger) -> (state, what to do next), in a bounded loop at a frozen hand
//! until the body rests.

use crate::contact::{Pair, Pairs};
use crate::detect::Placed;
use crate::event::{Event, StateKind, Status};
use crate::grip::Grip;
use crate::log::Log;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::state::{ContactState, Free};
use crate::transition::{Transition, clear_arm, fold_arm, keep_arm, rest_arm, slip_arm, touch_arm};
use crate::verb::{Moved, Relax, Trigger};
use crate::world::World;

/// What is to be done in a state at a frozen hand.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Next<R> {
    /// It rests.
    Rest,
    /// Come to balance; with a sign, while sliding.
    Relax(Option<R>),
    /// Turn on over the fold.
    Snap(R),
    /// Slide along sign·t.
    Slide(R),
}

/// After this many transitions at one hand pose no consistent mode is left to try.
const MAX_TRANSITIONS: usize = 256;

/// Brings the body to rest at a frozen hand, beginning with a trigger, or without one with the test of the state.
pub(crate) fn settle<R: Real>(
    scene: &impl World<R>,
    grip: &Grip<R>,
    state: &mut ContactState<R>,
    trigger: Option<Trigger<R>>,
    log: &mut Log<R>,
) {
    log.ambiguous = false;
    let mut attempts = Attempts::default();
    let mut next = match trigger {
        Some(trigger) => apply(scene, state, &Moved::by(trigger), R::ZERO, log),
        None => Next::Relax(None),
    };
    for _ in 0..MAX_TRANSITIONS {
        let moved = match next {
            Next::Rest => return,
            Next::Relax(sliding) => {
                let attempt = attempts.count(&state.placed(scene), state.kind());
                state.relax(scene, grip, Relax { sliding, attempt })
            }
            Next::Slide(sign) => state.slide(scene, grip, sign),
            Next::Snap(direction) => state.snap(scene, grip, direction),
        };
        record(state, &moved, &next, log);
        let sliding = match next {
            Next::Slide(sign) => sign,
            _ => R::ZERO,
        };
        next = apply(scene, state, &moved, sliding, log);
    }
    stays(log);
}

/// Counts how often a state of several contacts gives way at one and the same pose.
#[derive(Default)]
struct Attempts<R: Real> {
    two_vertex: Option<(Placed<R>, usize)>,
    locked: Option<(Placed<R>, usize)>,
}

impl<R: Real> Attempts<R> {
    fn count(&mut self, placed: &Placed<R>, kind: StateKind) -> usize {
        let record = match kind {
            StateKind::TwoVertex => &mut self.two_vertex,
            StateKind::Locked => &mut self.locked,
            _ => return 0,
        };
        // Contacts on surfaces almost in line are seated anew a little aside.
        let aside = R::MICRO * R::from_int(16);
        let count = match record {
            Some((last, count)) if placed.is_near(last, aside) => count.saturating_add(1),
            _ => 0,
        };
        *record = Some((*placed, count));
        count
    }
}

/// What a verb has done besides its trigger.
fn record<R: Real>(state: &ContactState<R>, moved: &Moved<R>, next: &Next<R>, log: &mut Log<R>) {
    if moved.unsure {
        log.limit(Status::IterationLimit);
    }
    if moved.snapped && !matches!(next, Next::Snap(_)) {
        log.event(Event::Snap);
        log.transitions.add(fold_arm(state));
    }
}

/// No motion is left to try.
fn stays<R: Real>(log: &mut Log<R>) {
    log.transitions.add(Transition::Stays);
    log.ambiguous = true;
}

/// From where a search gave up, up to which nothing has happened.
fn on<R: Real>(sliding: R) -> Next<R> {
    Next::Relax((sliding != R::ZERO).then_some(sliding))
}

/// The table: the state after a verb, which slid along sliding·t, and what it does next.
fn apply<R: Real, W: World<R>>(
    scene: &W,
    state: &mut ContactState<R>,
    moved: &Moved<R>,
    sliding: R,
    log: &mut Log<R>,
) -> Next<R> {
    match moved.trigger {
        Trigger::Balanced => {
            rests(state, log);
            Next::Rest
        }
        Trigger::Stopped => {
            log.transitions.add(slip_arm(state));
            log.slip(moved.slip);
            if moved.unsure || moved.unbalanced {
                Next::Relax(Some(sliding))
            } else {
                Next::Rest
            }
        }
        Trigger::Slide(sign) => Next::Slide(sign),
        Trigger::Fold(direction) => {
            log.transitions.add(fold_arm(state));
            log.event(Event::Snap);
            Next::Snap(direction)
        }
        Trigger::Touch(pair) => {
            let reached = if moved.unsure {
                another(scene, state)
            } else {
                Some(pair)
            };
            let Some(pair) = reached else {
                return on(sliding);
            };
            touch(scene, state, pair, log);
            Next::Relax(None)
        }
        Trigger::Keep { contacts, sliding } if W::SEVERAL => {
            keep(scene, state, contacts, sliding, log)
        }
        Trigger::Clear if moved.unsure => on(sliding),
        Trigger::Clear => {
            log.transitions.add(clear_arm(state));
            log.event(Event::Lift);
            let pose = state.pose(scene);
            *state = ContactState::Free(Free { pose });
            Next::Relax(None)
        }
        Trigger::Keep { .. } | Trigger::Undriven => undriven(scene, state, log),
    }
}

/// No motion of these contacts is consistent: others that were let go are taken back, to try the next one.
fn undriven<R: Real>(
    scene: &impl World<R>,
    state: &mut ContactState<R>,
    log: &mut Log<R>,
) -> Next<R> {
    if let Some(pair) = another(scene, state) {
        touch(scene, state, pair, log);
        return Next::Relax(None);
    }
    stays(log);
    Next::Rest
}

/// A vertex at a surface that is no contact yet.
fn another<R: Real>(scene: &impl World<R>, state: &ContactState<R>) -> Option<Pair> {
    let contacts = state.contacts();
    let touching = state.placed(scene).touching(scene, R::TOUCH);
    let mut others = touching.iter().filter(|pair| !contacts.contains(pair));
    others.next().copied()
}

/// A vertex reaches a surface; all that close together are taken together.
fn touch<R: Real, W: World<R>>(
    scene: &W,
    state: &mut ContactState<R>,
    pair: Pair,
    log: &mut Log<R>,
) {
    let before = state.kind();
    let pivot = pivot_of(
        scene,
        state,
        state.contacts().first().copied().unwrap_or(pair),
    );
    if !W::SEVERAL {
        *state = ContactState::seated(scene, pivot, &[]);
        log.transitions.add(Transition::FreeTouches);
        log.event(Event::Touch);
        return;
    }
    let touching = pivot.placed(scene).touching(scene, R::TOUCH);
    let mut all = Pairs::new();
    let old = state.contacts();
    for &contact in old.iter().chain(&[pair]).chain(&touching) {
        if !all.contains(&contact) {
            // Of more than four surfaces the first ones count.
            let _ = all.push(contact);
        }
    }
    let others = all.get(1..).unwrap_or_default();
    *state = ContactState::seated(scene, pivot, others);
    let (arm, event) = touch_arm(before, state.kind());
    log.transitions.add(arm);
    log.event(event);
}

/// Only one or two contacts last.
fn keep<R: Real>(
    scene: &impl World<R>,
    state: &mut ContactState<R>,
    lasting: [usize; 2],
    sliding: Option<R>,
    log: &mut Log<R>,
) -> Next<R> {
    let contacts = state.contacts();
    let [first, second] = lasting.map(|i| contacts.get(i).copied().unwrap_or_default());
    let pivot = pivot_of(scene, state, first);
    let before = state.kind();
    *state = if first == second {
        ContactState::seated(scene, pivot, &[])
    } else {
        ContactState::seated(scene, pivot, &[second])
    };
    let (arm, event) = keep_arm(before, state.kind(), sliding.is_some());
    log.transitions.add(arm);
    log.event(event);
    Next::Relax(sliding)
}

/// The pivot of one of the contacts of a state; the pivot itself, to the bit, where it is that one.
fn pivot_of<R: Real>(scene: &impl World<R>, state: &ContactState<R>, pair: Pair) -> Pivot<R> {
    match state.anchor() {
        Ok(pivot) if pivot.contact == pair => *pivot,
        _ => Pivot::at(scene, &state.pose(scene), pair),
    }
}

/// At rest in a state.
pub(crate) fn rests<R: Real>(state: &ContactState<R>, log: &mut Log<R>) {
    log.ambiguous = false;
    log.transitions.add(rest_arm(state));
}

#[cfg(test)]
mod tests;
