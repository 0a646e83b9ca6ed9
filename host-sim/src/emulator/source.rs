//! A scene as the Rust code that is compiled into an image: the number type, room for exactly its vertices and surfaces,
//! and only the parts of the solver that it needs.

use stiction_core::Evolution;

use crate::number::Number;
use crate::scene_file::SceneFile;

/// The code of a scene, as in `firmware/scenes/box.rs`.
pub fn rust_source(scene: &SceneFile, number: Number, evolution: Evolution) -> String {
    let friction = (scene.surfaces.iter()).any(|s| s.friction_static > 0.0);
    let surfaces: Vec<String> = scene.surfaces.iter().map(|s| {
        format!(
            "SurfaceDescription {{ normal: {:?}, offset: {:?}, friction_static: {:?}, friction_dynamic: {:?} }}",
            s.normal, s.offset, s.friction_static, s.friction_dynamic
        )
    }).collect();
    format!(
        "use stiction_core::{{Description, Evolution, Parts, Real, Scene, SurfaceDescription}};
         type Number = {number};
         pub(crate) type CompiledScene = Scene<Number, {vertex_count}, {surface_count}, Parts<{friction}, {weight}>>;
         pub(crate) const EVOLUTION: Evolution = Evolution::{evolution:?};
         pub(crate) const SCENE: Description<'static, <Number as Real>::Si> = Description {{
             vertices: &{vertices:?},
             start: {start:?},
             weight: {newtons:?},
             holding_point: {holding_point:?},
             reach: {reach:?},
             stiffness_translation: {stiffness_translation:?},
             stiffness_rotation: {stiffness_rotation:?},
             surfaces: &[{surfaces}],
         }};",
        number = number.name(),
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
