//! The scene of the tests: a box on a floor.

use stiction_core::{Description, SurfaceDescription};

pub(crate) const FLOOR: SurfaceDescription<f32> = SurfaceDescription {
    normal: [0.0, 1.0],
    offset: 0.0,
    friction_static: 0.5,
    friction_dynamic: 0.3,
    memory: None,
};

/// 0.10 m by 0.06 m.
pub(crate) const BOX: Description<'static, f32> = Description {
    vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
    start: [0.0, 0.03, 0.0],
    weight: 0.0,
    holding_point: Some([0.0, 0.02]),
    reach: 0.02,
    stiffness_translation: 500.0,
    stiffness_rotation: 0.5,
    surfaces: &[FLOOR],
};
