//! Instructions on an emulated Cortex-M: SysTick, whose clock QEMU derives from the instructions with `-icount shift=N`, where each takes
//! 2^N ns.
#![allow(unsafe_code)]

use core::hint::black_box;
use core::sync::atomic::{AtomicU32, Ordering};
use cortex_m::Peripherals;
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::exception;

use super::arm::probe;
use super::{PROBE, TOLERANCE};

/// Clock of SysTick (Hz) and N of `-icount shift=N`, which give more than 4 ticks per instruction.
#[cfg(chip = "stm32f405")]
const CLOCK_AND_SHIFT: (u64, u32) = (168_000_000, 5);
#[cfg(chip = "nrf51822")]
const CLOCK_AND_SHIFT: (u64, u32) = (16_000_000, 8);
#[cfg(chip = "an505")]
const CLOCK_AND_SHIFT: (u64, u32) = (20_000_000, 8);

/// SysTick counts down from here.
const RELOAD: u32 = 0x00FF_FFFF;

/// The number of times that SysTick reached 0.
static ROUNDS: AtomicU32 = AtomicU32::new(0);

pub(super) struct Counter {
    systick: SYST,
    /// Ticks of an empty measurement.
    idle: u64,
}

impl Counter {
    /// The counter of this board. `None`: it is taken, or the emulator was not started with the right `-icount`.
    pub(super) fn take() -> Option<Self> {
        let mut systick = Peripherals::take()?.SYST;
        systick.set_clock_source(SystClkSource::Core);
        systick.set_reload(RELOAD);
        systick.enable_interrupt();
        systick.enable_counter();
        let mut counter = Self { systick, idle: 0 };
        (counter.idle, ()) = counter.ticks(|| ());
        let (counted, ()) = counter.count(probe);
        (counted.abs_diff(PROBE) <= TOLERANCE).then_some(counter)
    }

    #[inline(always)]
    fn ticks<T>(&mut self, work: impl FnOnce() -> T) -> (u64, T) {
        self.systick.clear_current();
        ROUNDS.store(0, Ordering::SeqCst);
        let begun = SYST::get_current();
        let done = work();
        let ended = SYST::get_current();
        let rounds = u64::from(ROUNDS.load(Ordering::SeqCst));
        let ticks =
            (rounds * u64::from(RELOAD + 1) + u64::from(begun)).saturating_sub(u64::from(ended));
        // None of this is deferred into the next measurement.
        (black_box(ticks), done)
    }

    #[inline(always)]
    pub(super) fn count<T>(&mut self, work: impl FnOnce() -> T) -> (u32, T) {
        let (ticks, done) = self.ticks(work);
        let (clock, shift) = CLOCK_AND_SHIFT;
        let per_second = 1_000_000_000 >> shift;
        let instructions = (ticks.saturating_sub(self.idle) * per_second + clock / 2) / clock;
        (u32::try_from(instructions).unwrap_or(u32::MAX), done)
    }
}

#[exception]
fn SysTick() {
    ROUNDS.store(ROUNDS.load(Ordering::SeqCst) + 1, Ordering::SeqCst);
}
