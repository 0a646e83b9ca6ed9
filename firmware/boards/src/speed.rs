//! The speed of the Pico 2, which the emulated board in its place has, too.

use stiction_firmware::speed::Processor;

/// Clock of the processor (Hz).
pub const PICO_2: u32 = 150_000_000;
/// The highest tick rate (Hz): 30 000 cycles each.
pub const FASTEST_TICK: u16 = 5_000;
/// Pieces of work per second; a quarter of the time is reserved for the interrupts of two lines and the rest of a tick.
pub const WORK_RATE: u32 = Processor::CORTEX_M33.work_rate(PICO_2, 6);
