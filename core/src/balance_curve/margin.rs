//! What can end a motion: a margin, linear in tau and of first order in cos ϑ, sin ϑ, and its first zero on the extent
//! (STATICS 3.2, 3.3).

use super::{BalanceCurve, Extent, Place};
use crate::geometry::Vec2;
use crate::moment::SecondHarmonic;
use crate::real::Real;
use crate::search::{Found, Samples, Slope, first_zero};
use crate::thresholds::Thresholds;

/// A quantity that is positive while the motion is allowed: E = start + along·tau - u (1 - cos ϑ) + v sin ϑ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Margin<R> {
    pub(crate) start: R,
    pub(crate) along: R,
    /// (u, v)
    pub(crate) turning: Vec2<R>,
    /// The rounding of `start`.
    pub(crate) rounding: R,
}

impl<R: Real> Margin<R> {
    /// `self`·a + `other`·b
    pub(crate) fn combine(self, a: R, other: Self, b: R) -> Self {
        Self {
            start: self.start * a + other.start * b,
            along: self.along * a + other.along * b,
            turning: self.turning * a + other.turning * b,
            rounding: self.rounding * a.abs() + other.rounding * b.abs(),
        }
    }

    /// In units of about its largest component.
    pub(super) fn scaled(&self) -> Self {
        let size = (self.start.abs().max(self.along.abs())).max(self.turning.length_bound());
        if size == R::ZERO {
            return *self;
        }
        let unit = size.unit();
        Self {
            start: self.start.in_units(unit),
            along: self.along.in_units(unit),
            turning: self.turning.in_units(unit),
            rounding: (self.rounding.in_units(unit)).max(R::of_sums(R::ONE)),
        }
    }

    /// A contact that has just opened, or a force that is exactly at its limit, may leave the margin along a tangent: its zero is taken
    /// where the margin is exceeded by this amount, beyond doubt.
    fn credit(&self) -> R {
        if self.start <= self.rounding {
            self.rounding.doubled()
        } else {
            R::ZERO
        }
    }

    /// True if a margin, in its own units, is beyond doubt used up at the end of an extent. Where the body swings round at the first pull,
    /// tau grows between adjacent values of x and D is as small as its rounding: a search sees nothing of E·D there.
    pub(super) fn is_used_up(&self, extent: &Extent<R>) -> bool {
        let end = self.at(&extent.end) + self.along * extent.part();
        end < self.start.min(R::ZERO) - R::beyond_doubt(self.rounding)
    }

    fn at(&self, p: &Place<R>) -> R {
        self.start - self.turning.x * p.versine + self.turning.y * p.sine
    }
}

/// A bound of the second derivative of E·D: of first order in E without its term along tau, in D and in the window.
pub(super) struct CurvatureBound<R> {
    per_d: R,
    per_e: R,
    per_window: R,
    least: R,
}

impl<R: Real> CurvatureBound<R> {
    /// From a point up to a window.
    fn bound(&self, (e, d): (R, R), window: R) -> R {
        self.least + self.per_d * d.abs() + self.per_e * e.abs() + self.per_window * window
    }
}

impl<R: Real, H: SecondHarmonic<R>> BalanceCurve<R, H> {
    /// E·D and its slope at a point, and its curvature from there up to a window.
    pub(super) fn slope(
        &self,
        margin: &Margin<R>,
        p: &Place<R>,
        (curvature_bound, window): (&CurvatureBound<R>, R),
    ) -> Slope<R> {
        let cosine = R::ONE - p.versine;
        let e = margin.at(p);
        let turning = margin.turning.y * cosine - margin.turning.x * p.sine;
        Slope {
            value: e * p.d + margin.along * p.h + margin.credit(),
            slope: self.rate * turning * p.d + e * p.d_slope + margin.along * p.h_slope,
            curvature: curvature_bound.bound((e, p.d), window),
            rounding: margin.rounding,
        }
    }

    /// The coefficients that bound the second derivative of E·D.
    pub(super) fn curvature_bound(&self, margin: &Margin<R>) -> CurvatureBound<R> {
        let rate = self.rate.abs();
        let (z0, zp) = (self.hold.length_bound(), self.drive.length_bound());
        let swing = rate * margin.turning.length_bound();
        let per_d = rate * swing;
        let curvature = self.harmonic.bound(z0, 2);
        CurvatureBound {
            per_d,
            per_e: rate * zp,
            least: (swing * zp).doubled() + rate * (margin.along.abs() * curvature),
            per_window: (per_d * zp).doubled(),
        }
    }

    /// Shortens the extent to the first point at which the margin is used up. Returns true if that is before the end.
    pub(crate) fn stop_at(&self, margin: &Margin<R>, extent: &mut Extent<R>) -> bool {
        let limit = extent.end;
        // The most by which it can fall before the end: an ordinary frame is finished here.
        let fall = margin.along.abs() * extent.part_bound
            + margin.turning.length_bound() * limit.turn.abs();
        if margin.start - fall > margin.rounding {
            return false;
        }
        if margin.start - self.fall(margin, extent) > margin.rounding {
            return false;
        }
        let found = if self.rate == R::ZERO {
            self.linear_zero(margin, &limit)
        } else {
            self.curved_zero(margin, extent)
        };
        // What happens before the end is certain, even though a search for the end gave up.
        let (end, unsure) = match found {
            Found::Nothing { .. } => return false,
            Found::Zero { x, .. } if x == limit.x => (limit, extent.unsure),
            Found::Zero { x, .. } => (self.at(x), false),
            Found::Unsure { x, .. } => (self.at(x), true),
        };
        *extent = Extent {
            end,
            folds: false,
            unsure,
            ..*extent
        };
        true
    }

    /// The most by which a margin can fall on an extent: by its term in tau, and through the turn below the chord between its ends, from
    /// which it deviates by a sagitta.
    fn fall(&self, margin: &Margin<R>, extent: &Extent<R>) -> R {
        let (along, limit) = (margin.along, &extent.end);
        let falls = if extent.rises {
            (-along).max(R::ZERO) * extent.part()
        } else {
            along.abs() * extent.part_bound
        };
        let chord = (margin.start - margin.at(limit)).max(R::ZERO);
        let sagitta = margin.turning.length_bound() * (limit.turn * limit.turn);
        falls + chord + sagitta.halved().halved().halved()
    }

    /// The zero of a margin if the body does not turn: E·D is linear.
    fn linear_zero(&self, margin: &Margin<R>, limit: &Place<R>) -> Found<R> {
        let fall = margin.start * self.drive.x - margin.along * self.begin().h_slope;
        let start = margin.start + margin.credit();
        if fall > R::ZERO && start < limit.x * fall {
            Found::Zero {
                x: (start / fall).max(R::ZERO),
                which: 0,
            }
        } else {
            Found::Nothing { x: limit.x }
        }
    }

    /// The first zero of a margin on an extent.
    fn curved_zero(&self, margin: &Margin<R>, extent: &mut Extent<R>) -> Found<R> {
        let margin = &margin.scaled();
        let curvature_bound = self.curvature_bound(margin);
        let limit = extent.end.x;
        let found = first_zero(limit, &mut extent.looks, |x| {
            Samples::far([self.slope(margin, &self.at(x), (&curvature_bound, limit - x))])
        });
        match found {
            Found::Nothing { .. } if margin.is_used_up(extent) => {
                Found::Zero { x: limit, which: 0 }
            }
            found => found,
        }
    }
}
