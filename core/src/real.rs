//! What a number must do for the statics: a single interface to mathematics, so that every number type gives the same bits on every machine
//! and a type without a floating-point unit fits behind the same solver.
//!
//! Inside the solver every quantity is non-dimensional (STATICS 1, 16): lengths / L, forces / (k_h L),
//! moments / (k_h L²), angles as whole turns and a remainder. [`Real::Si`] is the float in which such a
//! number meets the outside world in SI units; for `f32` and `f64` it is the type itself.

use crate::si::SiFloat;
use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

#[cfg(feature = "comparison")]
mod comparison;
mod double;
mod fixed;
mod single;

#[cfg(feature = "comparison")]
pub use comparison::{CordicFixed, LibmSingle, MicromathSingle};
pub use fixed::Fixed;

/// A number of the solver. Implemented for `f32` (own polynomials, the default), [`Fixed`] (chips without a floating-point unit) and `f64`
/// (libm, the reference). Each gives the same bits on every machine.
///
/// Inside the solver numbers have no unit: lengths are in units of L, the body's largest vertex distance, forces of k_h L, moments of k_h
/// L² (STATICS 16). Users see them only as values of [`Self::Si`], in SI units.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialEq
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// The float in which this number type takes and returns SI values.
    type Si: SiFloat;

    /// 0
    const ZERO: Self;
    /// 1/2
    const HALF: Self;
    /// 1
    const ONE: Self;
    /// 2
    const TWO: Self;
    /// One turn, 2 pi (rad).
    const TAU: Self;
    /// The larger of the relative and the absolute rounding of a number near 1.
    const EPSILON: Self;
    /// Gaps below this fraction of the body size close together (R36): 1e-10 in `f64`, 1e-6 in `f32`, 2^-19 in [`Fixed`].
    const TOUCH: Self;
    /// Slips and displacements of the hand below this fraction of the body size are not distinguished (STATICS 16): 2^-19 in every type.
    const MICRO: Self;
    /// The farthest coordinate that is accepted, in body sizes: 1e12 in `f64`, 1e6 in `f32`, 16 in [`Fixed`].
    const RANGE: Self;
    /// The largest moment of the springs that is accepted, in k_h L²: 4 [`Self::RANGE`].
    const LOAD: Self;
    /// The largest angle by which a hand may be turned from the body that it holds (rad): 1e5, in [`Fixed`] 64.
    const TURN: Self;
    /// A number beyond every root: the limit of an unlimited search.
    const HUGE: Self;
    /// -[`Self::HUGE`]
    const LEAST: Self;

    /// A whole number.
    fn from_int(n: i32) -> Self;
    /// From a value in the outside float, in units of which `per` make 1 there: x·per.
    fn from_si(x: Self::Si, per: Self::Si) -> Self;
    /// To the outside float, times a unit.
    fn to_si(self, unit: Self::Si) -> Self::Si;
    /// False for infinity and NaN.
    fn is_finite(self) -> bool;
    /// The square root; 0 for a negative number.
    fn sqrt(self) -> Self;
    /// Sine and cosine of an angle in radians, |angle| <= 2 pi.
    fn sin_cos(self) -> (Self, Self);
    /// The angle of the vector (x, y) = (`other`, `self`) in [-pi, pi]; 0 for the zero vector.
    fn atan2(self, other: Self) -> Self;
    /// An angle (rad) as whole turns and a remainder in [-pi, pi].
    fn turns(self) -> (i32, Self);

    /// 2 x
    fn doubled(self) -> Self {
        self + self
    }
    /// x / 2
    fn halved(self) -> Self {
        self * Self::HALF
    }
    /// a b + c d; for a type that rounds to a fixed step, rounded once.
    fn sum_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        a * b + c * d
    }
    /// a b - c d; for a type that rounds to a fixed step, rounded once.
    fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        a * b - c * d
    }
    /// sqrt(a b + c d); 0 if that is negative.
    fn root_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        Self::sum_of_products(a, b, c, d).sqrt()
    }
    /// A unit for numbers of this size, positive: the size itself, or a power of two nearby.
    fn unit(self) -> Self {
        self
    }
    /// This number in such units.
    fn in_units(self, unit: Self) -> Self {
        self / unit
    }
    /// The rounding of a sum of numbers of a given magnitude.
    fn rounding(size: Self) -> Self {
        Self::EPSILON * size
    }
    /// sin(x) / x, which is 1 at 0, and cos(x).
    fn sinc_cos(self) -> (Self, Self) {
        let (sin, cos) = self.sin_cos();
        let sinc = if self == Self::ZERO {
            Self::ONE
        } else {
            sin / self
        };
        (sinc, cos)
    }
    /// |x|
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }
    /// The smaller one; `self` if they are equal.
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
    /// The larger one; `self` if they are equal.
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
    /// -1 for a negative number, otherwise 1.
    fn sign(self) -> Self {
        if self < Self::ZERO {
            -Self::ONE
        } else {
            Self::ONE
        }
    }
    /// sqrt(x² + y²), scaled so that it neither overflows nor underflows. Compiled once per image.
    #[inline(never)]
    fn hypot(self, other: Self) -> Self {
        let (x, y) = (self.abs(), other.abs());
        let (large, small) = if x > y { (x, y) } else { (y, x) };
        if large == Self::ZERO {
            return Self::ZERO;
        }
        let ratio = small / large;
        large * (Self::ONE + ratio * ratio).sqrt()
    }
}

#[cfg(test)]
mod tests;
