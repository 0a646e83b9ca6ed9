//! A motion's turn and slide as quantities with their bounds, for the events of a trammel.

use super::{Motion, Place};
use crate::jet::Jet;
use crate::moment::Bend;
use crate::real::Real;

impl<R: Real, B: Bend<R>> Motion<R, B> {
    /// cos ϑ and sin ϑ.
    pub(crate) fn rotation_jets(&self, p: &Place<R>) -> (Jet<R>, Jet<R>) {
        let rate = self.rate.abs();
        let bounds = [R::ONE, rate, rate * rate];
        let cosine = R::ONE - p.versine;
        (
            Jet {
                value: cosine,
                slope: -p.sine * self.rate,
                bounds,
            },
            Jet {
                value: p.sine,
                slope: cosine * self.rate,
                bounds,
            },
        )
    }

    /// dϑ/dx
    pub(crate) fn rate_jet(&self) -> Jet<R> {
        Jet::constant(self.rate)
    }

    /// ϑ, up to x = `window`.
    pub(crate) fn turn_jet(&self, p: &Place<R>, window: R) -> Jet<R> {
        Jet {
            value: p.turn,
            slope: self.rate,
            bounds: [self.rate.abs() * window, self.rate.abs(), R::ZERO],
        }
    }

    /// tau of a kinematic motion, up to x = `window`.
    pub(crate) fn part_jet(&self, p: &Place<R>, window: R) -> Jet<R> {
        let most = self.hold.reach();
        Jet {
            value: p.part(),
            slope: p.h_slope,
            bounds: [most * window, most, most * self.rate.abs()],
        }
    }

    /// dtau/dx of a kinematic motion.
    pub(crate) fn part_velocity(&self, p: &Place<R>) -> Jet<R> {
        let rate = self.rate.abs();
        let most = self.hold.reach();
        Jet {
            value: p.h_slope,
            slope: self.second(p).0,
            bounds: [most, most * rate, most * rate * rate],
        }
    }
}
