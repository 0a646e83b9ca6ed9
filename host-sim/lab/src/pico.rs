//! A Raspberry Pi Pico in this process: from an image to the behaviour of its RP2040, cycle by cycle.
//!
//! [`Chip`] is the chip with one of its cores and the peripherals that the firmware uses, `board` the chip at the pace of the real
//! clock with its serial line on a unix socket.
//!
//! Processor, memory, clocks and timer come from the crate `rp2040-emu`. This module adds what it lacks: interrupts that preempt
//! others, a serial line that receives, a watchdog that resets the chip. The crate's branches take the three cycles of a Cortex-M0
//! and are corrected to the two of a Cortex-M0+: every instruction takes the time that Arm's manual (DDI 0484C, table 3-1) states for
//! a memory without wait states. Misses of the cache through which the chip reads its flash are counted, by the model of `cache`, and take
//! no time. Of the ROM there is what erases and programs the flash, by the model of `chip/rom.rs`. Not emulated are the second core, and USB.

#[cfg(unix)]
pub mod board;
mod bus;
mod cache;
mod chip;
mod handlers;
mod uart;
mod watchdog;

#[cfg(test)]
pub(crate) use cache::MISS;
pub use chip::{Chip, FLASH, MEGAHERTZ, VECTORS, length};
