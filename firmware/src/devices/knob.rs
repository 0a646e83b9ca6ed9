//! The knob of a board: the numbers that are compiled in are those of an example that has never been built. `stiction knob` replaces them
//! with yours, which the board stores.
//!
//! The tests of this package report which number cannot be used.

use crate::knob::KnobSettings;
use crate::pantograph::{KnobGeometry, MotorConstants};
use crate::safety::{Limits, Passivity};
use stiction_wire::KnobNumbers;

/// What a maker measures or reads off data sheets: `firmware/knob.toml` has the same numbers. A stiffness that is not passive with the damping
/// is refused, including that of the compiled-in scene: then the board does not start, and `stiction image` does not build it.
pub const NUMBERS: KnobNumbers = KnobNumbers {
    origin: [0.0, 0.0345], // m: the tool of `firmware/scenes/knob.toml` is pressed 5.5 mm deep
    radius: 0.015,         // m
    counts_per_turn: 2_400, // of a disc with 600 lines
    encoder_reversed: false,
    torque_constant: 0.04, // N·m/A, without a gear
    full_current: 1.5,     // A at full duty
    torque_limit: 0.05,    // N·m
    motor_reversed: false,
    damping: 1e-4, // N·m·s/rad about its axis; less than 355 N/m is passive with it at 1 kHz
};

const SETTINGS: KnobSettings = KnobSettings::new(&NUMBERS);

/// The effect of a turn, and the resolution of the encoder.
pub const GEOMETRY: KnobGeometry = SETTINGS.geometry;

/// The motor.
pub const MOTOR: MotorConstants = SETTINGS.motor;

/// Limits of the force on the hand: 3.3 N at the radius, reached in 33 ms after a safe state, zero 20 ms after the last count that could be
/// read.
pub const LIMITS: Limits = SETTINGS.limits;

/// The knob's own damping.
pub const PASSIVITY: Passivity = SETTINGS.passivity;
