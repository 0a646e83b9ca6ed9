//! The number types of a run and their largest numbers; number types and evolutions by name.

use stiction_core::Evolution;
use stiction_wire::NumberType;

/// A number type of the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
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

    /// Returns the name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
            Self::Fixed => "fixed",
        }
    }

    /// Returns the largest value of the type in SI units.
    pub const fn limit(self) -> f64 {
        match self {
            Self::F32 | Self::Fixed => f32::MAX as f64,
            Self::F64 => f64::MAX,
        }
    }

    /// Returns whether results are f32 values, to be printed with the digits of f32.
    pub const fn is_single(self) -> bool {
        matches!(self, Self::F32 | Self::Fixed)
    }
}

/// The number type of a board.
impl From<NumberType> for Number {
    fn from(number: NumberType) -> Self {
        match number {
            NumberType::F32 => Self::F32,
            NumberType::Fixed => Self::Fixed,
        }
    }
}

/// Returns the item with this name.
///
/// # Errors
/// The allowed names.
pub fn named<T: Copy, const N: usize>(
    all: [T; N],
    name: fn(T) -> &'static str,
    text: &str,
) -> Result<T, String> {
    let allowed = || format!("allowed: {}", all.map(name).join(", "));
    let found = all.into_iter().find(|one| name(*one) == text);
    found.ok_or_else(allowed)
}

/// Returns the number type with this name.
///
/// # Errors
/// The allowed names.
pub fn parse_number(text: &str) -> Result<Number, String> {
    named(Number::ALL, Number::name, text)
}

/// Returns the evolution with this name.
///
/// # Errors
/// The allowed names.
pub fn parse_evolution(text: &str) -> Result<Evolution, String> {
    named(Evolution::ALL, Evolution::name, text)
}

/// Returns the number type and the evolution with these names.
///
/// # Errors
/// What is wrong, and the allowed names.
pub fn parse_kind(number: &str, evolution: &str) -> Result<(Number, Evolution), String> {
    let problem = |key, given| move |allowed| format!("`{key}` is {given:?}, {allowed}");
    Ok((
        parse_number(number).map_err(problem("number", number))?,
        parse_evolution(evolution).map_err(problem("evolution", evolution))?,
    ))
}
