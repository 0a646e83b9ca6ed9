//! Where the foot of a slide comes to a halt: the first zero of its velocity along the hand's displacement (STATICS 3.6).

use super::{BalanceCurve, Extent, Margin, Place};
use crate::bounded::{Bounded, Bounds, Quantity, Sloped};
use crate::moment::SecondHarmonic;
use crate::real::Real;
use crate::search::{Found, Samples, first_zero};

impl<R: Real, H: SecondHarmonic<R>> BalanceCurve<R, H> {
    /// Shortens the extent to the first point at which a foot turns back; its displacement is a margin, and it may move back by `slack` per
    /// tau. Returns true if that is before the end.
    pub(crate) fn stop_at_reversal(
        &self,
        foot: &Margin<R>,
        slack: R,
        extent: &mut Extent<R>,
    ) -> bool {
        let mut foot = *foot;
        foot.along = foot.along + slack;
        let foot = foot.scaled();
        let limit = extent.end.x;
        let begin: Bounded<R> = self.advance_of(&foot, &self.at(R::ZERO), limit);
        let bounds = &begin.bounds;
        if begin.value < -bounds.error {
            // It moves back immediately.
            *extent = Extent {
                end: self.at(R::ZERO),
                folds: false,
                unsure: false,
                ..*extent
            };
            return true;
        }
        let found = first_zero(limit, &mut extent.looks, |x| {
            let advance: Sloped<R> = self.advance_of(&foot, &self.at(x), limit);
            Samples::far([advance.as_slope(R::ONE, bounds)])
        });
        let (x, unsure) = match found {
            Found::Nothing { .. } => return false,
            Found::Zero { x, .. } => (x, false),
            Found::Unsure { x, .. } => (x, true),
        };
        *extent = Extent {
            end: self.at(x),
            folds: false,
            unsure,
            ..*extent
        };
        true
    }

    /// The derivative of a margin with respect to tau, times (H'D - HD') of (E7), which is positive up to the fold; valid up to x =
    /// `window`.
    fn advance_of<Q: Quantity<R>>(&self, margin: &Margin<R>, p: &Place<R>, window: R) -> Q {
        let rate = self.rate.abs();
        let (z0, zp) = (self.hold.length_bound(), self.drive.length_bound());
        let (h2, d2) = self.second(p);
        let most = self.whole();
        let (bent, bends) = (
            rate * self.harmonic.bound(z0, 2),
            rate * rate * self.harmonic.bound(z0, 3),
        );
        let quantity = |value, slope, suprema: [R; 3]| {
            let bounds = || Bounds {
                error: R::rounding(suprema[0]),
                suprema,
            };
            Q::known(value, || slope, bounds)
        };
        let h = quantity(p.h, p.h_slope, [most * window, most, bent]);
        let h_slope = quantity(p.h_slope, h2, [most, bent, bends]);
        let d = quantity(p.d, p.d_slope, [R::ONE + zp * window, zp, rate * zp]);
        let d_slope = quantity(p.d_slope, d2, [zp, rate * zp, rate * rate * zp]);
        let (cos, sin): (Q, Q) = self.rotation_as(p);
        let [u, v] = [margin.turning.x, margin.turning.y].map(|k| Q::constant(self.rate * k));
        let along = Q::constant(margin.along);
        along * (h_slope * d - h * d_slope) + (v * cos - u * sin) * (d * d)
    }
}
