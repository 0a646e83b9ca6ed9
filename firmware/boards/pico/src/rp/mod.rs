//! What the boards with a chip of Raspberry Pi have in common, RP2040 and RP2350: their crates are almost the same, and each board names
//! its own `crate::hal`. What the chips differ in is each board's own: how they boot, clocks, the type of the timer, whose number is the
//! board's.
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

/// What a device is made of.
#[cfg_attr(not(feature = "pantograph"), allow(dead_code))]
pub(crate) struct Parts<'a> {
    pub(crate) pio: pac::PIO0,
    pub(crate) pwm: pac::PWM,
    pub(crate) pins: pins::DevicePins,
    pub(crate) resets: &'a mut pac::RESETS,
    /// The watchdog has reset the board since it was switched on.
    pub(crate) was_reset: bool,
}

/// A tick that does not come for so long ends in a reset (ms).
const PATIENCE: u32 = 20;

/// Resets the chip unless it is fed.
pub(crate) struct Watchdog(hal::Watchdog);

impl Watchdog {
    /// It has reset the board since that was switched on, or was reset by hand.
    #[allow(unsafe_code)]
    pub(crate) fn has_reset() -> bool {
        // SAFETY: a register that can only be read.
        let reason = unsafe { &*pac::WATCHDOG::ptr() }.reason().read();
        reason.bits() != 0
    }

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
