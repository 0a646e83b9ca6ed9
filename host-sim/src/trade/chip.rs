//! The chips for which figures are given: their names, the number type that suits them, and the time of the counted instructions
//! or cycles.

use stiction_scene::NumberType;

/// A chip on which the solver was counted in emulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chip {
    /// Cortex-M4 with a floating point unit, in an STM32F405.
    CortexM4F,
    /// Cortex-M33 with a floating point unit, in an RP2350.
    CortexM33,
    /// Cortex-M0, in an nRF51822.
    CortexM0,
    /// Cortex-M0+, in an RP2040. Its cycles are counted, not its instructions.
    CortexM0Plus,
}

impl Chip {
    /// All chips.
    pub const ALL: [Self; 4] = [
        Self::CortexM4F,
        Self::CortexM33,
        Self::CortexM0,
        Self::CortexM0Plus,
    ];

    /// The name for a reader.
    pub const fn name(self) -> &'static str {
        match self {
            Self::CortexM4F => "Cortex-M4F",
            Self::CortexM33 => "Cortex-M33",
            Self::CortexM0 => "Cortex-M0",
            Self::CortexM0Plus => "Cortex-M0+",
        }
    }

    /// The name in files and columns.
    pub const fn key(self) -> &'static str {
        match self {
            Self::CortexM4F => "cortex_m4f",
            Self::CortexM33 => "cortex_m33",
            Self::CortexM0 => "cortex_m0",
            Self::CortexM0Plus => "cortex_m0plus",
        }
    }

    /// The number type that suits it: fixed point if there is no floating point unit.
    pub const fn number(self) -> NumberType {
        match self {
            Self::CortexM4F | Self::CortexM33 => NumberType::F32,
            Self::CortexM0 | Self::CortexM0Plus => NumberType::Fixed,
        }
    }

    /// Its clock (MHz).
    pub const fn megahertz(self) -> u32 {
        match self {
            Self::CortexM4F => 168,
            Self::CortexM33 => 150,
            Self::CortexM0 => 16,
            Self::CortexM0Plus => 125,
        }
    }

    /// The counted unit, for a reader.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::CortexM0Plus => "cycles",
            Self::CortexM4F | Self::CortexM33 | Self::CortexM0 => "instructions",
        }
    }

    /// Cycles per counted unit, on average: 1 if cycles are counted, otherwise an estimate.
    ///
    /// For the M4F and the M33, it is an upper estimate from every instruction that random drags execute and the most cycles that
    /// Arm's manual (DDI 0439D, tables 3-1 and 7-1) gives for it, without wait states: 1.93 to 1.99. If branches take the three cycles of an M0, the counted cycles of an M0+ are 1.53 to 1.64 per instruction.
    pub const fn cycles(self) -> f64 {
        match self {
            Self::CortexM4F | Self::CortexM33 => 2.0,
            Self::CortexM0 => 1.65,
            Self::CortexM0Plus => 1.0,
        }
    }

    /// The time for the counted units (µs).
    pub fn microseconds(self, counted: f64) -> f64 {
        counted * self.cycles() / f64::from(self.megahertz())
    }

    /// The source of its time, for a reader.
    pub fn timing(self) -> String {
        let (name, megahertz) = (self.name(), self.megahertz());
        match self {
            Self::CortexM0Plus => format!("{name} at {megahertz} MHz, cycles counted"),
            Self::CortexM4F | Self::CortexM33 | Self::CortexM0 => format!(
                "{name} at {megahertz} MHz, estimated at {} cycles of an instruction",
                self.cycles()
            ),
        }
    }
}
