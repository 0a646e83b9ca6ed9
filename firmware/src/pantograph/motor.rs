//! From the torque of a joint to the duty of a PWM and the level of a direction pin.

use super::geometry::{GeometryError, MotorConstants};
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use stiction_core::Real;

/// Why a motor outputs no torque.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MotorFault {
    /// The torque is not finite.
    NotFinite,
    /// The PWM could not be set.
    Pwm,
    /// The direction pin could not be set.
    Pin,
}

impl MotorFault {
    /// Its name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NotFinite => "torque-not-finite",
            Self::Pwm => "pwm",
            Self::Pin => "direction-pin",
        }
    }
}

/// A motor behind a driver with a PWM and a direction input, such as a current-controlled bridge.
#[derive(Debug)]
pub struct Motor<P, D> {
    pwm: P,
    direction: D,
    constants: MotorConstants,
    /// The level of the direction pin; unknown at first.
    level: Option<bool>,
}

impl<P: SetDutyCycle, D: OutputPin> Motor<P, D> {
    /// A motor without torque.
    ///
    /// # Errors
    /// [`GeometryError`] names the first parameter that is not finite or out of its range.
    pub fn new(pwm: P, direction: D, constants: MotorConstants) -> Result<Self, GeometryError> {
        constants.check()?;
        let mut motor = Self {
            pwm,
            direction,
            constants,
            level: None,
        };
        motor.off();
        Ok(motor)
    }

    /// The ratio of a torque (N·m) to its limit; 0 or more.
    pub fn excess(&self, torque: f32) -> f32 {
        Real::abs(torque) / self.constants.torque_limit
    }

    /// Outputs a torque at the joint (N·m), counter-clockwise positive; it is limited to the motor's limit.
    ///
    /// # Errors
    /// [`MotorFault`]; then the motor is off, as far as it responds.
    pub fn turn(&mut self, torque: f32) -> Result<(), MotorFault> {
        let turned = self.try_to_turn(torque);
        if turned.is_err() {
            self.off();
        }
        turned
    }

    fn try_to_turn(&mut self, torque: f32) -> Result<(), MotorFault> {
        if !Real::is_finite(torque) {
            return Err(MotorFault::NotFinite);
        }
        let size = Real::min(Real::abs(torque), self.constants.torque_limit);
        let part = Real::min(size / self.constants.full_torque(), 1.0);
        let full = self.pwm.max_duty_cycle();
        // Rounded to the nearest; a conversion to an integer saturates.
        let duty = ((part * f32::from(full) + 0.5) as u16).min(full);
        if duty > 0 {
            self.point((torque < 0.0) != self.constants.reversed)?;
        }
        let set = self.pwm.set_duty_cycle(duty);
        set.map_err(|_| MotorFault::Pwm)
    }

    /// Sets the direction, without torque meanwhile.
    fn point(&mut self, high: bool) -> Result<(), MotorFault> {
        if self.level == Some(high) {
            return Ok(());
        }
        self.pwm
            .set_duty_cycle_fully_off()
            .map_err(|_| MotorFault::Pwm)?;
        self.level = None;
        let set = if high {
            self.direction.set_high()
        } else {
            self.direction.set_low()
        };
        set.map_err(|_| MotorFault::Pin)?;
        self.level = Some(high);
        Ok(())
    }

    /// No torque. A PWM that refuses this is left to the watchdog.
    pub fn off(&mut self) {
        let _ = self.pwm.set_duty_cycle_fully_off();
    }
}
