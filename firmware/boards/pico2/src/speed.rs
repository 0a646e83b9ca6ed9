//! How fast the board is. The emulated board that stands in for it has the same.

/// Of the processor (Hz).
pub(crate) const CLOCK: u32 = 150_000_000;
/// The most ticks (Hz): 30 000 cycles each.
pub(crate) const FASTEST_TICK: u16 = 5_000;
/// Units of work of a second: one takes 620 cycles at most in a long step (host-sim/README.md, at 2 cycles of an instruction).
/// A quarter of its time is for the interrupts of the lines and what else a tick does.
pub(crate) const WORK_RATE: u32 = CLOCK / 620 / 4 * 3;
