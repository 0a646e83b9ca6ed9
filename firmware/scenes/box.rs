// The scene in the images `footprint` and `count_scene`: a box on a floor. `lab footprint` replaces it with others, each with
// several capacities: files that define these three names, given by the environment variable STICTION_SCENE_CODE.

use stiction_core::{Description, Evolution, Scene, SurfaceDescription};

/// The number type and the capacities for vertices, surfaces and corners that the scene needs.
pub(crate) type CompiledScene = Scene<f32, 4, 1, 0>;
/// How a frame is evolved.
pub(crate) const EVOLUTION: Evolution = Evolution::Path;
/// The scene, SI units.
pub(crate) const SCENE: Description<'static, f32> = Description {
    vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
    start: [0.0, 0.03, 0.0],
    weight: 0.0,
    holding_point: Some([0.0, 0.02]),
    reach: 0.0,
    stiffness_translation: 500.0,
    stiffness_rotation: 0.5,
    surfaces: &[SurfaceDescription {
        normal: [0.0, 1.0],
        offset: 0.0,
        friction_static: 0.5,
        friction_dynamic: 0.3,
        memory: None,
    }],
    obstacles: &[],
};
