//! The floats in which the solver takes and gives SI values, and their way from and to the f64 and the bits of a file.

use crate::geometry::Angle;
use crate::hand::Hand;
use crate::real::Real;

/// A float in which the solver takes and gives SI values: `f32`, also that of [`Fixed`](crate::Fixed), and `f64`.
pub trait SiFloat: Real<Si = Self> {
    /// The nearest value of this type.
    fn narrow(value: f64) -> Self;
    /// The same value as f64.
    fn widen(self) -> f64;
    /// The bits, those of f32 in the lower half.
    fn bits(self) -> u64;
}

impl SiFloat for f32 {
    fn narrow(value: f64) -> Self {
        value as Self
    }
    fn widen(self) -> f64 {
        f64::from(self)
    }
    fn bits(self) -> u64 {
        u64::from(self.to_bits())
    }
}

impl SiFloat for f64 {
    fn narrow(value: f64) -> Self {
        value
    }
    fn widen(self) -> f64 {
        self
    }
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// A hand given in f64, as files hold it, in the float of a number type; the angle stays split into turns and remainder. What the
/// float cannot hold becomes infinite, which the solver refuses.
pub fn narrow_hand<F: SiFloat>(hand: &Hand<f64>) -> Hand<F> {
    Hand {
        position: hand.position.map(F::narrow),
        angle: Angle {
            turns: hand.angle.turns,
            rest: F::narrow(hand.angle.rest),
        },
        depth: F::narrow(hand.depth),
        held: hand.held,
    }
}
