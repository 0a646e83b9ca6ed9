//! The number types that a run can use, and how large their numbers may be.

use clap::ValueEnum;
use stiction_core::frame::NumberType;

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
    pub(crate) const fn is_single(self) -> bool {
        matches!(self, Self::F32 | Self::Fixed)
    }
}

/// That of a board.
impl From<NumberType> for Number {
    fn from(number: NumberType) -> Self {
        match number {
            NumberType::F32 => Self::F32,
            NumberType::Fixed => Self::Fixed,
        }
    }
}
