//! A quantity on a motion with its slope and bounds of its size, slope and curvature, so that products of such quantities
//! carry the bound that the certified search needs.

use crate::geometry::Vec2;
use crate::real::Real;
use crate::roots::Slope;
use core::ops::{Add, Mul, Neg, Sub};

/// Value and slope at a place; suprema of |f|, |f'|, |f''| over the motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Jet<R> {
    pub(crate) value: R,
    pub(crate) slope: R,
    pub(crate) bounds: [R; 3],
}

impl<R: Real> Jet<R> {
    /// The same everywhere.
    pub(crate) fn constant(value: R) -> Self {
        Self {
            value,
            slope: R::ZERO,
            bounds: [value.abs(), R::ZERO, R::ZERO],
        }
    }

    /// As a function whose first zero is searched for.
    pub(crate) fn as_slope(&self, sign: R) -> Slope<R> {
        Slope {
            value: self.value * sign,
            slope: self.slope * sign,
            curvature: self.bounds[2],
            rounding: R::rounding(self.bounds[0]).doubled().doubled(),
        }
    }
}

impl<R: Real> Add for Jet<R> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        let ([f0, f1, f2], [g0, g1, g2]) = (self.bounds, b.bounds);
        Self {
            value: self.value + b.value,
            slope: self.slope + b.slope,
            bounds: [f0 + g0, f1 + g1, f2 + g2],
        }
    }
}

impl<R: Real> Neg for Jet<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            slope: -self.slope,
            bounds: self.bounds,
        }
    }
}

impl<R: Real> Sub for Jet<R> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + (-b)
    }
}

impl<R: Real> Mul for Jet<R> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let ([f0, f1, f2], [g0, g1, g2]) = (self.bounds, b.bounds);
        Self {
            value: self.value * b.value,
            slope: self.slope * b.value + self.value * b.slope,
            bounds: [
                f0 * g0,
                f1 * g0 + f0 * g1,
                f2 * g0 + (f1 * g1).doubled() + f0 * g2,
            ],
        }
    }
}

/// A vector of such quantities.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JetVec<R> {
    pub(crate) x: Jet<R>,
    pub(crate) y: Jet<R>,
}

impl<R: Real> JetVec<R> {
    pub(crate) fn constant(v: Vec2<R>) -> Self {
        Self {
            x: Jet::constant(v.x),
            y: Jet::constant(v.y),
        }
    }
    pub(crate) fn cross(self, b: Self) -> Jet<R> {
        self.x * b.y - self.y * b.x
    }
    pub(crate) fn scaled(self, k: Jet<R>) -> Self {
        Self {
            x: self.x * k,
            y: self.y * k,
        }
    }
}

impl<R: Real> Add for JetVec<R> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self {
            x: self.x + b.x,
            y: self.y + b.y,
        }
    }
}

impl<R: Real> Sub for JetVec<R> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self {
            x: self.x - b.x,
            y: self.y - b.y,
        }
    }
}
