//! What a board gives to the loop: samples of the hand, and something that takes forces.

use core::convert::Infallible;
use stiction_core::{Hand, Wrench};

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
    /// The board measures the hand itself. Where it does not, samples come over its line.
    const MEASURES: bool;

    /// The hand as it is now; none where that cannot be told: silence, when it lasts. Called once in every tick; must not
    /// wait.
    fn sample(&mut self, now_us: u32) -> Option<Sample>;
}

/// For how long a force cannot be given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outage {
    /// In this tick; the next one may try again, from zero force.
    Passing,
    /// Until everything is reset: something is broken.
    Lasting,
}

/// Where forces go.
pub trait Actuators {
    /// Why a force cannot be given, and for how long.
    type Fault: Into<Outage>;

    /// Gives force (N) and moment (N·m), world frame, to the hand.
    ///
    /// # Errors
    /// Its fault; then no force is given at all.
    fn give(&mut self, wrench: &Wrench<f32>) -> Result<(), Self::Fault>;
    /// No force, at once. Also of use to a panic handler.
    fn off(&mut self);
}

/// A board that does not measure the hand: samples come over its line.
#[derive(Clone, Copy, Debug, Default)]
pub struct FromLine;

impl Source for FromLine {
    const MEASURES: bool = false;

    fn sample(&mut self, _: u32) -> Option<Sample> {
        None
    }
}

/// A board without motors: the force is reported only.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoActuators;

impl From<Infallible> for Outage {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}

impl Actuators for NoActuators {
    type Fault = Infallible;

    fn give(&mut self, _: &Wrench<f32>) -> Result<(), Self::Fault> {
        Ok(())
    }
    fn off(&mut self) {}
}

/// Source and actuators that are not one thing.
impl<S: Source, A: Actuators> Source for (S, A) {
    const MEASURES: bool = S::MEASURES;

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
