//! What a board gives to the loop: samples of the hand, and something that takes forces.

use super::controller::{Controller, Tick};
use stiction_core::{Hand, Model, Real, Wrench};

/// A sample of the hand as it came to the device.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// The hand, world frame, SI units.
    pub hand: Hand<f32>,
    /// The sender's count of its samples, or the lower 16 bits of it.
    pub number: u16,
    /// When its last byte came (µs, the device's clock, wrapping).
    pub received_us: u32,
}

/// Where samples come from.
pub trait Source {
    /// The next sample, if one came since it was last asked for. Called once in every tick; must not wait.
    fn sample(&mut self, now_us: u32) -> Option<Sample>;
}

/// Where forces go.
pub trait Actuators {
    /// Why a force cannot be given.
    type Fault;

    /// Gives force (N) and moment (N·m), world frame, to the hand.
    ///
    /// # Errors
    /// Its fault; then no force is given at all.
    fn give(&mut self, wrench: &Wrench<f32>) -> Result<(), Self::Fault>;
    /// No force, at once. Also of use to a panic handler.
    fn off(&mut self);
}

/// A board without motors: the force is reported only.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoActuators;

impl Actuators for NoActuators {
    type Fault = core::convert::Infallible;

    fn give(&mut self, _: &Wrench<f32>) -> Result<(), Self::Fault> {
        Ok(())
    }
    fn off(&mut self) {}
}

/// Source and actuators that are not one thing.
impl<S: Source, A: Actuators> Source for (S, A) {
    fn sample(&mut self, now_us: u32) -> Option<Sample> {
        self.0.sample(now_us)
    }
}

impl<S: Source, A: Actuators> Actuators for (S, A) {
    type Fault = A::Fault;

    fn give(&mut self, wrench: &Wrench<f32>) -> Result<(), Self::Fault> {
        self.1.give(wrench)
    }
    fn off(&mut self) {
        self.1.off();
    }
}

/// One tick of a device: its sample through the controller, the force to its actuators. A force that they cannot give
/// is none, and the next one begins at zero.
pub fn run_tick<R, const V: usize, const S: usize, M, D>(
    controller: &mut Controller<R, V, S, M>,
    device: &mut D,
    now_us: u32,
) -> Tick
where
    R: Real<Si = f32>,
    M: Model,
    D: Source + Actuators,
{
    let sample = device.sample(now_us);
    let mut tick = controller.tick(now_us, sample.as_ref());
    if device.give(&tick.force).is_err() {
        device.off();
        controller.actuator_fault(&mut tick);
    }
    tick
}
