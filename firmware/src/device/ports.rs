//! The interfaces of a board to the loop: samples of the hand, and an output for forces.

use core::convert::Infallible;
use stiction_core::{Hand, Wrench};

/// A sample of the hand as it arrived at the device.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// The hand, world frame, SI units.
    pub hand: Hand<f32>,
    /// The sender's count of its samples, or the lower 16 bits of it.
    pub number: u16,
    /// When its last byte arrived (µs, the device's clock, wrapping).
    pub received_us: u32,
}

/// A source of samples.
pub trait Source {
    /// The board measures the hand itself. If it does not, samples come over its line.
    const MEASURES: bool;
    /// It is a knob, whose numbers a client may replace, if the board stores them: see [`Setup::knob`](crate::station::Setup::knob).
    const HAS_NUMBERS: bool = false;

    /// The present sample of the hand; `None` if it cannot be determined: if that lasts, it is silence. Called once in every tick; must not
    /// wait.
    fn sample(&mut self, now_us: u32) -> Option<Sample>;
}

/// For how long no force can be output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outage {
    /// In this tick; the next one may try again, from zero force.
    Passing,
    /// Until everything is reset: something is broken.
    Lasting,
}

/// An output for forces.
pub trait Actuators {
    /// Why a force cannot be output, and for how long.
    type Fault: Into<Outage>;

    /// Outputs force (N) and moment (N·m), world frame, to the hand.
    ///
    /// # Errors
    /// Its fault; then no force is output at all.
    fn give(&mut self, wrench: &Wrench<f32>) -> Result<(), Self::Fault>;
    /// No force, immediately. Also for use in a panic handler.
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

/// A board without motors: the force is only reported.
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

/// Source and actuators as separate objects.
impl<S: Source, A: Actuators> Source for (S, A) {
    const MEASURES: bool = S::MEASURES;
    const HAS_NUMBERS: bool = S::HAS_NUMBERS;

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
