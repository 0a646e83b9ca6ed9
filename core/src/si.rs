//! The floats in which the solver takes and returns SI values, and their conversion from and to the f64 and the bits of a file.

use crate::geometry::Angle;
use crate::hand::Hand;
use crate::real::Real;

/// A float in which the solver takes and returns SI values: `f32`, also that of [`Fixed`](crate::Fixed), and `f64`.
pub trait SiFloat: Real<Si = Self> {
    /// The nearest value of this type.
    fn narrow(value: f64) -> Self;
    /// This value as f64.
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

/// A hand given in f64, as files store it, in the float of a number type; the angle stays split into turns and remainder. Values that the
/// float cannot represent become infinite, which the solver refuses.
pub fn narrow_hand<F: SiFloat>(hand: &Hand<f64>) -> Hand<F> {
    Hand {
        position: hand.position.map(F::narrow),
        angle: Angle {
            turns: hand.angle.turns,
            rest: F::narrow(hand.angle.rest),
        },
        depth: F::narrow(hand.depth),
        held: hand.held,
        tilted: hand.tilted,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn float_goes_to_f64_and_back_by_its_bits() {
        for x in [0.0, -0.0, 1.5, -0.1, 3e-42, f32::MAX, f32::INFINITY] {
            assert_eq!(f32::narrow(x.widen()).bits(), u64::from(x.to_bits()));
            assert_eq!(x.widen(), f64::from(x));
        }
        for x in [0.0, -0.0, 1.5, -0.1, 3e-320, f64::MAX, f64::INFINITY] {
            assert_eq!(f64::narrow(x.widen()).bits(), x.to_bits());
            assert_eq!(x.widen(), x);
        }
        // To the nearest one, and to infinity.
        let next = f32::from_bits(1.0_f32.to_bits() + 1);
        assert_eq!(f32::narrow(1.0 + 0.7 * f64::from(f32::EPSILON)), next);
        assert_eq!(f32::narrow(-1e300), f32::NEG_INFINITY);
    }

    #[test]
    fn narrow_hand_keeps_turns_and_hold() {
        let angle = Angle {
            turns: 1_000_000,
            rest: -0.1,
        };
        for held in [true, false] {
            let hand = Hand {
                position: [0.1, 1e300],
                angle,
                depth: 0.3,
                held,
                tilted: !held,
            };
            let narrow = Hand {
                position: [0.1_f32, f32::INFINITY],
                angle: Angle {
                    turns: 1_000_000,
                    rest: -0.1_f32,
                },
                depth: 0.3_f32,
                held,
                tilted: !held,
            };
            assert_eq!(narrow_hand::<f32>(&hand), narrow);
            assert_eq!(narrow_hand::<f64>(&hand), hand);
        }
    }
}
