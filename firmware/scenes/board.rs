// The scene of a board after power-up: a box on a floor, in a solver with friction and weight, so that whatever scene comes
// over the wire will do. A file named by the environment variable STICTION_SCENE takes its place, with the parts of the
// solver that its type names; it must define the same three names. Number type and capacities are those of the board.

use stiction_core::{Description, Evolution, Full, Scene, SurfaceDescription};

/// The parts of the solver.
pub(crate) type CompiledScene = Scene<f32, 4, 1, Full>;
/// How a frame is evolved.
pub(crate) const EVOLUTION: Evolution = Evolution::Path;
/// The scene, SI units.
pub(crate) const SCENE: Description<'static, f32> = Description {
    vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
    start: [0.0, 0.03, 0.0],
    weight: 0.0,
    holding_point: Some([0.0, 0.02]),
    reach: 0.02,
    stiffness_translation: 500.0,
    stiffness_rotation: 0.5,
    surfaces: &[SurfaceDescription {
        normal: [0.0, 1.0],
        offset: 0.0,
        friction_static: 0.5,
        friction_dynamic: 0.3,
    }],
};
