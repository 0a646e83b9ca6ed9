//! Common to all emulated Arm chips.
#![allow(unsafe_code)]

use core::arch::asm;
use cortex_m_rt::{ExceptionFrame, exception};

/// [`PROBE`](super::PROBE) instructions.
#[inline(always)]
pub(super) fn probe() {
    // SAFETY: changes only a scratch register and the flags.
    unsafe {
        asm!(
            "movs {n}, #250",
            "2: subs {n}, {n}, #1",
            "bne 2b",
            n = out(reg) _,
            options(nomem, nostack),
        );
    }
}

#[exception]
unsafe fn HardFault(_: &ExceptionFrame) -> ! {
    semihosting::process::exit(102)
}
