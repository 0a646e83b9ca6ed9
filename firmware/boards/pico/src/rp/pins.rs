//! The assignment of the pins. The drawings in `firmware/wiring` show the same; a test generates and reads them.

use crate::hal::gpio::bank0::{
    Gpio0, Gpio1, Gpio2, Gpio3, Gpio4, Gpio5, Gpio6, Gpio7, Gpio16, Gpio17, Gpio18, Gpio19, Gpio20,
    Gpio21, Gpio22,
};
use crate::hal::gpio::{FunctionNull, FunctionUart, Pin, Pins, PullDown};

/// A pin that drives nothing yet.
pub(super) type Free<I> = Pin<I, FunctionNull, PullDown>;

/// The pins of the serial line: out, in.
pub(crate) type UartPins = (
    Pin<Gpio0, FunctionUart, PullDown>,
    Pin<Gpio1, FunctionUart, PullDown>,
);

/// Tracks A and B of an encoder, next to each other.
type Tracks<A, B> = (Free<A>, Free<B>);

/// The pins of a device: left joint, right joint, handle. A knob uses those of the left joint.
#[cfg_attr(not(feature = "pantograph"), allow(dead_code))]
pub(crate) struct DevicePins {
    pub(super) encoders: (
        Tracks<Gpio2, Gpio3>,
        Tracks<Gpio4, Gpio5>,
        Tracks<Gpio6, Gpio7>,
    ),
    /// PWM of a motor: the first channels of slices 0 to 2.
    pub(super) duties: (Free<Gpio16>, Free<Gpio18>, Free<Gpio20>),
    pub(super) directions: (Free<Gpio17>, Free<Gpio19>, Free<Gpio21>),
    /// The hold switch, to ground.
    pub(super) hold: Free<Gpio22>,
}

/// Gives every pin to its owner.
pub(crate) fn split(pins: Pins) -> (UartPins, DevicePins) {
    let line = (pins.gpio0.into_function(), pins.gpio1.into_function());
    let device = DevicePins {
        encoders: (
            (pins.gpio2, pins.gpio3),
            (pins.gpio4, pins.gpio5),
            (pins.gpio6, pins.gpio7),
        ),
        duties: (pins.gpio16, pins.gpio18, pins.gpio20),
        directions: (pins.gpio17, pins.gpio19, pins.gpio21),
        hold: pins.gpio22,
    };
    (line, device)
}
