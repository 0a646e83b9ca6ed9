//! What happens on a board when it cannot go on: a panic, a fault, an exception that nothing handles.
#![allow(unsafe_code)]

use core::arch::naked_asm;
use core::sync::atomic::{AtomicBool, Ordering};

use crate::log::error;

unsafe extern "Rust" {
    /// The board's own part: no motor is driven any more. [`app!`](crate::app) defines it.
    safe fn stiction_actuators_off();
}

static STOPPED: AtomicBool = AtomicBool::new(false);

/// Zero force, and nothing more until the watchdog resets the chip.
pub fn stop() -> ! {
    cortex_m::interrupt::disable();
    stiction_actuators_off();
    // Once: the log itself may be what stopped it.
    if !STOPPED.load(Ordering::Relaxed) {
        STOPPED.store(true, Ordering::Relaxed);
        error!("stopped");
    }
    #[cfg(feature = "semihosting")]
    semihosting::process::exit(101);
    #[cfg(not(feature = "semihosting"))]
    loop {
        cortex_m::asm::nop();
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    stop()
}

/// An exception that nothing else handles.
#[unsafe(export_name = "DefaultHandler")]
extern "C" fn unexpected() -> ! {
    stop()
}

/// A fault of the processor, on a fresh stack: the old one may be the cause, and would fault again.
#[unsafe(naked)]
#[unsafe(export_name = "HardFault")]
unsafe extern "C" fn hard_fault() -> ! {
    naked_asm!(
        "ldr r0, =_stack_start",
        "msr msp, r0",
        "bl {stop}",
        ".pool",
        stop = sym fault,
    )
}

extern "C" fn fault() -> ! {
    stop()
}
