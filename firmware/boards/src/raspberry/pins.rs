//! The assignment of the pins. The drawings in `firmware/wiring` show the same; a test generates and reads them.

use super::hal::gpio::bank0::{
    Gpio0, Gpio1, Gpio2, Gpio3, Gpio4, Gpio5, Gpio6, Gpio7, Gpio16, Gpio17, Gpio18, Gpio19, Gpio20,
    Gpio21, Gpio22,
};
use super::hal::gpio::{FunctionNull, FunctionUart, Pin, Pins, PullDown};
use crate::{Joints, Tracks};

/// A pin that drives nothing yet.
pub(super) type Free<I> = Pin<I, FunctionNull, PullDown>;

/// The pins of the serial line: out, in.
pub type UartPins = (
    Pin<Gpio0, FunctionUart, PullDown>,
    Pin<Gpio1, FunctionUart, PullDown>,
);

/// The tracks of an encoder, next to each other.
type Pair<A, B> = Tracks<Free<A>, Free<B>>;

/// The pins of a device. A knob uses those of the left joint.
#[cfg_attr(not(feature = "pantograph"), allow(dead_code))]
pub(super) struct DevicePins {
    pub(super) encoders: Joints<Pair<Gpio2, Gpio3>, Pair<Gpio4, Gpio5>, Pair<Gpio6, Gpio7>>,
    /// PWM of a motor: the first channels of slices 0 to 2.
    pub(super) duties: Joints<Free<Gpio16>, Free<Gpio18>, Free<Gpio20>>,
    pub(super) directions: Joints<Free<Gpio17>, Free<Gpio19>, Free<Gpio21>>,
    /// The hold switch, to ground.
    pub(super) hold: Free<Gpio22>,
}

pub(super) fn split(pins: Pins) -> (UartPins, DevicePins) {
    let line = (pins.gpio0.into_function(), pins.gpio1.into_function());
    let device = DevicePins {
        encoders: Joints {
            left: Tracks {
                a: pins.gpio2,
                b: pins.gpio3,
            },
            right: Tracks {
                a: pins.gpio4,
                b: pins.gpio5,
            },
            handle: Tracks {
                a: pins.gpio6,
                b: pins.gpio7,
            },
        },
        duties: Joints {
            left: pins.gpio16,
            right: pins.gpio18,
            handle: pins.gpio20,
        },
        directions: Joints {
            left: pins.gpio17,
            right: pins.gpio19,
            handle: pins.gpio21,
        },
        hold: pins.gpio22,
    };
    (line, device)
}
