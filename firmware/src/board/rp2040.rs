//! Cycles on an emulated Cortex-M0+: the emulator reads its own clock at two marks, breakpoints that take no time.
#![allow(unsafe_code)]

use core::arch::asm;
use core::hint::black_box;

use super::TOLERANCE;
use super::arm::probe;
use super::stack::Watch;
use crate::count::Instruments;

/// Cycles of [`probe`]: every branch that is taken takes one more than an instruction.
const CYCLES: u32 = 750;

/// Counts cycles.
pub(super) struct Counter {
    watch: Option<Watch>,
}

impl Counter {
    /// The counter of this board. `None`: the emulator does not know the marks.
    pub(super) fn take() -> Option<Self> {
        let mut counter = Self { watch: None };
        let (counted, ()) = counter.count(probe);
        (counted.abs_diff(CYCLES) <= TOLERANCE).then_some(counter)
    }
}

impl Instruments for Counter {
    #[inline(always)]
    fn count<T>(&mut self, work: impl FnOnce() -> T) -> (u32, T) {
        let cycles;
        // SAFETY: the emulator goes on behind it.
        unsafe { asm!("bkpt #1", out("r0") _) };
        let done = work();
        // SAFETY: likewise; the answer is in r0.
        unsafe { asm!("bkpt #2", out("r0") cycles) };
        // Nothing of this is put off into the next work.
        (black_box(cycles), done)
    }
    #[inline(always)]
    fn watch_stack(&mut self) {
        self.watch = Some(Watch::begin());
    }
    fn deepest_stack(&mut self) -> u32 {
        self.watch.as_ref().map_or(0, Watch::depth)
    }
}
