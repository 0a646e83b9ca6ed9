//! The knob of a board: its numbers are those of an example that has never been built. Replace them with those of your knob. SI units,
//! angles counter-clockwise.
//!
//! The tests of this package report which number cannot be used.

use crate::pantograph::{Encoder, KnobGeometry, MotorConstants};
use crate::safety::{Limits, Passivity};

/// The effect of a turn, and the resolution of the encoder.
pub const GEOMETRY: KnobGeometry = KnobGeometry {
    origin: [0.0, 0.0345], // m: the tool of `firmware/scenes/knob.toml` is pressed 5.5 mm deep
    radius: 0.015,         // m
    encoder: Encoder {
        counts_per_turn: 2_400, // of a disc with 600 lines
        reversed: false,
        offset: 0.0, // rad: at power-up the hand is at the origin
    },
};

/// The motor, without a gear.
pub const MOTOR: MotorConstants = MotorConstants {
    torque_constant: 0.04, // N·m/A
    full_current: 1.5,     // A at full duty
    torque_limit: 0.05,    // N·m
    reversed: false,
};

/// Limits of the force on the hand: 3.3 N at the radius, reached in 33 ms after a safe state, zero 20 ms after the last count that could be
/// read.
pub const LIMITS: Limits = Limits {
    force: 3.3,
    moment: 0.0, // the knob's axis is that of its force
    ..Limits::DEFAULT
};

/// The knob's own damping: measure it. A stiffness that is not passive with it is refused, including that of the compiled-in scene: then
/// the board does not start, and `stiction image` does not build it.
pub const PASSIVITY: Passivity = Passivity {
    // N·s/m: 1e-4 N·m·s/rad over the square of the radius; less than 355 N/m at 1 kHz.
    damping_translation: 1e-4 / (GEOMETRY.radius * GEOMETRY.radius),
    // N·m·s/rad. The hand does not turn, and so no moment does work on it: enough for any stiffness that a scene may have.
    damping_rotation: 1e3,
    hold_us: 200, // of the fastest tick; that of a slower one counts
    delay_us: 0,  // the encoder is read in the tick
    turn_us: 750, // of the Pico, as `host-sim/lab` measures it with the knob's scene; the Pico 2 is faster
};
