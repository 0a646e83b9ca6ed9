//! The speed of processors: the units of work per second, from which the budget of a step follows.

/// A processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Processor {
    /// The largest number of cycles of a unit of work in a long step.
    unit: u32,
}

impl Processor {
    /// With fixed point, where a unit takes 3 430 cycles: measured in instructions (host-sim/README.md), of 1.65 cycles each.
    pub const CORTEX_M0: Self = Self { unit: 3_430 };
    /// With fixed point: 3 173 cycles, counted (host-sim/README.md).
    pub const CORTEX_M0_PLUS: Self = Self { unit: 3_173 };
    /// With f32: 630 cycles, measured in instructions (host-sim/README.md), of 2 cycles each.
    pub const CORTEX_M4F: Self = Self { unit: 630 };
    /// With f32: 620 cycles, measured in instructions (host-sim/README.md), of 2 cycles each.
    pub const CORTEX_M33: Self = Self { unit: 620 };

    /// Units of work per second at a clock (Hz), if the solver has this many eighths of the time, 0 to 8. The rest is for the interrupts of
    /// the line and the other work of a tick.
    pub const fn work_rate(self, clock: u32, eighths: u32) -> u32 {
        // No processor has a unit of zero cycles.
        clock / self.unit / 8 * eighths
    }
}
