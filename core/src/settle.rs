//! 4: the transition table (STATICS 8) in operation: (state, trigger) -> (state, what to do next), in a bounded loop at a frozen hand until
//! the body rests.

use crate::contact::{Pair, Pairs, Regime};
use crate::event::{Event, StateKind, Status};
use crate::grip::Grip;
use crate::list::gather;
use crate::log::Log;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::sign::Sign;
use crate::state::{ContactState, Free, Slip};
use crate::thresholds::Thresholds;
use crate::transition::{
    Transition, clear_arm, fold_arm, halt_arm, keep_arm, rest_arm, slide_arm, slip_arm, touch_arm,
};
use crate::verb::{Moved, Relax, Trigger};
use crate::world::World;

/// What a state does next at a frozen hand, and in which direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Next<R> {
    /// It rests.
    Rest,
    /// Comes to balance; with a sign, while slipping.
    Relax(Option<R>),
    /// Turns on over the fold.
    Snap(R),
    /// Slips along sign·t.
    Slip(R),
}

impl<A> Next<A> {
    fn map<B>(self, sign: impl Fn(A) -> B) -> Next<B> {
        match self {
            Self::Rest => Next::Rest,
            Self::Relax(sliding) => Next::Relax(sliding.map(sign)),
            Self::Snap(direction) => Next::Snap(sign(direction)),
            Self::Slip(along) => Next::Slip(sign(along)),
        }
    }
}

/// After this many transitions at one hand pose no consistent mode is left to try.
const MAX_TRANSITIONS: u8 = 255;

/// A body that comes to rest at a frozen hand, verb by verb.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Settling<R> {
    next: Next<Sign>,
    /// The number of verbs so far.
    transitions: u8,
    tried: Tried,
    /// The state in which it began, and whether it slid.
    before: (StateKind, bool),
    /// A slip in progress.
    under_way: Option<Slip<R>>,
}

impl<R: Real> Settling<R> {
    /// For a body that was in the state `before`, beginning with `next`.
    pub(crate) fn of(before: (StateKind, bool), next: Next<R>) -> Self {
        Self {
            next: next.map(Sign::of),
            transitions: 0,
            tried: Tried::default(),
            before,
            under_way: None,
        }
    }

    /// At a frozen hand that has jumped there: a sliding contact sticks or slips first.
    pub(crate) fn after_jump(state: &ContactState<R>) -> Self {
        Self::of(state.motion(), Next::Relax(None))
    }

    /// It rests.
    pub(crate) fn is_over(&self) -> bool {
        self.next == Next::Rest
    }

    /// Executes the next verb; returns its cost in units of work, and whether the body rests after it.
    pub(crate) fn go_on(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        state: &mut ContactState<R>,
        log: &mut Log<R>,
    ) -> (u32, bool) {
        let work = if self.next == Next::Rest {
            0
        } else {
            self.verb(scene, grip, state, log)
        };
        let is_last = self.transitions == MAX_TRANSITIONS;
        self.transitions = self.transitions.saturating_add(1);
        if self.next == Next::Rest {
            if state.regime() == Regime::LOOSE {
                state.renew(scene, grip);
            }
        } else if is_last {
            stays(log);
        } else {
            return (work, false);
        }
        log_slide(state, self.before, log);
        (work, true)
    }

    /// Executes the next verb at the frozen hand, logs what it did and looks up what follows (STATICS 8); returns its cost in units of
    /// work.
    fn verb<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        state: &mut ContactState<R>,
        log: &mut Log<R>,
    ) -> u32 {
        let mut work = state.verb_work();
        let next = self.next.map(Sign::number);
        let had_stiction = state.regime().has_stiction();
        let (before, asked) = (state.clone(), self.clone());
        let begin = self.tried.any().then(|| state.placed(scene));
        let under_way = &mut self.under_way;
        let moved = match next {
            Next::Rest => Moved::by(Trigger::Balanced),
            Next::Relax(sliding) => {
                if !had_stiction {
                    state.set_regime(Regime::LOOSE);
                }
                let tried = self.tried.next(state.kind());
                state.relax(scene, grip, Relax { sliding, tried })
            }
            Next::Slip(sign) => state.slip(scene, grip, (sign, under_way)),
            Next::Snap(direction) => state.snap(scene, grip, (direction, under_way)),
        };
        if begin.is_some_and(|begin| !state.placed(scene).is_near(&begin, nowhere(scene))) {
            self.tried = Tried::default();
        }
        let gets_on = moved.unsure && *state != before;
        if gets_on && let Next::Relax(_) | Next::Snap(_) = next {
            // Nothing has happened up to where the evaluations led: continue from there.
            record(state, &moved, (&next, false), log);
            if let Next::Snap(_) = next {
                self.next = Next::Relax(None);
            }
        } else if moved.trigger != Trigger::GoesOn {
            let is_lost = moved.unsure && !gets_on;
            record(state, &moved, (&next, is_lost), log);
            let sliding = match next {
                Next::Slip(sign) => sign,
                _ => R::ZERO,
            };
            // A contact that slides on has not slipped; one that moved and sticks has, with stiction or without.
            let sticks = state.regime().slide().is_none() && moved.slip.abs() > R::MICRO;
            if moved.trigger == Trigger::Stopped && (had_stiction || sticks) {
                log.transitions.add(slip_arm(state));
                log.slip(moved.slip);
            }
            work = work.saturating_add(state.passing_work(scene, &moved.trigger));
            self.next = apply((scene, grip), state, &moved, sliding, log).map(Sign::of);
        }
        // A verb that changes nothing would be repeated for ever.
        if *self == asked && *state == before {
            self.transitions = MAX_TRANSITIONS;
        }
        work.saturating_add(moved.work)
    }
}

/// Logs where a slide begins and ends, for a body that was in a state and perhaps slid.
pub(crate) fn log_slide<R: Real>(
    state: &ContactState<R>,
    (before, slid): (StateKind, bool),
    log: &mut Log<R>,
) {
    let kind = state.kind();
    let slides = state.regime().slide().is_some();
    if slides && !slid {
        log.transitions.add(slide_arm(state));
        log.event(Event::Slide);
    } else if slid && !slides && kind != StateKind::NonContact {
        if kind == before {
            log.transitions.add(halt_arm(state));
        }
        log.event(Event::Stop);
    }
}

/// A verb that moved the body no farther than this, including the turn, has not moved it. Among obstacles a contact leaves its side a touch
/// beyond the end and comes back from the next one a touch beyond the other end, twice if the body turns as far: that is no progress.
fn nowhere<R: Real, W: World<R>>(_: &W) -> R {
    if W::CORNERS {
        R::MICRO.max(R::TOUCH * R::from_int(4))
    } else {
        R::MICRO
    }
}

/// The number of motions of contacts that fix the pose that were tried without moving the body since a verb last moved it.
#[derive(Clone, Debug, Default, PartialEq)]
struct Tried {
    two_vertex: u8,
    locked: u8,
}

impl Tried {
    fn any(&self) -> bool {
        *self != Self::default()
    }

    /// Counts one more, and returns the number of those before it.
    fn next(&mut self, kind: StateKind) -> usize {
        let tried = match kind {
            StateKind::TwoVertex => &mut self.two_vertex,
            StateKind::Locked => &mut self.locked,
            _ => return 0,
        };
        let before = *tried;
        *tried = before.saturating_add(1);
        usize::from(before)
    }
}

/// Logs what a verb has done in addition to its trigger, and whether its searches made no progress.
fn record<R: Real>(
    state: &ContactState<R>,
    moved: &Moved<R>,
    (next, is_lost): (&Next<R>, bool),
    log: &mut Log<R>,
) {
    if is_lost {
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

/// Continues from where a search gave up, up to which nothing has happened.
fn on<R: Real>(sliding: R) -> Next<R> {
    Next::Relax((sliding != R::ZERO).then_some(sliding))
}

/// The table: the state after a verb that slid along sliding·t, and what it does next. A call of its own, like the verbs.
#[inline(never)]
pub(crate) fn apply<R: Real, W: World<R>>(
    (scene, grip): (&W, &Grip<R>),
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
        Trigger::Pressed | Trigger::Halts | Trigger::Bears | Trigger::GoesOn => Next::Rest,
        Trigger::Stopped => {
            if moved.unsure || moved.unbalanced {
                return Next::Relax(Some(sliding));
            }
            Next::Rest
        }
        Trigger::Slide(sign) => Next::Slip(sign),
        // No branch of balance has ended: the body turns as its moment demands.
        Trigger::Fold(_) if W::CORNERS && moved.unbalanced => on(sliding),
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
            // A slip goes on past it while it is driven: at a landing N and T are continuous (rule 10 b).
            on(sliding)
        }
        Trigger::Keep { contacts, sliding } if W::SEVERAL => {
            keep(scene, state, contacts, sliding, log)
        }
        Trigger::Off { contact, sign } if W::CORNERS => {
            pass_on(scene, state, (contact, sign), grip, log)
        }
        Trigger::Clear if moved.unsure => on(sliding),
        Trigger::Clear => {
            log.transitions.add(clear_arm(state));
            log.event(Event::Lift);
            *state = ContactState::Free(Free::leaving(scene, state));
            Next::Relax(None)
        }
        Trigger::Keep { .. } | Trigger::Undriven | Trigger::Off { .. } => {
            undriven(scene, state, log)
        }
    }
}

/// A contact that slides has left its side. It is passed on to the contact at the same place whose normal comes next as the normal turns
/// towards the slide, followed by a slip in the same direction. If the new normal is not pressed the body is free, and of two contacts the
/// new one opens (STATICS 12.4).
fn pass_on<R: Real, W: World<R>>(
    scene: &W,
    state: &mut ContactState<R>,
    (index, sign): (usize, R),
    grip: &Grip<R>,
    log: &mut Log<R>,
) -> Next<R> {
    let contacts = state.contacts();
    let Some(&left) = contacts.get(index) else {
        return Next::Relax(None);
    };
    if state.kind() == StateKind::Edge {
        return pass_end_on(scene, state, (left, sign));
    }
    let stiction = state.regime().has_stiction();
    let placed = state.placed(scene);
    let mut others = contacts.clone();
    others.retain(|&pair| pair != left);
    if sign == R::ZERO {
        return turn_on(scene, state, (left, &others));
    }
    if let Some((at_end, pair)) = wall_ahead(scene, state, (left, sign)) {
        *state = at_end;
        touch(scene, state, pair, log);
        return on(sign);
    }
    let next = placed.next_contact(scene, (left, sign), &contacts);
    let pose = state.pose(scene);
    let pressed = next.filter(|&next| {
        let load = state.load(scene, grip);
        let normal = scene.face(next, pose.orientation.rotation()).normal;
        !others.is_empty() || -normal.dot(load.force) > load.rounding()
    });
    let lasting: Pairs = gather(pressed.into_iter().chain(others.iter().copied()));
    let Some((&first, others)) = lasting.split_first() else {
        log.transitions.add(clear_arm(state));
        log.event(Event::Lift);
        *state = ContactState::Free(Free::leaving(scene, state));
        return Next::Relax(None);
    };
    *state = ContactState::seated(scene, pivot_of(scene, state, first), others);
    state.set_regime(Regime::Stick { stiction });
    match state.kind() {
        StateKind::SingleVertex => Next::Slip(sign),
        _ => Next::Relax(Some(sign)),
    }
}

/// If a wall rises from the end of a side, a slide along sign·t ends in a touch, even if a search with few digits has found the end of the
/// side first: returns the state there, and the contact.
fn wall_ahead<R: Real, W: World<R>>(
    scene: &W,
    state: &ContactState<R>,
    (left, sign): (Pair, R),
) -> Option<(ContactState<R>, Pair)> {
    let mut at_end = state.clone();
    if let ContactState::SingleVertex(s) = &mut at_end {
        s.pivot.go_to_end(scene, sign);
    }
    let placed = at_end.placed(scene);
    let contacts = at_end.contacts();
    let rotation = placed.orientation.rotation();
    let ahead = scene.face(left, rotation).tangent * sign;
    let touching = placed.touching(scene, R::met_before());
    let mut walls = touching.iter().copied().filter(|&pair| {
        let is_taken = |&other: &Pair| other == pair || placed.are_one(scene, [other, pair]);
        let normal = scene.face(pair, rotation).normal;
        normal.dot(ahead) < -R::MICRO && !contacts.iter().any(is_taken)
    });
    let pair = walls.next()?;
    Some((at_end, pair))
}

/// A body that turns about a contact at the end of a side has turned to the end of what supports that contact: the contact at the same
/// place whose normal comes next supports it from there on.
fn turn_on<R: Real, W: World<R>>(
    scene: &W,
    state: &mut ContactState<R>,
    (left, others): (Pair, &[Pair]),
) -> Next<R> {
    let (placed, regime) = (state.placed(scene), state.regime());
    let Some(next) = placed.next_at_tip(scene, left) else {
        return Next::Relax(None);
    };
    let is_beside = |&&other: &&Pair| !placed.are_one(scene, [next, other]);
    let others: Pairs = gather(others.iter().filter(is_beside).copied());
    *state = ContactState::seated(scene, pivot_of(scene, state, next), &others);
    state.set_regime(regime);
    Next::Relax(None)
}

/// An edge that slides along sign·t has lost one of its contacts at the end of a side. If another one takes its place in the same line,
/// nothing has changed: the slide or slip goes on. If its line ends elsewhere now, or the contact is passed on to another line or to none,
/// the body comes to balance first.
fn pass_end_on<R: Real, W: World<R>>(
    scene: &W,
    state: &mut ContactState<R>,
    (left, sign): (Pair, R),
) -> Next<R> {
    let regime = state.regime();
    let placed = state.placed(scene);
    let contacts = state.contacts();
    let mut lasting = contacts.clone();
    lasting.retain(|&pair| pair != left);
    let Some(&lasts) = lasting.first() else {
        return Next::Relax(None);
    };
    let next = (placed.next_end(scene, (left, sign), &lasting))
        .or_else(|| placed.next_contact(scene, (left, sign), &contacts));
    // The remaining contact keeps its position.
    let pivot = pivot_of(scene, state, lasts);
    let others: Pairs = gather(next);
    *state = ContactState::seated(scene, pivot, &others);
    let is_there = |next: Pair| {
        let apart = placed.arm_to(scene, next) - placed.arm_to(scene, left);
        apart.length_bound() <= R::MICRO.doubled()
    };
    let goes_on = state.kind() == StateKind::Edge && next.is_some_and(is_there);
    state.set_regime(match regime {
        Regime::Slide(_) if !goes_on => Regime::LOOSE,
        regime => regime,
    });
    match regime {
        _ if !goes_on => Next::Relax(Some(sign)),
        Regime::Slide(_) => Next::Rest,
        Regime::Stick { .. } => Next::Slip(sign),
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

/// A vertex at a surface that is not a contact yet.
fn another<R: Real, W: World<R>>(scene: &W, state: &ContactState<R>) -> Option<Pair> {
    let contacts = state.contacts();
    let placed = state.placed(scene);
    let touching = placed.touching(scene, R::TOUCH);
    let mut others = touching.iter().filter(|&&pair| {
        let is_taken = |&other: &Pair| W::CORNERS && placed.are_one(scene, [other, pair]);
        !contacts.contains(&pair) && !contacts.iter().any(is_taken)
    });
    others.next().copied()
}

/// A vertex reaches a surface; all that close together are handled together.
pub(crate) fn touch<R: Real, W: World<R>>(
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
    let placed = pivot.placed(scene);
    let touching = placed.touching(scene, R::TOUCH);
    let mut all = Pairs::new();
    let mut old = state.contacts();
    if W::CORNERS {
        // A body that turns about an overlap this short turns on about its other end.
        old.retain(|&contact| !placed.are_one(scene, [contact, pair]));
    }
    for &contact in old.iter().chain(&[pair]).chain(&touching) {
        let is_taken = |&other: &Pair| W::CORNERS && placed.are_one(scene, [other, contact]);
        if !all.contains(&contact) && !all.iter().any(is_taken) {
            // Of more than four surfaces the first four are kept.
            let _ = all.push(contact);
        }
    }
    let mut pivot = pivot;
    if W::CORNERS {
        all = placed.outermost(scene, &all);
        pivot = pivot_of(scene, state, all.first().copied().unwrap_or(pair));
    }
    let others = all.get(1..).unwrap_or_default();
    let stiction = state.regime().has_stiction();
    *state = ContactState::seated(scene, pivot, others);
    state.set_regime(Regime::Stick { stiction });
    if W::CORNERS && before == StateKind::Edge && state.kind() == before {
        // It ends elsewhere on the same line.
        return;
    }
    let (arm, event) = touch_arm(before, state.kind());
    log.transitions.add(arm);
    log.event(event);
}

/// Only one or two contacts last.
pub(crate) fn keep<R: Real>(
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
    let stiction = state.regime().has_stiction();
    *state = if first == second {
        ContactState::seated(scene, pivot, &[])
    } else {
        ContactState::seated(scene, pivot, &[second])
    };
    state.set_regime(Regime::Stick { stiction });
    let (arm, event) = keep_arm(before, state.kind(), sliding.is_some());
    log.transitions.add(arm);
    log.event(event);
    Next::Relax(sliding)
}

/// The pivot of one of the contacts of a state; the state's own pivot, to the bit, if it is that one.
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
