//! The speed of processors: the pieces of work per second, from which the budget of a step follows.

/// A processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Processor {
    /// The largest number of cycles of a piece of work.
    piece: u32,
}

impl Processor {
    /// With fixed point: 76 400 instructions (host-sim/README.md), of 1.65 cycles each.
    pub const CORTEX_M0: Self = Self { piece: 126_000 };
    /// With fixed point, taken to be that of an M0.
    pub const CORTEX_M0_PLUS: Self = Self { piece: 126_000 };
    /// With f32: 10 200 instructions (host-sim/README.md), of 2 cycles each.
    pub const CORTEX_M4F: Self = Self { piece: 20_400 };
    /// With f32, taken to be that of an M4F.
    pub const CORTEX_M33: Self = Self { piece: 20_400 };

    /// Pieces of work per second at a clock (Hz), if the solver has this many eighths of the time, 0 to 8. The rest is for the interrupts of
    /// the line and the other work of a tick.
    pub const fn work_rate(self, clock: u32, eighths: u32) -> u32 {
        // No processor has a piece of zero cycles.
        clock / self.piece / 8 * eighths
    }
}
