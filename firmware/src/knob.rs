//! The cheapest haptic device: a knob with one encoder and one motor. The knob's angle is the hand's position along x, and the force along
//! x is the motor's torque. The fixed height of the hand presses the tool on.
//!
//! ```text
//!   x = x0 + r q     q: angle of the knob from power-up, counter-clockwise; r: its radius
//!   tau = r Fx       the power of the torque is that of the force, tau dq = Fx dx
//! ```
//!
//! ```text
//! numbers.rs  what follows from the numbers that the maker of a knob measures
//! stored.rs   these numbers in the flash of a board
//! ```
//!
//! There is no home position: the hand is at x0 when the board starts. With a damping b of the knob about its axis (N·m·s/rad), the damping
//! along x is b / r^2: this is the value for [`Passivity`](crate::safety::Passivity).

mod numbers;
mod stored;

pub use numbers::{KnobError, KnobSettings, admit, check};
pub use stored::{PAGE, Stored, page};

use crate::device::{Actuators, Outage, Sample, Source};
use crate::pantograph::{GeometryError, Joint, KnobGeometry, Motor, MotorFault};
use core::f32::consts::TAU;
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use stiction_core::{Angle, Hand, Wrench};

/// The 16-bit counter of a quadrature encoder.
pub trait Counter {
    /// The present count; `None` if it cannot be read.
    fn count(&mut self) -> Option<u16>;
}

/// A knob. Its hand is always held.
#[derive(Debug)]
pub struct Knob<C, M> {
    geometry: KnobGeometry,
    /// `None` before the first count.
    joint: Option<Joint>,
    counter: C,
    motor: M,
    number: u16,
}

impl<C: Counter, M> Knob<C, M> {
    /// A knob that has not moved yet, without torque.
    ///
    /// # Errors
    /// [`GeometryError`] names the first parameter that is not finite or out of its range.
    pub fn new(geometry: &KnobGeometry, counter: C, motor: M) -> Result<Self, GeometryError> {
        geometry.check()?;
        Ok(Self {
            geometry: *geometry,
            joint: None,
            counter,
            motor,
            number: 0,
        })
    }

    /// The angle of the knob, unwrapped; `None` if the counter cannot be read.
    fn angle(&mut self) -> Option<Angle<f32>> {
        let count = self.counter.count()?;
        let encoder = self.geometry.encoder;
        let joint = self.joint.get_or_insert(Joint::new(encoder, count));
        joint.update(count);
        Some(joint.angle())
    }
}

impl<C: Counter, M> Source for Knob<C, M> {
    const MEASURES: bool = true;
    const HAS_NUMBERS: bool = true;

    fn sample(&mut self, now_us: u32) -> Option<Sample> {
        let angle = self.angle()?;
        let [x, y] = self.geometry.origin;
        // Turn by turn, a long path resolves its small steps as finely as f32 does at that position.
        let turned = angle.turns as f32 * TAU + angle.rest;
        self.number = self.number.wrapping_add(1);
        Some(Sample {
            hand: Hand::new(x + self.geometry.radius * turned, y, 0.0),
            number: self.number,
            received_us: now_us,
        })
    }
}

impl From<MotorFault> for Outage {
    fn from(_: MotorFault) -> Self {
        Self::Lasting
    }
}

impl<C: Counter, P: SetDutyCycle, D: OutputPin> Actuators for Knob<C, Motor<P, D>> {
    type Fault = MotorFault;

    fn give(&mut self, wrench: &Wrench<f32>) -> Result<(), MotorFault> {
        let [along, _] = wrench.force;
        self.motor.turn(self.geometry.radius * along)
    }

    fn off(&mut self) {
        self.motor.off();
    }
}
