//! The chips that figures are given for: their names, their emulated boards, the number type that suits them.

use stiction_scene::NumberType;

use super::Board;

/// A chip on which the solver is counted in emulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Chip {
    /// Cortex-M4 with a floating point unit.
    CortexM4F,
    /// Cortex-M0.
    CortexM0,
}

impl Chip {
    /// All chips.
    pub(crate) const ALL: [Self; 2] = [Self::CortexM4F, Self::CortexM0];

    /// The name for a reader.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::CortexM4F => "Cortex-M4F",
            Self::CortexM0 => "Cortex-M0",
        }
    }

    /// The name in files and columns.
    pub(crate) const fn key(self) -> &'static str {
        match self {
            Self::CortexM4F => "cortex_m4f",
            Self::CortexM0 => "cortex_m0",
        }
    }

    /// The emulated board that has it.
    pub(crate) const fn board(self) -> Board {
        match self {
            Self::CortexM4F => Board::Stm32F405,
            Self::CortexM0 => Board::Nrf51822,
        }
    }

    /// The number type that suits it: fixed point where there is no floating point unit.
    pub(crate) const fn number(self) -> NumberType {
        match self {
            Self::CortexM4F => NumberType::F32,
            Self::CortexM0 => NumberType::Fixed,
        }
    }
}
