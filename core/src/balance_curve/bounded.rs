//! A motion's turn and slide as quantities, with their bounds or without, for the events of a trammel.

use super::{BalanceCurve, Place};
use crate::bounded::{Known, Quantity};
use crate::moment::SecondHarmonic;
use crate::real::Real;
use crate::thresholds::Thresholds;

impl<R: Real, H: SecondHarmonic<R>> BalanceCurve<R, H> {
    /// cos ϑ and sin ϑ.
    pub(crate) fn rotation_as<Q: Quantity<R>>(&self, p: &Place<R>) -> (Q, Q) {
        let cosine = R::ONE - p.versine;
        let known = |slope: R| {
            let rate = self.rate.abs();
            Known {
                slope,
                error: R::of_coordinates(),
                bounds: [R::ONE, rate, rate * rate],
            }
        };
        (
            Q::known(cosine, || known(-p.sine * self.rate)),
            Q::known(p.sine, || known(cosine * self.rate)),
        )
    }

    /// dϑ/dx
    pub(crate) fn rate_as<Q: Quantity<R>>(&self) -> Q {
        Q::constant(self.rate)
    }

    /// ϑ, up to x = `window`.
    pub(crate) fn turn_as<Q: Quantity<R>>(&self, p: &Place<R>, window: R) -> Q {
        Q::known(p.turn, || Known {
            slope: self.rate,
            error: R::rounding(p.turn.abs()),
            bounds: [self.rate.abs() * window, self.rate.abs(), R::ZERO],
        })
    }

    /// tau of a kinematic motion, up to x = `window`.
    pub(crate) fn part_as<Q: Quantity<R>>(&self, p: &Place<R>, window: R) -> Q {
        Q::known(p.part(), || {
            let most = self.hold.length_bound();
            Known {
                slope: p.h_slope,
                error: R::rounding(p.part().abs()).doubled(),
                bounds: [most * window, most, most * self.rate.abs()],
            }
        })
    }

    /// dtau/dx of a kinematic motion.
    pub(crate) fn part_velocity_as<Q: Quantity<R>>(&self, p: &Place<R>) -> Q {
        Q::known(p.h_slope, || {
            let rate = self.rate.abs();
            let most = self.hold.length_bound();
            Known {
                slope: self.second(p).0,
                error: R::rounding(most).doubled(),
                bounds: [most, most * rate, most * rate * rate],
            }
        })
    }
}
