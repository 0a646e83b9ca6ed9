//! 4: an event on the path of the hand (STATICS 7): the body is in balance, and the hand is about to go on. The rates of this motion
//! determine what the event leads to; if it is a jump, the body settles at the frozen hand.

use crate::contact::{Pair, Regime};
use crate::event::{Event, StateKind};
use crate::grip::Grip;
use crate::log::Log;
use crate::real::Real;
use crate::settle::{Next, Settling, apply, keep, touch};
use crate::state::{ContactState, Free};
use crate::transition::{clear_arm, fold_arm};
use crate::verb::{Moved, Trigger};
use crate::work::Work;
use crate::world::World;

/// The hand at the event, and its destination.
type Path<'a, R> = (&'a Grip<R>, &'a Grip<R>);

/// What an event leads to.
enum Outcome<R> {
    /// It goes on at the same pose of the hand.
    Next(Next<R>),
    /// The contacts let go, but at this very pose the load is still borne: the body settles where the hand is beyond the rounding.
    Release,
}

/// The consequence of a trigger of `advance`: the state in balance, or how it settles.
#[inline(never)]
pub(crate) fn happens<R: Real, W: World<R>>(
    scene: &W,
    (at, to): (&mut Grip<R>, &Grip<R>),
    state: &mut ContactState<R>,
    trigger: Trigger<R>,
    (work, log): (&mut Work, &mut Log<R>),
) -> Settling<R> {
    log.ambiguous = false;
    let before = state.motion();
    let next = match outcome(scene, (at, to), state, trigger, (work, log)) {
        Outcome::Next(next) => next,
        Outcome::Release => {
            *at = at.toward(scene, to, state.release(scene, at, work));
            Next::Relax(None)
        }
    };
    Settling::of(before, next)
}

/// What each trigger of `advance` leads to, with the hand at the beginning of `path` (STATICS 7).
fn outcome<R: Real, W: World<R>>(
    scene: &W,
    path: Path<'_, R>,
    state: &mut ContactState<R>,
    trigger: Trigger<R>,
    (work, log): (&mut Work, &mut Log<R>),
) -> Outcome<R> {
    match trigger {
        Trigger::Touch(pair) => touches(scene, path, state, pair, (work, log)),
        Trigger::Slide(sign) => yields(scene, path, state, sign, (work, log)),
        Trigger::Pressed => {
            state.set_regime(Regime::Stick { stiction: true });
            Outcome::Next(Next::Rest)
        }
        Trigger::Halts => {
            match state {
                // A contact that bears nothing may go back.
                ContactState::SingleVertex(s)
                    if s.swings(scene, path.0) && !s.leans(scene, path.0) =>
                {
                    s.begin(scene, path);
                }
                _ => state.set_regime(Regime::LOOSE),
            }
            Outcome::Next(Next::Rest)
        }
        Trigger::Bears => bears(scene, path, state),
        Trigger::Clear => leaves(scene, path, state, log),
        Trigger::Keep {
            contacts: [first, second],
            sliding,
        } if W::SEVERAL && first == second => opens(scene, path, state, (first, sliding), log),
        Trigger::Keep { .. } if W::SEVERAL => Outcome::Release,
        Trigger::Fold(direction) => {
            log.transitions.add(fold_arm(state));
            log.event(Event::Snap);
            Outcome::Next(Next::Snap(direction))
        }
        _ => Outcome::Next(apply(
            (scene, path.0),
            state,
            &Moved::by(trigger),
            R::ZERO,
            log,
        )),
    }
}

/// A vertex reaches a surface: from free flight the rates decide (rule 6); after further contacts, sticking goes on and, if the motion
/// permits, sliding goes on (rules 10 a, b, g).
fn touches<R: Real, W: World<R>>(
    scene: &W,
    path: Path<'_, R>,
    state: &mut ContactState<R>,
    pair: Pair,
    (work, log): (&mut Work, &mut Log<R>),
) -> Outcome<R> {
    let (before, regime) = (state.kind(), state.regime());
    let bears = match state {
        ContactState::SingleVertex(s) => !s.swings(scene, path.0) || s.leans(scene, path.0),
        _ => true,
    };
    touch(scene, state, pair, log);
    match (before, regime, &mut *state) {
        (StateKind::NonContact, _, ContactState::SingleVertex(s)) => s.begin(scene, path),
        (StateKind::NonContact, _, ContactState::Edge(s)) => s.begin(scene, path),
        (StateKind::NonContact, ..) => {}
        (_, Regime::Stick { .. }, state) => state.set_regime(regime),
        // A contact that bears nothing is treated as one that has just been touched.
        (StateKind::SingleVertex, Regime::Slide(_), ContactState::Edge(s)) if !bears => {
            s.begin(scene, path);
        }
        (StateKind::SingleVertex, Regime::Slide(_), ContactState::Edge(s)) => s.regime = regime,
        // It ends elsewhere on the same line.
        (StateKind::Edge, Regime::Slide(_), ContactState::Edge(s)) if W::CORNERS => {
            s.regime = regime;
        }
        (StateKind::SingleVertex, Regime::Slide(sign), ContactState::TwoVertex(s))
            if W::SURFACES =>
        {
            s.slide_on(scene, path, (sign, work));
        }
        (_, Regime::Slide(_), state) => state.set_regime(Regime::LOOSE),
    }
    Outcome::Next(Next::Rest)
}

/// Friction gives way: with stiction in a slip (rule 4), without it in a slide that begins without a jump (rules 5, 10 e).
fn yields<R: Real, W: World<R>>(
    scene: &W,
    path: Path<'_, R>,
    state: &mut ContactState<R>,
    sign: R,
    (work, log): (&mut Work, &mut Log<R>),
) -> Outcome<R> {
    if state.regime().has_stiction() {
        return Outcome::Next(Next::Slip(sign));
    }
    match state {
        ContactState::SingleVertex(s) => {
            if let Some(direction) = s.topples(scene, path.0, sign) {
                if W::CORNERS {
                    // A slip that begins at the edge of the cone and is driven more the farther it goes.
                    log.transitions.add(fold_arm(state));
                    log.event(Event::Snap);
                    return Outcome::Next(Next::Slip(sign));
                }
                s.regime = Regime::Slide(sign);
                log.transitions.add(fold_arm(state));
                log.event(Event::Snap);
                return Outcome::Next(Next::Snap(direction));
            }
            if s.swings(scene, path.0) && !s.is_leaning(scene, path.0, sign) {
                s.begin(scene, path);
                let slide = s.regime.slide();
                return if slide.is_some_and(|sign| s.swings_in_balance(scene, path.0, sign)) {
                    Outcome::Next(Next::Rest)
                } else {
                    Outcome::Release
                };
            }
            if s.recedes(scene, path, sign) {
                return Outcome::Release;
            }
            if s.swings(scene, path.0) {
                s.lean_on(scene, path.0, sign);
            }
            s.regime = Regime::Slide(sign);
            Outcome::Next(Next::Rest)
        }
        ContactState::Edge(s) => {
            if s.recedes(scene, path, sign) {
                return Outcome::Release;
            }
            s.regime = Regime::Slide(sign);
            Outcome::Next(Next::Rest)
        }
        ContactState::TwoVertex(s) if W::SURFACES => match s.begin_slide(scene, path, work) {
            Some(regime) => {
                s.regime = regime;
                Outcome::Next(Next::Rest)
            }
            None => Outcome::Release,
        },
        _ => Outcome::Release,
    }
}

/// The lever of a body that swings has come to lie on the edge of the friction cone: the contact bears, unless the lever stands upright
/// there.
fn bears<R: Real>(
    scene: &impl World<R>,
    path: Path<'_, R>,
    state: &mut ContactState<R>,
) -> Outcome<R> {
    match state {
        ContactState::SingleVertex(s) if s.stands(scene, path.0) => Outcome::Release,
        ContactState::SingleVertex(s) => {
            s.bears(scene, path);
            Outcome::Next(Next::Rest)
        }
        _ => Outcome::Next(Next::Rest),
    }
}

/// N falls to zero. The vertex leaves its surface if the hand lifts it off; otherwise a sticking contact slides, and a sliding one sticks
/// (rule 6).
fn leaves<R: Real, W: World<R>>(
    scene: &W,
    path: Path<'_, R>,
    state: &mut ContactState<R>,
    log: &mut Log<R>,
) -> Outcome<R> {
    match state {
        ContactState::SingleVertex(s) if !W::GLIDES && !s.leaves(scene, path) => {
            if s.regime.slide().is_some() {
                s.regime = Regime::LOOSE;
            } else {
                s.begin(scene, path);
            }
            Outcome::Next(Next::Rest)
        }
        ContactState::SingleVertex(s) => {
            let topples = s.topples_free(scene, path.0);
            // On its way to where it hangs, a body this near would touch the same corner again.
            let found_to = if s.is_corner(scene) {
                s.found_to_at(scene, path.0)
            } else {
                R::ZERO
            };
            log.transitions.add(clear_arm(state));
            log.event(Event::Lift);
            let free = Free::leaving(scene, state);
            let near = free.is_near_balance(scene, path.0, found_to);
            *state = ContactState::Free(free);
            // A body that no force holds may be far from its pose under the hand alone.
            Outcome::Next(match topples {
                Some(direction) => Next::Snap(direction),
                None if near => Next::Rest,
                None => Next::Relax(None),
            })
        }
        _ => Outcome::Next(apply(
            (scene, path.0),
            state,
            &Moved::by(Trigger::Clear),
            R::ZERO,
            log,
        )),
    }
}

/// All contacts but one open. The remaining one goes on as before: it sticks or slides (rule 10 a, b), in balance if it was so before.
fn opens<R: Real, W: World<R>>(
    scene: &W,
    path: Path<'_, R>,
    state: &mut ContactState<R>,
    (lasts, sliding): (usize, Option<R>),
    log: &mut Log<R>,
) -> Outcome<R> {
    let regime = state.regime();
    let contacts = state.contacts();
    let kind = state.kind();
    let before = state.clone();
    let next = keep(scene, state, [lasts; 2], sliding, log);
    let Some(sign) = regime.slide() else {
        // A body that turns about a sticking contact is in balance where the others let go.
        return match state {
            _ if kind == StateKind::Edge => Outcome::Next(Next::Rest),
            ContactState::SingleVertex(s)
                if sliding.is_none()
                    && s.is_found(scene, path.0)
                    && (!W::CORNERS || s.is_in_cone(scene, path.0)) =>
            {
                // Outside its cone it slips at the frozen hand.
                Outcome::Next(if s.is_in_cone(scene, path.0) {
                    Next::Rest
                } else {
                    next
                })
            }
            _ if kind == StateKind::Corner => Outcome::Next(next),
            _ => {
                *state = before;
                Outcome::Release
            }
        };
    };
    let other = contacts.iter().copied().enumerate();
    let other = other
        .filter(|&(i, _)| i != lasts)
        .map(|(_, pair)| pair)
        .next();
    if let (ContactState::SingleVertex(s), Some(other)) = (&mut *state, other) {
        let along = sliding.unwrap_or(sign);
        if !s.slide_on(scene, path.0, along) {
            return Outcome::Next(Next::Relax(None));
        }
        if s.swings(scene, path.0) {
            // A single vertex that slides bears nothing: it may stick instead.
            s.begin(scene, path);
        }
        if s.regime.slide().is_none() {
            return Outcome::Next(Next::Rest);
        }
        if W::CORNERS && kind == StateKind::TwoVertex && s.topples(scene, path.0, along).is_some() {
            // On its own its slide is not stable: it slips to where it no longer blocks the other one.
            let mut senses = [along, -along].into_iter();
            if let Some(sign) = senses.find(|&sign| s.slips_off(scene, path.0, (other, sign))) {
                s.regime = Regime::LOOSE;
                return Outcome::Next(Next::Slip(sign));
            }
        }
        if W::SURFACES && kind == StateKind::TwoVertex && !s.opens(scene, path, (other, along)) {
            // It cannot leave: both stick.
            touch(scene, state, other, log);
            state.set_regime(Regime::LOOSE);
        } else {
            // A contact that is pressed this hard does not slide on its own.
            state.renew(scene, path.0);
        }
    }
    Outcome::Next(Next::Rest)
}

#[cfg(test)]
mod tests;
