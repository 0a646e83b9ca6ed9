//! The haptic device at a board: a five-bar pantograph. The numbers are those of an example that has never been built: replace them with
//! yours. [`pantograph`](crate::pantograph) has a drawing of the mechanism; SI units, angles counter-clockwise.
//!
//! The tests of this package report which number cannot be used.

use crate::pantograph::{Encoder, Geometry, HandleMount, MotorConstants};
use crate::safety::{Limits, Passivity};

/// Lengths, and the resolution of the encoders.
pub const GEOMETRY: Geometry = Geometry {
    origin: [0.0, -0.12],   // m, the middle of the base in the scene's world
    base: 0.05,             // m, between the base joints
    proximal: [0.10, 0.10], // m, base joints to elbows
    distal: [0.13, 0.13],   // m, elbows to the hand
    encoders: [
        Encoder {
            counts_per_turn: 20_000, // of the joint, four per line of the disc
            reversed: false,
            offset: 2.4, // rad, the left joint in the home position
        },
        Encoder {
            counts_per_turn: 20_000,
            reversed: false,
            offset: 0.741_592_65, // rad, the right joint in the home position
        },
        Encoder {
            counts_per_turn: 4_096,
            reversed: false,
            offset: 0.0, // rad, the handle in the home position
        },
    ],
    handle: HandleMount::Base,
    least_sine: 0.2, // of the angle between the distal links: below this, there is no force
};

/// The motors of the left joint, the right joint and the handle: torques are those at the joint, after the transmission.
pub const MOTORS: [MotorConstants; 3] = [ARM, ARM, HANDLE];

const ARM: MotorConstants = MotorConstants {
    torque_constant: 0.25, // N·m/A
    full_current: 3.0,     // A at full duty
    torque_limit: 0.6,     // N·m
    reversed: false,
};

const HANDLE: MotorConstants = MotorConstants {
    torque_constant: 0.06, // N·m/A
    full_current: 2.0,     // A at full duty
    torque_limit: 0.1,     // N·m
    reversed: false,
};

/// Limits of the force on the hand: 5 N, 0.1 N·m, both reached in 50 ms after a safe state, zero 20 ms after the last position that could be
/// read.
pub const LIMITS: Limits = Limits::DEFAULT;

/// The longest turn of a board with this device (µs), by the limits of ticks and turns in `firmware/budgets.toml`: 72 500 instructions of
/// 2 cycles on the F405, 277 000 cycles on the Pico. For the Pico 2 it is an estimate, by the instructions of the board that is emulated in its
/// place.
pub const TURN_F405_US: u32 = 870;
/// That of the Pico, see [`TURN_F405_US`].
pub const TURN_PICO_US: u32 = 2_220;
/// That of the Pico 2, see [`TURN_F405_US`].
pub const TURN_PICO_2_US: u32 = 970;

/// The mechanism's own damping, its minimum over the workspace: measure it. A stiffness that is not passive with it on a board with this longest
/// turn (µs) is refused, including that of the compiled-in scene: then the board does not start, and `stiction image` does not build it.
///
/// At 1 kHz stiffnesses are less than 364 N/m and 0.36 N·m/rad on the F405, 134 N/m and 0.13 N·m/rad on the Pico, whose turns take up to three
/// ticks, and 340 N/m and 0.34 N·m/rad on the Pico 2.
pub const fn passivity(turn_us: u32) -> Passivity {
    Passivity {
        damping_translation: 0.5, // N·s/m
        damping_rotation: 0.0005, // N·m·s/rad
        hold_us: 200,             // of the fastest tick; that of a slower one counts
        delay_us: 0,              // the encoders are read in the tick
        turn_us,
    }
}
