//! The knob at the pins of this board: an encoder in, the PWM and the direction of a motor out. The numbers of the knob are those of an
//! example: replace them with yours. The tests of `stiction-firmware` read `knob_numbers.rs`, too, and report which number cannot be used.

use stiction_firmware::knob::{Counter, Knob};
use stiction_firmware::pantograph::GeometryError;

use super::encoder::{self, Encoder};
use super::motor::{MotorAt, motor};
use super::{Parts, numbers};
use crate::hal::gpio::bank0::Gpio17;
use crate::hal::pio::{PIOExt, SM0};
use crate::hal::pwm::{Pwm0, Slices};

/// The device of this board.
pub(crate) type Device = Knob<Encoder<SM0>, MotorAt<Pwm0, Gpio17>>;

impl Counter for Encoder<SM0> {
    fn count(&mut self) -> Option<u16> {
        Self::count(self)
    }
}

/// Starts the counter, and the motor without torque.
///
/// # Errors
/// An error in the numbers.
pub(crate) fn start(parts: Parts<'_>) -> Result<Device, GeometryError> {
    let Parts {
        pio,
        pwm,
        pins,
        resets,
        ..
    } = parts;
    let (mut pio, machine, ..) = pio.split(resets);
    let program = encoder::install(&mut pio);
    let counter = Encoder::start(&program, machine, pins.encoders.0);
    let slices = Slices::new(pwm, resets);
    let motor = motor(
        slices.pwm0,
        pins.duties.0,
        pins.directions.0,
        numbers::MOTOR,
    )?;
    Knob::new(&numbers::GEOMETRY, counter, motor)
}
