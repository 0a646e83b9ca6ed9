//! Without contact the body flies at the frozen hand: straight to balance, or to the first touch (STATICS 11).

use crate::contact::Sense;
use crate::errand::{Leg, Next, Stage};
use crate::events::{Ending, Watch};
use crate::motion::{Kind, Motion, Spot};
use crate::real::Real;
use crate::search::Ended;
use crate::state::HandPose;
use crate::step::Step;

impl<R: Real, const V: usize, const S: usize, const C: usize> Step<'_, R, V, S, C> {
    /// Without contact: straight to balance, or to the first touch. With a sense, away from a balance that is not stable.
    pub(crate) fn fly(&mut self, sense: Sense) {
        let free = Motion::frozen(Kind::Free, self.body);
        let statics = self.statics;
        let mut theta = self.body.angle;
        if !statics.grip.swings {
            // Farther from the hand's angle the spring turns the body more than its weight can; from there balance is within a turn.
            let moment = statics.world.weight * statics.grip.centroid.length_bound();
            let most = moment / statics.world.stiffness.value;
            let angle = self.body.hand.angle;
            theta = theta.max(angle - most).min(angle + most);
        }
        theta = theta + sense.along(R::HALF.halved());
        let at = |u: R| Spot { u, p: R::ZERO };
        let mut i = statics.placed(&free, at(theta));
        if statics.world.weight > R::ZERO {
            for _ in 0..40 {
                let step = if i.e_u < R::ZERO {
                    (-i.e / i.e_u).max(-R::HALF).min(R::HALF)
                } else {
                    i.e.sign() * R::HALF.halved()
                };
                theta = theta + step;
                i = statics.placed(&free, at(theta));
                if step.abs() <= R::EPSILON.doubled() {
                    break;
                }
            }
        }
        let mut m = Motion::frozen(Kind::Line, self.body);
        m.start = self.body.place();
        m.end = HandPose {
            at: i.g,
            angle: theta,
        };
        if m.line().size() <= R::EPSILON.doubled() {
            return self.settled(Next::Rest);
        }
        self.run(Stage::Fly(Leg::Straight), m, Watch::Way, R::ONE, false);
    }
    pub(crate) fn flown(&mut self, leg: Leg, ended: &Ended<R>) {
        let mut m = self.errand.search.motion;
        let here = self.body.place();
        let next = match leg {
            Leg::Straight if self.is_blocked(ended) => {
                m.angle = m.end.angle;
                m.start = here;
                m.end.angle = here.angle;
                Some((m, Leg::Holding))
            }
            Leg::Holding if ended.ending == Ending::End => {
                m.start = here;
                m.end = HandPose {
                    angle: m.angle,
                    ..here
                };
                Some((m, Leg::Turning))
            }
            Leg::Straight | Leg::Holding | Leg::Turning => None,
        };
        if let Some((m, leg)) = next {
            return self.run(Stage::Fly(leg), m, Watch::Way, R::ONE, false);
        }
        let next = if let Ending::Touch(feature) = ended.ending {
            self.touch(feature);
            self.body.stiction = false;
            Next::Relax(Sense::Rests)
        } else if ended.ending == Ending::GoesOn && ended.x > R::ZERO {
            Next::Relax(Sense::Rests)
        } else {
            Next::Rest
        };
        self.settled(next);
    }
}
