//! The speed of processors: the pieces of work per second, from which the budget of a step follows.

/// A processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Processor {
    /// The cycles of a piece of work, on average over random drags (host-sim/TRADE.md): the ticks of a board interrupt its steps, so that a
    /// longer piece costs the pose a tick, but no force. A budget by the longest piece would leave the body behind for half a second.
    piece: u32,
}

impl Processor {
    /// With fixed point: 10 900 instructions, of 1.65 cycles each.
    pub const CORTEX_M0: Self = Self { piece: 18_000 };
    /// With fixed point, counted.
    pub const CORTEX_M0_PLUS: Self = Self { piece: 12_300 };
    /// With f32: 1 370 instructions, of 2 cycles each.
    pub const CORTEX_M4F: Self = Self { piece: 2_740 };
    /// With f32: 1 310 instructions, of 2 cycles each.
    pub const CORTEX_M33: Self = Self { piece: 2_620 };

    /// Pieces of work per second at a clock (Hz), if the solver has this many eighths of the time, 0 to 8. The rest is for the interrupts of
    /// the line and the other work of a tick.
    pub const fn work_rate(self, clock: u32, eighths: u32) -> u32 {
        // No processor has a piece of zero cycles.
        clock / self.piece / 8 * eighths
    }
}
