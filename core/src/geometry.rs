//! Vectors, rotations, unwrapped angles and wrenches in the plane. (a, b): a·b; a×b = a_x b_y - a_y b_x; i a is a quarter turn counter-clockwise, (i a)×b =
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

/// An unwrapped angle, counter-clockwise positive: whole turns and a remainder, so that many turns do not reduce accuracy (R45).
///
/// ```
/// use core::f32::consts::TAU;
/// use stiction_core::Angle;
///
/// let many = Angle { turns: 100_000, rest: 0.25_f32 };
/// let on = many.plus(0.001);
/// assert!((on.minus(many) - 0.001).abs() < 1e-7, "a milliradian is one still");
/// assert!((on.radians() - many.radians() - 0.001).abs() > 5e-4, "a single number loses it");
///
/// let wound = Angle::from_radians(3.0 * TAU - 0.5);
/// assert_eq!(wound.turns, 3);
/// assert!((wound.rest + 0.5).abs() < 1e-5);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angle<R> {
    /// Whole turns.
    pub turns: i32,
    /// The remainder (rad), in [-pi, pi].
    pub rest: R,
}

impl<R: Real> Angle<R> {
    /// From an unwrapped angle (rad).
    pub fn from_radians(radians: R) -> Self {
        let (turns, rest) = radians.turns();
        Self { turns, rest }
    }
    /// The unwrapped angle (rad); beyond a few turns it has fewer digits than the pair.
    pub fn radians(self) -> R {
        R::from_int(self.turns) * R::TAU + self.rest
    }
    /// This angle increased by `radians`. Beyond 2^31 turns the count saturates. Compiled once per image.
    #[inline(never)]
    #[must_use]
    pub fn plus(self, radians: R) -> Self {
        let (turns, rest) = (self.rest + radians).turns();
        Self {
            turns: self.turns.saturating_add(turns),
            rest,
        }
    }
    /// `self` - `other` (rad), exact to the rounding of the remainders if the turns are the same.
    pub fn minus(self, other: Self) -> R {
        let rest = self.rest - other.rest;
        match self.turns.saturating_sub(other.turns) {
            0 => rest,
            turns => R::from_int(turns) * R::TAU + rest,
        }
    }
    /// `self` - `other` as an unwrapped angle, which keeps its digits at any number of turns.
    #[must_use]
    pub fn offset_from(self, other: Self) -> Self {
        let (turns, rest) = (self.rest - other.rest).turns();
        Self {
            turns: self.turns.saturating_sub(other.turns).saturating_add(turns),
            rest,
        }
    }
    /// False if the remainder is infinite or NaN.
    pub fn is_finite(self) -> bool {
        self.rest.is_finite()
    }
}

/// A force (k_h L) and its moment about the holding point (k_h L²).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Wrench<R> {
    pub(crate) force: Vec2<R>,
    pub(crate) moment: R,
}

impl<R: Real> Wrench<R> {
    pub(crate) const ZERO: Self = Self {
        force: Vec2::ZERO,
        moment: R::ZERO,
    };
    /// A moment of 1 without a force.
    pub(crate) const COUPLE: Self = Self {
        force: Vec2::ZERO,
        moment: R::ONE,
    };
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
    /// In other units.
    pub(crate) fn in_units(self, unit: R) -> Self {
        Self {
            force: self.force.in_units(unit),
            moment: self.moment.in_units(unit),
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
