//! Two vertices on two surfaces (STATICS 5): the pose is locked while an internal force between the contacts keeps both
//! reactions within their cones (E5); beyond that the body moves with one degree of freedom, like a trammel.

use super::locked::{first_yield, shared_reactions};
use super::trammel::{Ending, Trammel};
use super::{ContactState, Moved, Pair, Pairs, Reactions, Trigger};
use crate::coupling::{Grip, Pivot};
use crate::real::Real;
use crate::scene::Scene;

/// The memory: where the first contact is held, the fixed angle, the other contact.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TwoVertex<R> {
    pub(crate) pivot: Pivot<R>,
    pub(crate) other: Pair,
}

/// A slip goes at most this many times its window of one body size or radian.
const WINDOWS: usize = 16;

impl<R: Real> TwoVertex<R> {
    pub(crate) fn contacts(&self) -> Pairs {
        [self.pivot.contact, self.other].into_iter().collect()
    }

    /// Stays as the hand moves, as long as the interval of (E5) is not empty.
    pub(crate) fn advance<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        let (part, mut trigger) = first_yield(scene, &self.pivot, &self.contacts(), from, to);
        if let Trigger::Keep {
            contacts: [a, b],
            sliding: Some(sign),
        } = trigger
            && a != b
        {
            trigger = Trigger::Slide(sign);
        }
        Moved {
            part,
            ..Moved::new(ContactState::TwoVertex(self.clone()), trigger)
        }
    }

    /// Puts the contacts to the test as they are; a motion under way goes on while it is driven.
    pub(crate) fn relax<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
        sliding: Option<R>,
    ) -> Moved<R> {
        let mut moved = self.advance(scene, grip, grip);
        if let (Some(sign), Trigger::Balanced) = (sliding, moved.trigger)
            && Trammel::driven(scene, self, grip).is_some()
        {
            moved.trigger = Trigger::Slide(sign);
        }
        moved
    }

    /// Slides on both surfaces to the first of (E6), N_i = 0, touch.
    pub(crate) fn slide<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
    ) -> Moved<R> {
        let mut state = self.clone();
        let (mut slip, mut unsure) = (R::ZERO, false);
        let mut trigger = Trigger::Undriven;
        for _ in 0..WINDOWS {
            let Some(trammel) = Trammel::driven(scene, &state, grip) else {
                break;
            };
            let (part, ending) = trammel.run(scene, &state);
            slip = slip + part.slide;
            unsure |= part.unsure;
            state = state.moved(scene, part.slide, part.turn);
            trigger = match ending {
                Ending::Window | Ending::Reverses => Trigger::Stopped,
                Ending::Stopped => return state.stopped(Trigger::Stopped, slip, unsure),
                Ending::Touches(pair) => {
                    return state.stopped(Trigger::Touch(pair), slip, unsure);
                }
                Ending::Opens { lasts, sliding } => {
                    let trigger = Trigger::Keep {
                        contacts: [lasts, lasts],
                        sliding: Some(sliding),
                    };
                    return state.stopped(trigger, slip, unsure);
                }
            };
        }
        state.stopped(trigger, slip, unsure)
    }

    fn stopped(self, trigger: Trigger<R>, slip: R, unsure: bool) -> Moved<R> {
        Moved {
            slip,
            unsure,
            ..Moved::new(ContactState::TwoVertex(self), trigger)
        }
    }

    fn moved<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        slide: R,
        turn: R,
    ) -> Self {
        let pivot = self.pivot.moved(slide, turn);
        match ContactState::seated(scene, pivot, &[self.other]) {
            ContactState::TwoVertex(seated) => seated,
            _ => self.clone(),
        }
    }

    pub(crate) fn reactions<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
    ) -> Reactions<R> {
        shared_reactions(scene, &self.pivot, &self.contacts(), grip)
    }
}
