//! Two vertices on two surfaces (STATICS 5): the pose is locked while an internal force between the contacts keeps both
//! reactions within their cones (E5); beyond that the body moves with one degree of freedom, like a trammel.

use super::fixed_pose::FixedPose;
use super::trammel::{Demand, Ending, Trammel};
use crate::contact::{Pair, Pairs, Reactions};
use crate::grip::Grip;
use crate::list::gather;
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::verb::{Moved, Relax, Trigger, seat};
use crate::world::World;

/// The memory: where the first contact is held, the fixed angle, the other contact.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TwoVertex<R> {
    pub(crate) pivot: Pivot<R>,
    pub(crate) other: Pair,
    /// Edges of the friction cones that bore the load last.
    pub(crate) bearers: [u8; 3],
}

/// A slip goes at most this many times its window of one body size or radian.
const WINDOWS: usize = 16;

impl<R: Real> TwoVertex<R> {
    pub(crate) fn new(pivot: Pivot<R>, other: Pair) -> Self {
        Self {
            pivot,
            other,
            bearers: [0, 1, 2],
        }
    }

    pub(crate) fn contacts(&self) -> Pairs {
        gather([self.pivot.contact, self.other])
    }

    fn fixed_pose(&self, scene: &impl World<R>) -> FixedPose<R> {
        FixedPose::new(scene, &self.pivot, &self.contacts())
    }

    /// A certified frame: it stays. The loads that are borne are convex, so that the end of the path decides.
    pub(crate) fn follow(&mut self, scene: &impl World<R>, to: &Grip<R>) -> bool {
        let fixed_pose = self.fixed_pose(scene);
        fixed_pose.bears(scene, to, &mut self.bearers)
    }

    /// Stays as the hand moves, as long as the interval of (E5) is not empty.
    pub(crate) fn advance(&self, scene: &impl World<R>, from: &Grip<R>, to: &Grip<R>) -> Moved<R> {
        let moved = self.fixed_pose(scene).advance(scene, from, to);
        Moved {
            trigger: slides(moved.trigger),
            ..moved
        }
    }

    /// Puts the contacts to the test as they are; a motion under way goes on while it is driven.
    pub(crate) fn relax(&self, scene: &impl World<R>, grip: &Grip<R>, how: Relax<R>) -> Moved<R> {
        let driven =
            || Trammel::driven(scene, (&self.pivot, self.other), grip, Demand::Pressed).is_some();
        Moved::by(match how.sliding {
            Some(sign) if driven() => Trigger::Slide(sign),
            _ => slides(self.fixed_pose(scene).test(scene, grip, how.attempt)),
        })
    }

    /// Slides on both surfaces to the first of (E6), N_i = 0, touch.
    pub(crate) fn slide(&mut self, scene: &impl World<R>, grip: &Grip<R>) -> Moved<R> {
        let mut moved = Moved::by(Trigger::Undriven);
        let (begin, mut turn) = (self.pivot, R::ZERO);
        let mut demand = Demand::Pressed;
        for _ in 0..WINDOWS {
            let any = |demand| Trammel::driven(scene, (&self.pivot, self.other), grip, demand);
            let Some(trammel) = any(demand).or_else(|| any(Demand::AtTheEnd)) else {
                break;
            };
            let (run, ending) = trammel.run(scene, &self.contacts(), demand);
            self.pivot = seat(scene, self.pivot.moved(run.slide, run.turn), &[self.other]);
            moved.slip = moved.slip + run.slide;
            turn = turn + run.turn;
            moved.unsure |= run.unsure;
            moved.unbalanced = ending != Ending::Stopped || demand == Demand::AtTheEnd;
            moved.trigger = match ending {
                Ending::Window | Ending::Reverses | Ending::Stopped => Trigger::Stopped,
                Ending::Touches(pair) => Trigger::Touch(pair),
                Ending::Opens { lasts, sliding } => Trigger::Keep {
                    contacts: [lasts, lasts],
                    sliding: Some(sliding),
                },
            };
            match ending {
                Ending::Window | Ending::Reverses => {}
                Ending::Opens { lasts, sliding } if !self.can_open(scene, grip, lasts, sliding) => {
                    demand = Demand::AtTheEnd;
                }
                _ => break,
            }
        }
        // Where opposite surfaces clamp the body, what ends a slip is not always a balance.
        if moved.trigger == Trigger::Stopped && !self.fixed_pose(scene).is_at_rest(scene, grip) {
            moved.unbalanced = true;
            if moved.slip.abs() + turn.abs() <= R::MICRO {
                self.pivot = begin;
                moved.trigger = Trigger::Undriven;
            }
        }
        moved
    }

    /// True if the contact that does not last can leave its surface, by a turn about the one that lasts or by its slide.
    fn can_open(&self, scene: &impl World<R>, grip: &Grip<R>, lasts: usize, sliding: R) -> bool {
        let fixed_pose = self.fixed_pose(scene);
        [None, Some(sliding)]
            .into_iter()
            .any(|sliding| fixed_pose.opens(scene, grip, &([lasts, lasts], sliding)))
    }

    pub(crate) fn reactions(&self, scene: &impl World<R>, load: &Load<R>) -> Reactions<R> {
        self.fixed_pose(scene).reactions(scene, load)
    }
}

/// Where both contacts last, they slide.
fn slides<R: Real>(trigger: Trigger<R>) -> Trigger<R> {
    match trigger {
        Trigger::Keep {
            contacts: [a, b],
            sliding: Some(sign),
        } if a != b => Trigger::Slide(sign),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a single contact that slides on, the other one opens.
    #[test]
    fn both_contacts_slide_where_both_last() {
        let keep = |contacts, sliding: Option<f64>| Trigger::Keep { contacts, sliding };
        for sign in [1.0, -1.0] {
            for [a, b] in [[0, 1], [1, 0]] {
                assert_eq!(slides(keep([a, b], Some(sign))), Trigger::Slide(sign));
                assert_eq!(slides(keep([a, b], None)), keep([a, b], None));
                assert_eq!(slides(keep([a, a], Some(sign))), keep([a, a], Some(sign)));
            }
        }
        assert_eq!(slides(Trigger::Clear::<f64>), Trigger::Clear);
    }
}
