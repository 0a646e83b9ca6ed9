//! The common part of the boards with a Raspberry Pi chip, RP2040 and RP2350: their crates are almost the same, and each board names its
//! own `crate::hal`. The differences of the chips are in each board's own files: boot, clocks, the type of the timer, and the source of the
//! board's number.
//!
//! | what | where |
//! |---|---|
//! | serial line, 921600 8N1 | UART0: GP0 out, GP1 in |
//! | serial line over USB | the board's USB |
//! | ticks and clock | a timer, 1 MHz |
//! | motors | none, or those of the feature `knob` or `pantograph`; no pin but GP0 drives anything when it stops |
//!
//! The pins of a device are in `pins.rs`.

pub(crate) mod clock;
#[cfg(any(feature = "knob", feature = "pantograph"))]
mod encoder;
#[cfg(feature = "knob")]
mod knob;
#[cfg(any(feature = "knob", feature = "pantograph"))]
mod motor;
#[cfg(not(any(feature = "knob", feature = "pantograph")))]
mod no_device;
#[cfg(feature = "pantograph")]
mod pantograph;
pub(crate) mod pins;
pub(crate) mod uart;
pub(crate) mod usb;

use fugit::ExtU32;

use crate::hal::{self, fugit, pac};

#[cfg(all(feature = "knob", feature = "pantograph"))]
compile_error!("one device at most: the feature `knob` or the feature `pantograph`");

#[cfg(feature = "knob")]
#[path = "../../../../devices/knob.rs"]
mod numbers;
#[cfg(feature = "pantograph")]
#[path = "../../../../devices/pantograph.rs"]
mod numbers;

#[cfg(feature = "knob")]
pub(crate) use knob::{Device, start};
#[cfg(not(any(feature = "knob", feature = "pantograph")))]
pub(crate) use no_device::{Device, LIMITS, PASSIVITY, start};
#[cfg(any(feature = "knob", feature = "pantograph"))]
pub(crate) use numbers::{LIMITS, PASSIVITY};
#[cfg(feature = "pantograph")]
pub(crate) use pantograph::{Device, start};

/// The parts of a device.
#[cfg_attr(not(feature = "pantograph"), allow(dead_code))]
pub(crate) struct Parts<'a> {
    pub(crate) pio: pac::PIO0,
    pub(crate) pwm: pac::PWM,
    pub(crate) pins: pins::DevicePins,
    pub(crate) resets: &'a mut pac::RESETS,
    /// The watchdog has reset the board since it was switched on.
    pub(crate) was_reset: bool,
}

/// A tick that does not come for this long ends in a reset (ms).
const PATIENCE: u32 = 20;

/// Resets the chip unless it is fed.
pub(crate) struct Watchdog(hal::Watchdog);

impl Watchdog {
    /// Returns whether it has reset the board since that was switched on, or was reset by hand.
    #[allow(unsafe_code)]
    pub(crate) fn has_reset() -> bool {
        // SAFETY: a read-only register.
        let reason = unsafe { &*pac::WATCHDOG::ptr() }.reason().read();
        reason.bits() != 0
    }

    /// Starts it.
    pub(crate) fn start(mut watchdog: hal::Watchdog) -> Self {
        watchdog.start(PATIENCE.millis());
        Self(watchdog)
    }

    pub(crate) fn feed(&mut self) {
        self.0.feed();
    }
}

/// No pin except the serial line drives anything any more.
#[allow(unsafe_code)]
pub(crate) fn actuators_off() {
    // SAFETY: one field of each register, whatever a task was doing with it.
    let pins = unsafe { &*pac::IO_BANK0::ptr() };
    // GP0 belongs to the line.
    for pin in pins.gpio_iter().skip(1) {
        pin.gpio_ctrl().modify(|_, w| w.funcsel().null());
    }
}
