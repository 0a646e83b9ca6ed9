//! For tests of a board's program, on this machine and emulated: a client, the solver beside it, a line that damages bytes, and a scene.

pub mod beside;
pub mod client;
pub mod noise;

use stiction_core::{Description, SurfaceDescription};
use stiction_wire::KnobNumbers;

/// Not the knob that is compiled in: twice as wide, a finer encoder the other way round, a stronger motor.
pub const OTHER_KNOB: KnobNumbers = KnobNumbers {
    origin: [0.01, 0.03],
    radius: 0.03,
    counts_per_turn: 4_096,
    encoder_reversed: true,
    torque_constant: 0.1,
    full_current: 2.0,
    torque_limit: 0.15,
    motor_reversed: true,
    damping: 9e-4,
};

/// A floor of the default friction.
pub const FLOOR: SurfaceDescription<f32> = SurfaceDescription {
    normal: [0.0, 1.0],
    offset: 0.0,
    friction_static: 0.5,
    friction_dynamic: 0.3,
    memory: None,
};

/// A box of 0.10 m by 0.06 m on the floor.
pub const BOX: Description<'static, f32> = Description {
    vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
    start: [0.0, 0.03, 0.0],
    weight: 0.0,
    holding_point: Some([0.0, 0.02]),
    reach: 0.02,
    stiffness_translation: 500.0,
    stiffness_rotation: 0.5,
    surfaces: &[FLOOR],
    obstacles: &[],
};
