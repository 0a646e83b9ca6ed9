//! The speed of the board. The emulated board that stands in for it has the same.

use stiction_firmware::speed::Processor;

/// Clock of the processor (Hz).
pub(crate) const CLOCK: u32 = 150_000_000;
/// The highest tick rate (Hz): 30 000 cycles each.
pub(crate) const FASTEST_TICK: u16 = 5_000;
/// Units of work per second; a quarter of the time is reserved for the interrupts of two lines and the rest of a tick.
pub(crate) const WORK_RATE: u32 = Processor::CORTEX_M33.work_rate(CLOCK, 6);
