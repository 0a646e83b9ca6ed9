//! Turn and slide of a motion as quantities, with or without their bounds, for the events of a trammel.

use super::{BalanceCurve, Place};
use crate::bounded::{Bounds, Quantity};
use crate::moment::SecondHarmonic;
use crate::real::Real;
use crate::thresholds::Thresholds;

impl<R: Real, H: SecondHarmonic<R>> BalanceCurve<R, H> {
    /// cos ϑ and sin ϑ.
    pub(crate) fn rotation_as<Q: Quantity<R>>(&self, p: &Place<R>) -> (Q, Q) {
        let cosine = R::ONE - p.versine;
        let bounds = || {
            let rate = self.rate.abs();
            Bounds {
                error: R::of_coordinates(),
                suprema: [R::ONE, rate, rate * rate],
            }
        };
        (
            Q::known(cosine, || -p.sine * self.rate, bounds),
            Q::known(p.sine, || cosine * self.rate, bounds),
        )
    }

    /// dϑ/dx
    pub(crate) fn rate_as<Q: Quantity<R>>(&self) -> Q {
        Q::constant(self.rate)
    }

    /// ϑ, up to x = `window`.
    pub(crate) fn turn_as<Q: Quantity<R>>(&self, p: &Place<R>, window: R) -> Q {
        let bounds = || {
            let most = self.rate.abs() * window;
            Bounds {
                error: R::rounding(most),
                suprema: [most, self.rate.abs(), R::ZERO],
            }
        };
        Q::known(p.turn, || self.rate, bounds)
    }

    /// tau of a kinematic motion, up to x = `window`.
    pub(crate) fn part_as<Q: Quantity<R>>(&self, p: &Place<R>, window: R) -> Q {
        let bounds = || {
            let fastest = self.hold.length_bound();
            let most = fastest * window;
            Bounds {
                error: R::rounding(most).doubled(),
                suprema: [most, fastest, fastest * self.rate.abs()],
            }
        };
        Q::known(p.part(), || p.h_slope, bounds)
    }

    /// dtau/dx of a kinematic motion.
    pub(crate) fn part_velocity_as<Q: Quantity<R>>(&self, p: &Place<R>) -> Q {
        let bounds = || {
            let rate = self.rate.abs();
            let most = self.hold.length_bound();
            Bounds {
                error: R::rounding(most).doubled(),
                suprema: [most, most * rate, most * rate * rate],
            }
        };
        Q::known(p.h_slope, || self.second(p).0, bounds)
    }
}
