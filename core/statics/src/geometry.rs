//! Vectors, rotations and wrenches in the plane. (a, b): a·b; a×b = a_x b_y - a_y b_x; i a is a quarter turn counter-clockwise, (i a)×b =
//! -a·b.

use crate::real::Real;
use core::ops::{Add, Mul, Neg, Sub};

/// A vector in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Vec2<R> {
    /// Along the world's (or the body's) first axis.
    pub(crate) x: R,
    /// Along the second axis.
    pub(crate) y: R,
}

impl<R: Real> Vec2<R> {
    /// The zero vector.
    pub(crate) const ZERO: Self = Self {
        x: R::ZERO,
        y: R::ZERO,
    };

    /// The vector (x, y).
    pub(crate) const fn new(x: R, y: R) -> Self {
        Self { x, y }
    }
    /// a·b
    pub(crate) fn dot(self, b: Self) -> R {
        R::sum_of_products(self.x, b.x, self.y, b.y)
    }
    /// a×b = a_x b_y - a_y b_x
    pub(crate) fn cross(self, b: Self) -> R {
        R::difference_of_products(self.x, b.y, self.y, b.x)
    }
    /// i a: rotated by a quarter turn counter-clockwise.
    pub(crate) fn turned(self) -> Self {
        Self::new(-self.y, self.x)
    }
    /// The length, safe against overflow and underflow.
    pub(crate) fn length(self) -> R {
        self.x.hypot(self.y)
    }
    /// An upper bound of the length that needs no square root, larger by at most an eighth.
    pub(crate) fn length_bound(self) -> R {
        let (x, y) = (self.x.abs(), self.y.abs());
        x + y - x.min(y).halved()
    }
    /// In other units.
    pub(crate) fn in_units(self, unit: R) -> Self {
        Self::new(self.x.in_units(unit), self.y.in_units(unit))
    }
}

impl<R: Real> Add for Vec2<R> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::new(self.x + b.x, self.y + b.y)
    }
}

impl<R: Real> Sub for Vec2<R> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self::new(self.x - b.x, self.y - b.y)
    }
}

impl<R: Real> Neg for Vec2<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

impl<R: Real> Mul<R> for Vec2<R> {
    type Output = Self;
    fn mul(self, k: R) -> Self {
        Self::new(self.x * k, self.y * k)
    }
}

/// The vector (x, y), not zero, scaled to length 1.
pub(crate) fn normalized<F: Real>(x: F, y: F) -> (F, F) {
    let length = x.hypot(y);
    (x / length, y / length)
}

/// 1/n
pub(crate) fn one_in<F: Real>(n: i32) -> F {
    F::ONE / F::from_int(n)
}

/// A rotation R(theta), stored as cosine and sine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rotation<R> {
    /// cos(theta)
    pub(crate) cos: R,
    /// sin(theta)
    pub(crate) sin: R,
}

impl<R: Real> Rotation<R> {
    /// The inverse of [`Self::apply`]: from the world frame to the body frame.
    pub(crate) fn undo(self, a: Vec2<R>) -> Vec2<R> {
        Vec2::new(
            R::sum_of_products(self.cos, a.x, self.sin, a.y),
            R::difference_of_products(self.cos, a.y, self.sin, a.x),
        )
    }
    /// Of an angle (rad) of any size.
    pub(crate) fn by(theta: R) -> Self {
        let theta = if theta.abs() > R::TAU {
            theta.turns().1
        } else {
            theta
        };
        let (sin, cos) = theta.sin_cos();
        Self { cos, sin }
    }
    /// R a: from the body frame to the world frame.
    pub(crate) fn apply(self, a: Vec2<R>) -> Vec2<R> {
        Vec2::new(
            R::difference_of_products(self.cos, a.x, self.sin, a.y),
            R::sum_of_products(self.sin, a.x, self.cos, a.y),
        )
    }
    /// Turned on by so little that the square of the turn is rounding.
    pub(crate) fn nudged(self, turn: R) -> Self {
        Self {
            cos: self.cos - self.sin * turn,
            sin: self.sin + self.cos * turn,
        }
    }
}

/// A force (k_h L) and its moment about the holding point (k_h L²).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Wrench<R> {
    pub(crate) force: Vec2<R>,
    pub(crate) moment: R,
}

impl<R: Real> Wrench<R> {
    /// Of a force at a lever.
    pub(crate) fn at(lever: Vec2<R>, force: Vec2<R>) -> Self {
        Self {
            force,
            moment: lever.cross(force),
        }
    }
    /// A product that is zero for a wrench in the plane of two others.
    pub(crate) fn dot(self, b: Self) -> R {
        self.force.dot(b.force) + self.moment * b.moment
    }
    /// Normal to two wrenches, as a facet of their cone.
    pub(crate) fn cross(self, b: Self) -> Self {
        let (f, g) = (self.force, b.force);
        Self {
            force: Vec2::new(
                R::difference_of_products(f.y, b.moment, self.moment, g.y),
                R::difference_of_products(self.moment, g.x, f.x, b.moment),
            ),
            moment: f.cross(g),
        }
    }
    /// The larger one of the force and of the moment.
    pub(crate) fn size(self) -> R {
        self.force.length_bound().max(self.moment.abs())
    }
}

impl<R: Real> Add for Wrench<R> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self {
            force: self.force + b.force,
            moment: self.moment + b.moment,
        }
    }
}

impl<R: Real> Mul<R> for Wrench<R> {
    type Output = Self;
    fn mul(self, k: R) -> Self {
        Self {
            force: self.force * k,
            moment: self.moment * k,
        }
    }
}
