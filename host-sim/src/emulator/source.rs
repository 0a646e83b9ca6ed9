//! A scene as the Rust code that is compiled into an image: the number type, room for exactly its vertices and surfaces,
//! and only the parts of the solver that it needs.

use stiction_core::Evolution;

use super::BoardNumber;
use crate::scene_file::SceneFile;

/// The code of a scene, as in `firmware/scenes/box.rs`.
pub fn rust_source(scene: &SceneFile, number: BoardNumber, evolution: Evolution) -> String {
    let friction = (scene.surfaces.iter()).any(|s| s.friction_static > 0.0);
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
        vertex_count = scene.vertices.len(),
        surface_count = scene.surfaces.len(),
        weight = scene.weight > 0.0,
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
