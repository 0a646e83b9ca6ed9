//! From the numbers that the maker of a knob measures to what the control loop needs; which of them cannot be used, and why.

use core::fmt;

use crate::pantograph::{Encoder, GeometryError, GeometryParameter, KnobGeometry, MotorConstants};
use crate::safety::{Allowed, LimitError, Limits, Passivity};
use stiction_wire::{KnobNumber, KnobNumbers};

/// The hand of a knob does not turn, and so no moment does work on it: enough for any stiffness that a scene may have (N·m·s/rad).
const DAMPING_ROTATION: f32 = 1e3;
/// The period of the fastest tick (µs); that of a slower one counts.
const FASTEST_TICK_US: u32 = 200;
/// The longest turn (µs): of the Pico, as `host-sim/lab` measures it with the knob's scene; the Pico 2 is faster.
const TURN_US: u32 = 750;

/// What follows from the numbers of a knob.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnobSettings {
    /// The effect of a turn, and the resolution of the encoder.
    pub geometry: KnobGeometry,
    /// The motor.
    pub motor: MotorConstants,
    /// The largest force is that of the largest torque; its rate is that of [`Limits::DEFAULT`].
    pub limits: Limits,
    /// The damping along x, at the fastest tick.
    pub passivity: Passivity,
}

impl KnobSettings {
    /// For numbers that may not be usable: see [`check`].
    pub const fn new(numbers: &KnobNumbers) -> Self {
        let KnobNumbers { radius, .. } = *numbers;
        Self {
            geometry: KnobGeometry {
                origin: numbers.origin,
                radius,
                encoder: Encoder {
                    counts_per_turn: numbers.counts_per_turn,
                    reversed: numbers.encoder_reversed,
                    // The hand is at the origin at power-up.
                    offset: 0.0,
                },
            },
            motor: MotorConstants {
                torque_constant: numbers.torque_constant,
                full_current: numbers.full_current,
                torque_limit: numbers.torque_limit,
                reversed: numbers.motor_reversed,
            },
            limits: Limits {
                force: numbers.torque_limit / radius,
                moment: 0.0, // the knob's axis is that of its force
                ..Limits::DEFAULT
            },
            passivity: Passivity {
                damping_translation: numbers.damping / (radius * radius),
                damping_rotation: DAMPING_ROTATION,
                hold_us: FASTEST_TICK_US,
                delay_us: 0, // the encoder is read in the tick
                turn_us: TURN_US,
            },
        }
    }
}

/// Why a number of a knob cannot be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnobError {
    /// Which one.
    pub number: KnobNumber,
    /// Its value.
    pub value: f32,
    /// The nearest value that is allowed; that of a damping is not allowed itself. NaN if there is none.
    pub limit: f32,
    /// What is allowed, in words.
    pub allowed: &'static str,
}

impl fmt::Display for KnobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (number, value) = (self.number.name(), self.value);
        write!(f, "{number} is {value}, allowed: {}", self.allowed)?;
        if self.limit.is_nan() {
            return Ok(());
        }
        write!(f, ", the limit: {}", self.limit)
    }
}

impl core::error::Error for KnobError {}

/// Checks each number by itself.
///
/// # Errors
/// [`KnobError`] names the first number that is not finite or out of its range.
pub fn check(numbers: &KnobNumbers) -> Result<(), KnobError> {
    let settings = KnobSettings::new(numbers);
    settings.geometry.check().map_err(of_geometry)?;
    settings.motor.check().map_err(of_geometry)?;
    let force = |error: LimitError| KnobError {
        number: KnobNumber::TorqueLimit,
        value: numbers.torque_limit,
        limit: most(&error) * numbers.radius,
        allowed: "at most 1e6 N at the radius",
    };
    settings.limits.check().map_err(force)?;
    let damping = |error: LimitError| KnobError {
        number: KnobNumber::Damping,
        value: numbers.damping,
        limit: nearest(numbers.damping, 0.0, most(&error) * area(numbers)),
        allowed: "0 or more, at most 1e6 N s/m at the radius",
    };
    settings.passivity.check().map_err(damping)
}

/// Checks that a stiffness k_h (N/m) is passive with the damping, at a period of ticks (µs). For numbers that were checked.
///
/// # Errors
/// [`KnobError`] names the damping, and the limit above which it must be.
pub fn admit(numbers: &KnobNumbers, k_h: f32, period_us: u32) -> Result<(), KnobError> {
    let settings = KnobSettings::new(numbers);
    let passivity = settings.passivity.at_period(period_us);
    let damping = |_| KnobError {
        number: KnobNumber::Damping,
        value: numbers.damping,
        limit: passivity.damping_of(k_h) * area(numbers),
        allowed: "more than the limit, at which the stiffness of the scene after power-up ceases to be passive",
    };
    passivity.admit(k_h, 0.0).map_err(damping)
}

/// The square of the radius (m²).
fn area(numbers: &KnobNumbers) -> f32 {
    numbers.radius * numbers.radius
}

/// The largest value that is allowed.
const fn most(error: &LimitError) -> f32 {
    match error.allowed {
        Allowed::Within(_, most) | Allowed::PassiveBelow(most) => most,
    }
}

/// The nearest value in a range; NaN for one that is in it, or no number.
fn nearest(value: f32, least: f32, most: f32) -> f32 {
    if value < least {
        least
    } else if value > most {
        most
    } else {
        f32::NAN
    }
}

fn of_geometry(error: GeometryError) -> KnobError {
    use GeometryParameter as P;
    let (number, allowed) = match error.parameter {
        P::Radius => (KnobNumber::Radius, "0.001 to 10"),
        P::CountsPerTurn(_) => (KnobNumber::CountsPerTurn, "4 to 4194304"),
        P::TorqueConstant => (KnobNumber::TorqueConstant, "1e-6 to 1000"),
        P::FullCurrent => (KnobNumber::FullCurrent, "1e-6 to 1000"),
        P::TorqueLimit => (
            KnobNumber::TorqueLimit,
            "more than 0, at most the torque constant times the full current",
        ),
        P::Origin => (KnobNumber::Origin, "-10 to 10 each"),
        // A knob has none of them.
        P::EncoderOffset(_) | P::Base | P::Proximal(_) | P::Distal(_) | P::LeastSine => {
            (KnobNumber::Origin, "")
        }
    };
    let [least, most] = match (number, error.allowed) {
        // More than 0 is no nearest value.
        (KnobNumber::TorqueLimit, [_, most]) => [f32::NAN, most],
        (_, allowed) => allowed,
    };
    KnobError {
        number,
        value: error.value,
        limit: nearest(error.value, least, most),
        allowed,
    }
}
