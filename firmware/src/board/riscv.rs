//! Instructions on an emulated RISC-V: `minstret`, which QEMU counts exactly with `-icount`.
#![allow(unsafe_code)]

use core::arch::asm;
use core::hint::black_box;
use riscv::register::minstret;

use super::{PROBE, TOLERANCE};

pub(super) struct Counter {
    /// Instructions of an empty measurement.
    idle: u64,
}

impl Counter {
    /// The counter of this board. `None`: the emulator was not started with `-icount`.
    pub(super) fn take() -> Option<Self> {
        let mut counter = Self { idle: 0 };
        let (idle, ()) = counter.count(|| ());
        counter.idle = u64::from(idle);
        let (counted, ()) = counter.count(probe);
        (counted.abs_diff(PROBE) <= TOLERANCE).then_some(counter)
    }

    #[inline(always)]
    pub(super) fn count<T>(&mut self, work: impl FnOnce() -> T) -> (u32, T) {
        let begun = minstret::read64();
        let done = work();
        let ended = minstret::read64();
        let instructions = (ended - begun).saturating_sub(self.idle);
        // None of this is deferred into the next measurement.
        (
            black_box(u32::try_from(instructions).unwrap_or(u32::MAX)),
            done,
        )
    }
}

/// [`PROBE`] instructions.
#[inline(always)]
fn probe() {
    // SAFETY: changes only a scratch register.
    unsafe {
        asm!(
            "li {n}, 250",
            "2: addi {n}, {n}, -1",
            "bnez {n}, 2b",
            n = out(reg) _,
            options(nomem, nostack),
        );
    }
}
