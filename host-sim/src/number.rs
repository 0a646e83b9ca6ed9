//! The number types that a run can use, and the way between the host's f64 and the floats that the solver takes.

use clap::ValueEnum;
use stiction_core::{Angle, Hand, Real};

/// A number type of the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Number {
    /// Single precision: the type of the product.
    F32,
    /// Double precision: the reference.
    F64,
    /// Fixed point with f32 outside: for chips without a floating point unit.
    Fixed,
}

impl Number {
    /// All number types.
    pub const ALL: [Self; 3] = [Self::F64, Self::F32, Self::Fixed];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
            Self::Fixed => "fixed",
        }
    }

    /// The largest value that the type takes in SI units.
    pub const fn limit(self) -> f64 {
        match self {
            Self::F32 | Self::Fixed => f32::MAX as f64,
            Self::F64 => f64::MAX,
        }
    }

    /// Whether results are f32 values, to be printed with the digits of f32.
    pub const fn is_single(self) -> bool {
        matches!(self, Self::F32 | Self::Fixed)
    }
}

/// A float in which the solver takes and gives SI values.
pub trait SiFloat: Real<Si = Self> {
    /// The nearest value of this type.
    fn narrow(value: f64) -> Self;
    /// The same value as f64.
    fn widen(self) -> f64;
}

impl SiFloat for f32 {
    fn narrow(value: f64) -> Self {
        value as Self
    }
    fn widen(self) -> f64 {
        f64::from(self)
    }
}

impl SiFloat for f64 {
    fn narrow(value: f64) -> Self {
        value
    }
    fn widen(self) -> f64 {
        self
    }
}

/// The hand of the solver; the angle is split into turns and remainder before it is rounded (STATICS 10).
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
