//! A motion's turn and slide as quantities with their bounds, for the events of a trammel.

use super::{BalanceCurve, Place};
use crate::bounded::Bounded;
use crate::moment::SecondHarmonic;
use crate::real::Real;
use crate::thresholds::Thresholds;

impl<R: Real, H: SecondHarmonic<R>> BalanceCurve<R, H> {
    /// cos ϑ and sin ϑ.
    pub(crate) fn rotation_bounded(&self, p: &Place<R>) -> (Bounded<R>, Bounded<R>) {
        let rate = self.rate.abs();
        let bounds = [R::ONE, rate, rate * rate];
        let cosine = R::ONE - p.versine;
        (
            Bounded {
                value: cosine,
                slope: -p.sine * self.rate,
                error: R::of_coordinates(),
                bounds,
            },
            Bounded {
                value: p.sine,
                slope: cosine * self.rate,
                error: R::of_coordinates(),
                bounds,
            },
        )
    }

    /// dϑ/dx
    pub(crate) fn rate_bounded(&self) -> Bounded<R> {
        Bounded::constant(self.rate)
    }

    /// ϑ, up to x = `window`.
    pub(crate) fn turn_bounded(&self, p: &Place<R>, window: R) -> Bounded<R> {
        Bounded {
            value: p.turn,
            slope: self.rate,
            error: R::rounding(p.turn.abs()),
            bounds: [self.rate.abs() * window, self.rate.abs(), R::ZERO],
        }
    }

    /// tau of a kinematic motion, up to x = `window`.
    pub(crate) fn part_bounded(&self, p: &Place<R>, window: R) -> Bounded<R> {
        let most = self.hold.length_bound();
        Bounded {
            value: p.part(),
            slope: p.h_slope,
            error: R::rounding(p.part().abs()).doubled(),
            bounds: [most * window, most, most * self.rate.abs()],
        }
    }

    /// dtau/dx of a kinematic motion.
    pub(crate) fn part_velocity(&self, p: &Place<R>) -> Bounded<R> {
        let rate = self.rate.abs();
        let most = self.hold.length_bound();
        Bounded {
            value: p.h_slope,
            slope: self.second(p).0,
            error: R::rounding(most).doubled(),
            bounds: [most, most * rate, most * rate * rate],
        }
    }
}
