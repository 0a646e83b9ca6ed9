//! A scene as the Rust code that is compiled into an image: the number type, the capacity for its vertices and surfaces,
//! and the parts of the solver.

use stiction_core::{Description, Evolution, Fixed, ObstacleDescription, SurfaceDescription};
use stiction_wire::NumberType;

use crate::model::{ObstacleRoom, SceneModel};
use crate::written::WrittenScene;

/// The type of the solver's numbers in the code of an image.
const fn path(number: NumberType) -> &'static str {
    match number {
        NumberType::F32 => "f32",
        NumberType::Fixed => "stiction_core::Fixed",
    }
}

/// The code of a scene in a model that has everything it needs, and of the evolution of a frame, as in
/// `firmware/scenes/box.rs`: `CompiledScene`, `SCENE` and `EVOLUTION`.
pub fn rust_source(
    scene: &WrittenScene,
    model: SceneModel,
    number: NumberType,
    evolution: Evolution,
) -> String {
    let scene = scene_code(scene, model, number);
    format!(
        "{scene}pub(crate) const EVOLUTION: stiction_core::Evolution = stiction_core::Evolution::{evolution:?};\n"
    )
}

/// The code of a scene alone: `CompiledScene` and `SCENE`.
pub(crate) fn scene_code(scene: &WrittenScene, model: SceneModel, number: NumberType) -> String {
    let SceneModel {
        vertices,
        surfaces,
        friction,
        weight,
        obstacles: room,
    } = model;
    let (description, _) = match number {
        NumberType::F32 => scene.described::<f32, _>(description),
        NumberType::Fixed => scene.described::<Fixed, _>(description),
    };
    let number = path(number);
    let parts = format!("stiction_core::Parts<{friction}, {weight}>");
    let ObstacleRoom { count, corners } = room;
    let model = if room.is_empty() {
        parts
    } else {
        format!("stiction_core::WithObstacles<{count}, {corners}, {parts}>")
    };
    format!(
        "pub(crate) type CompiledScene =
    stiction_core::Scene<{number}, {vertices}, {surfaces}, {model}>;
pub(crate) const SCENE: stiction_core::Description<'static, f32> = {description};
"
    )
}

fn obstacle(d: &ObstacleDescription<'_, f32>) -> String {
    format!(
        "
        stiction_core::ObstacleDescription {{
            vertices: &{:?},
            friction_static: {:?},
            friction_dynamic: {:?},
            memory: {:?},
        }},",
        d.vertices, d.friction_static, d.friction_dynamic, d.memory
    )
}

/// The description, with decimals that read back to the same bits.
fn description(d: &Description<'_, f32>) -> String {
    let surfaces: String = d.surfaces.iter().map(surface).collect();
    let obstacles: String = d.obstacles.iter().map(obstacle).collect();
    format!(
        "stiction_core::Description {{
    vertices: &{:?},
    start: {:?},
    weight: {:?},
    holding_point: {:?},
    reach: {:?},
    stiffness_translation: {:?},
    stiffness_rotation: {:?},
    surfaces: &[{surfaces}],
    obstacles: &[{obstacles}],
}}",
        d.vertices,
        d.start,
        d.weight,
        d.holding_point,
        d.reach,
        d.stiffness_translation,
        d.stiffness_rotation,
    )
}

fn surface(d: &SurfaceDescription<f32>) -> String {
    format!(
        "
        stiction_core::SurfaceDescription {{
            normal: {:?},
            offset: {:?},
            friction_static: {:?},
            friction_dynamic: {:?},
            memory: {:?},
        }},",
        d.normal, d.offset, d.friction_static, d.friction_dynamic, d.memory
    )
}
