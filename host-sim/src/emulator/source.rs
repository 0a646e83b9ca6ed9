//! A scene as the Rust code that is compiled into an image: the number type, room for its vertices and surfaces, and the
//! parts of the solver.

use stiction_core::Evolution;

use super::BoardNumber;
use crate::model::SceneModel;
use crate::scene_file::SceneFile;

/// The code of a scene in its smallest model, as in `firmware/scenes/box.rs`.
pub fn rust_source(scene: &SceneFile, number: BoardNumber, evolution: Evolution) -> String {
    rust_source_in(SceneModel::smallest(scene), scene, number, evolution)
}

/// The code of a scene in a model that has all that it needs.
pub fn rust_source_in(
    model: SceneModel,
    scene: &SceneFile,
    number: BoardNumber,
    evolution: Evolution,
) -> String {
    let SceneModel {
        vertices: vertex_count,
        surfaces: surface_count,
        friction,
        weight,
    } = model;
    let surfaces: Vec<String> = scene.surfaces.iter().map(|s| {
        format!(
            "SurfaceDescription {{ normal: {:?}, offset: {:?}, friction_static: {:?}, friction_dynamic: {:?} }}",
            s.normal, s.offset, s.friction_static, s.friction_dynamic
        )
    }).collect();
    format!(
        "use stiction_core::{{Description, Evolution, Parts, Scene, SurfaceDescription}};
         pub(crate) type CompiledScene = Scene<{number}, {vertex_count}, {surface_count}, Parts<{friction}, {weight}>>;
         pub(crate) const EVOLUTION: Evolution = Evolution::{evolution:?};
         pub(crate) const SCENE: Description<'static, f32> = Description {{
             vertices: &{vertices:?},
             start: {start:?},
             weight: {newtons:?},
             holding_point: {holding_point:?},
             reach: {reach:?},
             stiffness_translation: {stiffness_translation:?},
             stiffness_rotation: {stiffness_rotation:?},
             surfaces: &[{surfaces}],
         }};",
        number = match number {
            BoardNumber::F32 => "f32",
            BoardNumber::Fixed => "stiction_core::Fixed",
        },
        vertices = scene.vertices,
        start = scene.start,
        newtons = scene.weight,
        holding_point = scene.holding_point,
        reach = scene.reach,
        stiffness_translation = scene.stiffness_translation,
        stiffness_rotation = scene.stiffness_rotation,
        surfaces = surfaces.join(", "),
    )
}
