//! The pantograph at the pins of this board: three encoders and a hold switch in, PWM and directions of three motors out.

use embedded_hal::digital::InputPin;
use stiction_firmware::pantograph::{Counters, GeometryError, Pantograph};
use stiction_firmware::safety::Passivity;

use super::Wired;
use super::encoder::{self, Encoder};
use super::hal::gpio::bank0::{Gpio17, Gpio19, Gpio21, Gpio22};
use super::hal::gpio::{FunctionSioInput, Pin, PullUp};
use super::hal::pio::{PIOExt, SM0, SM1, SM2};
use super::hal::pwm::{Pwm0, Pwm1, Pwm2, Slices};
use super::motor::{MotorAt, motor};
use crate::log::not_at_home;

pub(super) use stiction_firmware::devices::pantograph as numbers;

/// With the longest turn of this board.
pub(super) const PASSIVITY: Option<Passivity> =
    Some(numbers::passivity(if cfg!(feature = "pico2") {
        numbers::TURN_PICO_2_US
    } else {
        numbers::TURN_PICO_US
    }));

/// The device of this board.
pub type Device = Pantograph<Encoders, Motors>;
/// Left, right, handle.
pub type Motors = (
    MotorAt<Pwm0, Gpio17>,
    MotorAt<Pwm1, Gpio19>,
    MotorAt<Pwm2, Gpio21>,
);

/// Three encoders, and the hold switch.
pub struct Encoders {
    left: Encoder<SM0>,
    right: Encoder<SM1>,
    handle: Encoder<SM2>,
    hold: Pin<Gpio22, FunctionSioInput, PullUp>,
    /// Otherwise the position of the mechanism is unknown, and it never outputs force.
    at_home: bool,
}

impl Counters for Encoders {
    fn counts(&mut self) -> Option<[u16; 3]> {
        let counts = [
            self.left.count()?,
            self.right.count()?,
            self.handle.count()?,
        ];
        self.at_home.then_some(counts)
    }

    fn held(&mut self) -> bool {
        self.hold.is_low().unwrap_or(false)
    }
}

/// Starts the counters, and the motors without torque. If the watchdog has reset the board, the mechanism may be anywhere.
///
/// # Errors
/// An error in the numbers.
pub(super) fn start(wired: Wired<'_>) -> Result<Device, GeometryError> {
    let (pins, resets) = (wired.pins, wired.resets);
    if wired.was_reset {
        not_at_home();
    }
    let (mut pio, first, second, third, _) = wired.pio.split(resets);
    let program = encoder::install(&mut pio);
    let encoders = Encoders {
        left: Encoder::start(&program, first, pins.encoders.left),
        right: Encoder::start(&program, second, pins.encoders.right),
        handle: Encoder::start(&program, third, pins.encoders.handle),
        hold: pins.hold.into_pull_up_input(),
        at_home: !wired.was_reset,
    };
    let slices = Slices::new(wired.pwm, resets);
    let (duties, directions) = (pins.duties, pins.directions);
    let [left, right, handle] = numbers::MOTORS;
    let motors = (
        motor(slices.pwm0, duties.left, directions.left, left)?,
        motor(slices.pwm1, duties.right, directions.right, right)?,
        motor(slices.pwm2, duties.handle, directions.handle, handle)?,
    );
    Pantograph::new(&numbers::GEOMETRY, encoders, motors)
}
