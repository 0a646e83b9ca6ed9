//! The certified frame (STATICS 3.4): the hand moves along a short path and no event occurs, the body only turns a little about the point
//! that holds it. The balance at the end alone proves this, so an ordinary frame needs no search: path and frame evolution agree in it.

use crate::geometry::Orientation;
use crate::grip::{Displacement, Grip};
use crate::load::Load;
use crate::moment::{Drive, Moment, SecondHarmonic};
use crate::real::Real;
use crate::world::World;

/// A turn in balance along the whole path of the hand, and bounds of the deviations on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CertifiedTurn<R> {
    /// The body's orientation after the turn.
    pub(crate) orientation: Orientation<R>,
    /// No turn on the path exceeds this (rad).
    pub(crate) turn_bound: R,
    /// At least 1 over the stability anywhere on the path.
    per_least: R,
    /// The bend of (E8): at most |z| over the stability anywhere on the path.
    bend: R,
}

/// Corrections of the angle before a frame is left uncertified.
const MAX_CORRECTIONS: usize = 4;

impl<R: Real> CertifiedTurn<R> {
    /// About a pinned point, with the hand at the end `to` of its path: `load` is the load on the body there before it turns.
    pub(crate) fn pinned<H: SecondHarmonic<R>>(
        scene: &impl World<R>,
        load: &Load<R>,
        to: &Grip<R>,
        displacement: &Displacement<R>,
    ) -> Option<Self> {
        let drive = load.drive(displacement);
        let moment = load.pinned::<H>();
        Self::of(&moment, &drive, load.placed.orientation, |orientation| {
            load.turned(scene, orientation, to).pinned()
        })
    }

    /// With the hand at the end of its path: `moment` is that on the body in an orientation before it turns, which was balanced at the
    /// beginning, `drive` what the displacement adds to it, `then` the moment in another orientation. `None` if the balance may fold or
    /// change much on the path (E8).
    pub(crate) fn of<H: SecondHarmonic<R>>(
        moment: &Moment<R, H>,
        drive: &Drive<R>,
        mut orientation: Orientation<R>,
        then: impl Fn(Orientation<R>) -> Moment<R, H>,
    ) -> Option<Self> {
        // The least stability and the largest |z| on the path.
        let least = moment.stability() - drive.hold.x.max(R::ZERO);
        let pull = drive.hold.length_bound();
        let size = moment.curvature_bound() + pull;
        if least <= R::ZERO || pull > least.halved() {
            return None;
        }
        let per_stability = R::ONE / moment.stability();
        // The stability is at most one and a half times the least one.
        let per_least = per_stability + per_stability.halved();
        if per_least >= R::HUGE {
            return None;
        }
        // Newton's step and the bend of the balance, the curvature of the moment over its stability: under the condition of Kantorovich a
        // balance is at most two steps away.
        let quarter = R::HALF.halved();
        let (step, bend) = (moment.now().abs() * per_least + R::MICRO, size * per_least);
        if step > quarter || bend * step >= quarter {
            return None;
        }
        let turn_bound = step.doubled();
        let certified = |orientation| Self {
            orientation,
            turn_bound,
            per_least,
            bend,
        };
        let mut turn = moment.correction(per_stability);
        for _ in 0..MAX_CORRECTIONS {
            orientation = orientation.plus(turn);
            // The residual is of third order in the turn, (bend²/2 + bend/6) turn³.
            let change = bend * turn.abs();
            let left = (change * (change + turn.abs()) * turn.abs()).halved();
            if left <= R::EPSILON {
                return Some(certified(orientation));
            }
            let moment = then(orientation);
            turn = moment.correction(R::ONE / moment.stability());
        }
        None
    }

    /// The angular velocity in tau for the moment that was turned, and the most by which any on the path differs from it.
    pub(crate) fn rate<H: SecondHarmonic<R>>(
        &self,
        moment: &Moment<R, H>,
        drive: &Drive<R>,
    ) -> (R, R) {
        let along = drive.hold.length_bound() * self.per_least;
        let most = along + drive.couple.abs() * self.per_least;
        let turning = (along + self.bend * most + most) * self.turn_bound;
        (drive.now() / moment.stability(), turning + most * along)
    }

    /// A bound of [`Self::curvature_bound`] if the hand only turns: |ϑ'| <= step = reach / 2 there.
    pub(crate) fn swing(&self) -> R {
        self.turn_bound * (self.turn_bound + self.bend * self.turn_bound.halved().halved())
    }

    /// A bound of ϑ'² + |ϑ''| in tau: a point deviates from the straight line between the ends of its path by at most half of this times
    /// its lever.
    pub(crate) fn curvature_bound(&self, drive: &Drive<R>) -> R {
        let along = drive.hold.length_bound() * self.per_least;
        let rate = along + drive.couple.abs() * self.per_least;
        rate * (rate + self.bend * rate + along.doubled())
    }
}

#[cfg(test)]
mod tests;
