//! What the boards with a chip of Raspberry Pi have in common, RP2040 and RP2350: their crates are almost the same, and each board names
//! its own `crate::hal`. What the chips differ in is each board's own: how they boot, clocks, the type of the timer, whose number is the
//! board's.
//!
//! | what | where |
//! |---|---|
//! | serial line, 921600 8N1 | UART0: GP0 out, GP1 in |
//! | serial line over USB | the board's USB |
//! | ticks and clock | a timer, 1 MHz |
//! | motors | none; no pin but GP0 drives anything when it stops |

pub(crate) mod clock;
pub(crate) mod uart;
pub(crate) mod usb;

use fugit::ExtU32;
use stiction_firmware::device::{FromLine, NoActuators};

use crate::hal::{self, fugit, pac};

/// No such board has a device.
pub(crate) type Device = (FromLine, NoActuators);
pub(crate) const NO_DEVICE: Device = (FromLine, NoActuators);

/// A tick that does not come for so long ends in a reset (ms).
const PATIENCE: u32 = 20;

/// Resets the chip unless it is fed.
pub(crate) struct Watchdog(hal::Watchdog);

impl Watchdog {
    /// From now on.
    pub(crate) fn start(mut watchdog: hal::Watchdog) -> Self {
        watchdog.start(PATIENCE.millis());
        Self(watchdog)
    }

    pub(crate) fn feed(&mut self) {
        self.0.feed();
    }
}

/// No pin drives anything any more, but the serial line.
#[allow(unsafe_code)]
pub(crate) fn actuators_off() {
    // SAFETY: one field of each register, whatever a task was doing with it.
    let pins = unsafe { &*pac::IO_BANK0::ptr() };
    // GP0 is the line's.
    for pin in pins.gpio_iter().skip(1) {
        pin.gpio_ctrl().modify(|_, w| w.funcsel().null());
    }
}
