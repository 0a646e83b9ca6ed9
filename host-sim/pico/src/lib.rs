//! A Raspberry Pi Pico in this process: from an image to what its RP2040 does, cycle by cycle.
//!
//! [`Chip`] is the chip with one of its cores and what the firmware uses of it, [`Board`] the chip at the pace of the real clock with
//! its serial line on a unix socket.
//!
//! Processor, memory, clocks and timer are those of the crate `rp2040-emu`. Added here are what it leaves out: interrupts that
//! interrupt others, a serial line that receives, a watchdog that resets the chip. Its branches take the three cycles of a Cortex-M0
//! and are corrected to the two of a Cortex-M0+: every instruction takes what Arm's manual (DDI 0484C, table 3-1) states for a memory
//! without wait states. Left out are misses of the cache through which the chip runs code from its flash, the second core, and USB.

#[cfg(unix)]
mod board;
mod bus;
mod chip;
mod handlers;
mod uart;
mod watchdog;

#[cfg(unix)]
pub use board::Board;
pub use chip::{Chip, FLASH, MEGAHERTZ, VECTORS, length};
