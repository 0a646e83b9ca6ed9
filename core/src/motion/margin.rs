//! What can end a motion: a margin, linear in tau and of first order in cos ϑ, sin ϑ, and its first zero on the course
//! (STATICS 3.2, 3.3).

use super::{Bend, Course, Motion, Place};
use crate::geometry::Vec2;
use crate::real::Real;
use crate::roots::{Found, Look, Slope, first_zero};

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

    /// In units of its largest part.
    fn scaled(&self) -> Self {
        let unit = (self.start.abs().max(self.along.abs())).max(self.turning.reach());
        if unit == R::ZERO {
            return *self;
        }
        Self {
            start: self.start / unit,
            along: self.along / unit,
            turning: self.turning.over(unit),
            rounding: (self.rounding / unit).max(R::from_int(4) * R::EPSILON),
        }
    }

    /// A contact that has just opened, or a force that is just at its limit, may leave it along a tangent: its zero is
    /// taken where the margin is overdrawn by this, beyond doubt.
    fn credit(&self) -> R {
        if self.start <= self.rounding {
            self.rounding.doubled()
        } else {
            R::ZERO
        }
    }

    fn at(&self, p: &Place<R>) -> R {
        self.start - self.turning.x * p.versine + self.turning.y * p.sine
    }
}

impl<R: Real, B: Bend<R>> Motion<R, B> {
    /// E·D and its slope at a place; `curvature` as given.
    fn slope(&self, margin: &Margin<R>, p: &Place<R>, curvature: R) -> Slope<R> {
        let cosine = R::ONE - p.versine;
        let e = margin.at(p);
        let turning = margin.turning.y * cosine - margin.turning.x * p.sine;
        Slope {
            value: e * p.d + margin.along * p.h + margin.credit(),
            slope: self.rate * turning * p.d + e * p.d_slope + margin.along * p.h_slope,
            curvature,
            rounding: margin.rounding,
        }
    }

    /// A bound of the second derivative of E·D up to `limit`.
    fn curvature(&self, margin: &Margin<R>, limit: &Place<R>) -> R {
        let rate = self.rate.abs();
        let (z0, zp) = (self.hold.reach(), self.drive.reach());
        let swing = margin.turning.reach();
        let d_most = R::ONE + limit.x * zp;
        let value = margin.start.abs() + swing * (limit.turn.abs().min(R::TWO));
        let bent = self.bend.bound(z0, 2);
        rate * (swing * (rate * d_most + zp.doubled()) + value * zp + margin.along.abs() * bent)
    }

    /// Shortens the course to the first place at which the margin is used up. True if it is before the end.
    pub(crate) fn stop_at(&self, margin: &Margin<R>, course: &mut Course<R>) -> bool {
        let limit = course.end;
        // The farthest that it can fall on the way: the ordinary frame is done here.
        let fall = margin.along.abs() * course.reach + margin.turning.reach() * limit.turn.abs();
        if margin.start - fall > margin.rounding {
            return false;
        }
        let found = if self.rate == R::ZERO {
            self.linear_zero(margin, &limit)
        } else {
            self.curved_zero(margin, &limit)
        };
        let (x, unsure) = match found {
            Found::Nothing { .. } => return false,
            Found::Zero { x, .. } => (x, false),
            Found::Unsure { x, .. } => (x, true),
        };
        *course = Course {
            end: self.at(x),
            reach: course.reach,
            folds: false,
            unsure: course.unsure || unsure,
        };
        true
    }

    /// The zero of a margin where the body does not turn: E·D is linear.
    fn linear_zero(&self, margin: &Margin<R>, limit: &Place<R>) -> Found<R> {
        let fall = margin.start * self.drive.x - margin.along * (self.stiffness + self.hold.x);
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

    /// The first zero of a margin before a place.
    fn curved_zero(&self, margin: &Margin<R>, limit: &Place<R>) -> Found<R> {
        let margin = &margin.scaled();
        // It lies above its chord but for the sagitta of its curvature.
        let curvature = self.curvature(margin, limit);
        let end = margin.at(limit) * limit.d + margin.along * limit.h;
        let sagitta = (curvature * limit.x * limit.x).halved().halved().halved();
        if margin.start > margin.rounding && margin.start.min(end) > sagitta {
            return Found::Nothing { x: limit.x };
        }
        first_zero((limit.x, self.tolerance), |x| {
            Look::far([self.slope(margin, &self.at(x), curvature)])
        })
    }
}
