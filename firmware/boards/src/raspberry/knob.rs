//! The knob at the pins of this board: an encoder in, the PWM and the direction of a motor out. The numbers of the knob are those of an
//! example in `firmware/src/devices/knob.rs`: replace them with yours. The tests of `stiction-firmware` report which number cannot be used.

use stiction_firmware::knob::{Counter, Knob};
use stiction_firmware::pantograph::GeometryError;
use stiction_firmware::safety::Passivity;

use super::Wired;
use super::encoder::{self, Encoder};
use super::hal::gpio::bank0::Gpio17;
use super::hal::pio::{PIOExt, SM0};
use super::hal::pwm::{Pwm0, Slices};
use super::motor::{MotorAt, motor};

pub(super) use stiction_firmware::devices::knob as numbers;

pub(super) const PASSIVITY: Option<Passivity> = Some(numbers::PASSIVITY);

/// The device of this board.
pub type Device = Knob<Encoder<SM0>, MotorAt<Pwm0, Gpio17>>;

impl Counter for Encoder<SM0> {
    fn count(&mut self) -> Option<u16> {
        Self::count(self)
    }
}

/// Starts the counter, and the motor without torque.
///
/// # Errors
/// An error in the numbers.
pub(super) fn start(wired: Wired<'_>) -> Result<Device, GeometryError> {
    let (pins, resets) = (wired.pins, wired.resets);
    let (mut pio, machine, ..) = wired.pio.split(resets);
    let program = encoder::install(&mut pio);
    let counter = Encoder::start(&program, machine, pins.encoders.left);
    let slices = Slices::new(wired.pwm, resets);
    let motor = motor(
        slices.pwm0,
        pins.duties.left,
        pins.directions.left,
        numbers::MOTOR,
    )?;
    Knob::new(&numbers::GEOMETRY, counter, motor)
}
