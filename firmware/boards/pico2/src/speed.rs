//! How fast the board is. The emulated board that stands in for it has the same.

use stiction_firmware::speed::Processor;

/// Of the processor (Hz).
pub(crate) const CLOCK: u32 = 150_000_000;
/// The most ticks (Hz): 30 000 cycles each.
pub(crate) const FASTEST_TICK: u16 = 5_000;
/// Units of work of a second; a quarter of its time is for the interrupts of two lines and what else a tick does.
pub(crate) const WORK_RATE: u32 = Processor::CORTEX_M33.work_rate(CLOCK, 6);
