//! Cycles on an emulated Cortex-M0+, with its waits for the flash: the emulator reads its own clock at two marks, breakpoints that take
//! no time.
#![allow(unsafe_code)]

use core::arch::asm;
use core::hint::black_box;

use super::arm::probe;
use super::{PROBE, TOLERANCE};

/// Cycles of [`probe`]: each of its 249 taken branches takes one more than an instruction.
const CYCLES: u32 = PROBE + 249;

pub(super) struct Counter;

impl Counter {
    /// The counter of this board. `None`: the emulator does not know the marks.
    pub(super) fn take() -> Option<Self> {
        let mut counter = Self;
        let mut counted = 0;
        // The first run only brings the probe, and what calls it, into the cache of the flash.
        for _ in 0..black_box(2) {
            (counted, ()) = counter.count(probe);
        }
        (counted.abs_diff(CYCLES) <= TOLERANCE).then_some(counter)
    }

    #[inline(always)]
    pub(super) fn count<T>(&mut self, work: impl FnOnce() -> T) -> (u32, T) {
        let cycles;
        // SAFETY: the emulator continues after it.
        unsafe { asm!("bkpt #1", out("r0") _) };
        let done = work();
        // SAFETY: as above; the answer is in r0.
        unsafe { asm!("bkpt #2", out("r0") cycles) };
        // None of this is deferred into the next measurement.
        (black_box(cycles), done)
    }
}
