//! A planar haptic device: a five-bar pantograph whose handle turns; three encoders in, three motors out.
//!
//! ```text
//!                P  handle at the hand, angle phi
//!          r1  /   \  r2
//!             /     \              x, y: the scene's world
//!        B1  *       *  B2         q1, q2: joint angles from +x, counter-clockwise
//!        l1   \     /  l2          P lies to the left of the line from B1 to B2
//!          A1  *-+-*  A2
//!             origin
//!             base
//! ```
//!
//! ```text
//! geometry.rs    lengths, encoders, mounting; checked once, the error names the parameter
//! encoder.rs     16-bit counts -> joint angles, unwrapped
//! kinematics.rs  joint angles -> hand pose and Jacobian; force and moment -> joint torques
//! motor.rs       torque -> PWM duty and direction
//! ```
//!
//! [`Pantograph`] combines them: a [`Source`] of hand samples and the [`Actuators`] of one device.

mod encoder;
mod geometry;
mod kinematics;
mod motor;

pub(crate) use encoder::Joint;
pub use encoder::Joints;
pub use geometry::{
    Encoder, Geometry, GeometryError, GeometryParameter, HandleMount, KnobGeometry, MotorConstants,
};
pub use kinematics::{Configuration, Fault, Kinematics};
pub use motor::{Motor, MotorFault};

use crate::device::{Actuators, Outage, Sample, Source};
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use stiction_core::{Hand, Wrench};

/// The three 16-bit counters of the quadrature encoders and the hold switch.
pub trait Counters {
    /// The present counts: left joint, right joint, handle; `None` if they cannot be read.
    fn counts(&mut self) -> Option<[u16; 3]>;
    /// Returns whether the hold switch is on.
    fn held(&mut self) -> bool;
}

/// Why the device outputs no force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NoForce {
    /// The mechanism is at a position where it cannot output one.
    Mechanism(Fault),
    /// A motor.
    Motor(MotorFault),
}

impl From<NoForce> for Outage {
    /// The mechanism may be moved to where it outputs force again.
    fn from(fault: NoForce) -> Self {
        match fault {
            NoForce::Mechanism(_) => Self::Passing,
            NoForce::Motor(_) => Self::Lasting,
        }
    }
}

/// A pantograph: its kinematics, encoders and motors.
#[derive(Debug)]
pub struct Pantograph<C, M> {
    kinematics: Kinematics,
    /// `None` if the home position is not known.
    joints: Option<Joints>,
    counters: C,
    motors: M,
    configuration: Result<Configuration, Fault>,
    number: u16,
}

/// Three motors that take joint torques (N·m): left, right, handle.
pub trait Motors {
    /// Outputs torques; if one exceeds a motor's limit, all of them are reduced in proportion.
    ///
    /// # Errors
    /// [`MotorFault`]; then all of them are off.
    fn turn(&mut self, torques: [f32; 3]) -> Result<(), MotorFault>;
    /// No torque, immediately.
    fn off(&mut self);
}

impl<C: Counters, M: Motors> Pantograph<C, M> {
    /// A device in its home position: that in which every joint is at its encoder's offset. If the counts cannot be
    /// read there it never knows its position, and outputs neither samples nor force.
    ///
    /// # Errors
    /// [`GeometryError`] names the first parameter that is not finite or out of its range.
    pub fn new(geometry: &Geometry, mut counters: C, motors: M) -> Result<Self, GeometryError> {
        let kinematics = Kinematics::new(geometry)?;
        let home = counters.counts();
        let joints = home.map(|counts| Joints::new(geometry, counts));
        Ok(Self {
            kinematics,
            joints,
            counters,
            motors,
            configuration: Err(Fault::NotRead),
            number: 0,
        })
    }

    /// The last configuration that was read, or its fault.
    pub fn configuration(&self) -> Result<&Configuration, Fault> {
        self.configuration.as_ref().map_err(|&fault| fault)
    }

    /// The configuration according to the present counts.
    fn measure(&mut self) -> Result<Configuration, Fault> {
        let joints = self.joints.as_mut().ok_or(Fault::NotRead)?;
        joints.update(self.counters.counts().ok_or(Fault::NotRead)?);
        self.kinematics.solve(&joints.angles())
    }
}

impl<C: Counters, M: Motors> Source for Pantograph<C, M> {
    const MEASURES: bool = true;

    fn sample(&mut self, now_us: u32) -> Option<Sample> {
        self.configuration = self.measure();
        let held = self.counters.held();
        let configuration = self.configuration.as_ref().ok()?;
        self.number = self.number.wrapping_add(1);
        Some(Sample {
            hand: Hand {
                position: configuration.position,
                angle: configuration.handle,
                depth: 0.0,
                held,
                tilted: false,
            },
            number: self.number,
            received_us: now_us,
        })
    }
}

impl<C: Counters, M: Motors> Actuators for Pantograph<C, M> {
    type Fault = NoForce;

    fn give(&mut self, wrench: &Wrench<f32>) -> Result<(), NoForce> {
        let torques = match &self.configuration {
            Ok(configuration) => configuration.torques(wrench),
            Err(fault) => Err(*fault),
        };
        match torques {
            Ok(torques) => self.motors.turn(torques).map_err(NoForce::Motor),
            Err(fault) => {
                self.motors.off();
                Err(NoForce::Mechanism(fault))
            }
        }
    }
    fn off(&mut self) {
        self.motors.off();
    }
}

/// No motors: for a device that only measures.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoMotors;

impl Motors for NoMotors {
    fn turn(&mut self, _: [f32; 3]) -> Result<(), MotorFault> {
        Ok(())
    }
    fn off(&mut self) {}
}

impl<P, Q, H, D, E, G> Motors for (Motor<P, D>, Motor<Q, E>, Motor<H, G>)
where
    P: SetDutyCycle,
    Q: SetDutyCycle,
    H: SetDutyCycle,
    D: OutputPin,
    E: OutputPin,
    G: OutputPin,
{
    fn turn(&mut self, torques: [f32; 3]) -> Result<(), MotorFault> {
        let [left, right, handle] = torques;
        let excess = [
            self.0.excess(left),
            self.1.excess(right),
            self.2.excess(handle),
        ];
        let most = excess.into_iter().fold(1.0, f32::max);
        let turned = self
            .0
            .turn(left / most)
            .and_then(|()| self.1.turn(right / most))
            .and_then(|()| self.2.turn(handle / most));
        if turned.is_err() {
            Motors::off(self);
        }
        turned
    }
    fn off(&mut self) {
        self.0.off();
        self.1.off();
        self.2.off();
    }
}
