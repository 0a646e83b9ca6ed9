//! The calm frame (STATICS 3.4): the hand goes a short way and nothing happens, the body only turns a little about the
//! point that holds it. That this is certain follows from the balance at the end alone, which is why an ordinary frame
//! needs no search: path and frame evolution agree in it.

use crate::geometry::{Orientation, Vec2};
use crate::grip::{Grip, Way};
use crate::load::Stance;
use crate::moment::{Bend, Moment};
use crate::real::Real;
use crate::world::World;

/// A turn that keeps the balance all the way, and how much anything can stray on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Calm<R> {
    /// The body's after the turn.
    pub(crate) orientation: Orientation<R>,
    /// No turn on the way is larger (rad).
    pub(crate) reach: R,
    /// At least 1 over the stability anywhere on the way.
    per_least: R,
    /// At most |z| over the stability anywhere on the way.
    bend: R,
}

/// Corrections of the angle before a frame is not called calm.
const MAX_CORRECTIONS: usize = 4;

impl<R: Real> Calm<R> {
    /// About a pinned point, with the hand at the end `to` of its way: `stance` is the body's load there before it turns.
    pub(crate) fn pinned<B: Bend<R>>(
        scene: &impl World<R>,
        stance: &Stance<R>,
        to: &Grip<R>,
        way: &Way<R>,
    ) -> Option<Self> {
        let drive = stance.lever.conj_mul(way.hand);
        let moment = stance.pinned::<B>();
        Self::turn(&moment, drive, stance.placed.orientation, |orientation| {
            stance.turned(scene, orientation, to).pinned()
        })
    }

    /// With the hand at the end of its way: `moment` is that on the body in an orientation before it turns, balanced at the
    /// beginning, `drive` what the way adds to z, `then` the moment in another orientation. Nothing where the balance may
    /// fold or change much on the way (E8).
    pub(crate) fn turn<B: Bend<R>>(
        moment: &Moment<R, B>,
        drive: Vec2<R>,
        mut orientation: Orientation<R>,
        then: impl Fn(Orientation<R>) -> Moment<R, B>,
    ) -> Option<Self> {
        // The least stability and the largest |z| of the way.
        let least = moment.stability() - drive.x.max(R::ZERO);
        let pull = drive.reach();
        let size = moment.bent() + pull;
        if least <= R::ZERO || pull > least.halved() || !moment.is_carried() {
            return None;
        }
        let per_stability = R::ONE / moment.stability();
        // The stability is at most half as much again as the least one.
        let per_least = per_stability + per_stability.halved();
        if per_least >= R::HUGE {
            return None;
        }
        // Newton's step and how much the balance bends: with the condition of Kantorovich a balance is at most two steps
        // away.
        let quarter = R::HALF.halved();
        let (step, bend) = (moment.now().abs() * per_least + R::MICRO, size * per_least);
        if step > quarter || bend * step >= quarter {
            return None;
        }
        let reach = step.doubled();
        let calm = |orientation| Self {
            orientation,
            reach,
            per_least,
            bend,
        };
        if reach <= moment.tolerance {
            return Some(calm(orientation));
        }
        let mut turn = moment.correction(per_stability);
        for _ in 0..MAX_CORRECTIONS {
            orientation = orientation.plus(turn);
            // What is left is of the third order in the turn, (bend²/2 + bend/6) turn³.
            let bent = bend * turn.abs();
            let left = (bent * (bent + turn.abs()) * turn.abs()).halved();
            if left <= R::EPSILON.max(moment.tolerance) {
                return Some(calm(orientation));
            }
            let moment = then(orientation);
            turn = moment.correction(R::ONE / moment.stability());
        }
        None
    }

    /// A bound of [`Self::bow`] where the hand only turns: |ϑ'| <= step = reach / 2 there.
    pub(crate) fn swing(&self) -> R {
        self.reach * (self.reach + self.bend * self.reach.halved().halved())
    }

    /// By half of this times its lever a point strays at most from the straight line between the ends of its way: a bound
    /// of ϑ'² + |ϑ''| in tau.
    pub(crate) fn bow(&self, stance: &Stance<R>, way: &Way<R>) -> R {
        let drive = stance.lever.conj_mul(way.hand).reach() * self.per_least;
        let rate = drive + stance.stiffness * way.turn.abs() * self.per_least;
        rate * (rate + self.bend * rate + drive.doubled())
    }
}

#[cfg(test)]
mod tests;
