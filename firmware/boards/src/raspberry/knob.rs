//! The knob at the pins of this board: an encoder in, the PWM and the direction of a motor out. Its numbers are those that the board has
//! stored, or else those that are compiled in, of `firmware/src/devices/knob.rs`.

use stiction_firmware::knob::{Counter, Knob, KnobSettings, Stored};
use stiction_firmware::pantograph::GeometryError;
use stiction_firmware::safety::Passivity;
use stiction_firmware::station::Setup;
use stiction_wire::KnobInfo;

use super::encoder::{self, Encoder};
use super::hal::gpio::bank0::Gpio17;
use super::hal::pio::{PIOExt, SM0};
use super::hal::pwm::{Pwm0, Slices};
use super::motor::{MotorAt, motor};
use super::{Wired, flash};
use crate::stop;

pub(super) use stiction_firmware::devices::knob as numbers;

pub(super) const PASSIVITY: Option<Passivity> = Some(numbers::PASSIVITY);

/// The device of this board.
pub type Device = Knob<Encoder<SM0>, MotorAt<Pwm0, Gpio17>>;

impl Counter for Encoder<SM0> {
    fn count(&mut self) -> Option<u16> {
        Self::count(self)
    }
}

/// The present numbers.
fn present(described: &Setup) -> KnobInfo {
    Stored::read(flash::pages()).info(&numbers::NUMBERS, described)
}

/// The board with its present numbers.
pub(super) fn setup(described: &'static Setup) -> &'static Setup {
    let setup = described.clone().with_knob(present(described));
    match cortex_m::singleton!(: Setup = setup) {
        Some(setup) => setup,
        None => stop(),
    }
}

/// Starts the counter, and the motor without torque.
///
/// # Errors
/// An error in the numbers.
pub(super) fn start(wired: Wired<'_>) -> Result<Device, GeometryError> {
    let (pins, resets) = (wired.pins, wired.resets);
    let KnobSettings {
        geometry,
        motor: constants,
        ..
    } = KnobSettings::new(&present(wired.described).numbers);
    let (mut pio, machine, ..) = wired.pio.split(resets);
    let program = encoder::install(&mut pio);
    let counter = Encoder::start(&program, machine, pins.encoders.left);
    let slices = Slices::new(wired.pwm, resets);
    let motor = motor(
        slices.pwm0,
        pins.duties.left,
        pins.directions.left,
        constants,
    )?;
    Knob::new(&geometry, counter, motor)
}
