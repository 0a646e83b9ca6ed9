//! For the build script of a board: from a scene file to the code of the scene in the build folder.

use std::env;
use std::path::Path;

use stiction_core::{Fixed, Real};
use stiction_wire::NumberType;

use crate::code::scene_code;
use crate::model::SceneModel;
use crate::source::InputError;
use crate::written::WrittenScene;

/// The environment variable with the scene file that replaces a board's own.
const SCENE: &str = "STICTION_SCENE";

/// Writes `scene.rs` into a folder: the board's own scene, in a model with room for what arrives over the wire, or, in its smallest model,
/// the scene of the file named by the environment variable `STICTION_SCENE`. Reports the dependencies to cargo.
pub(crate) fn compile(
    own: &Path,
    room: SceneModel,
    number: NumberType,
    folder: &Path,
) -> Result<(), InputError> {
    println!("cargo::rerun-if-env-changed={SCENE}");
    let named = env::var_os(SCENE).filter(|name| !name.is_empty());
    let (file, room) = match &named {
        Some(name) => (Path::new(name), None),
        None => (own, Some(room)),
    };
    println!("cargo::rerun-if-changed={}", file.display());
    let code = code(file, number, room)?;
    let target = folder.join("scene.rs");
    std::fs::write(&target, code)
        .map_err(|error| InputError::of_file(&target, format!("cannot be written: {error}")))
}

/// The code of a scene file for a board: in its smallest model, or in one with capacity for other scenes too.
///
/// # Errors
/// The messages are those for a scene that is run on a computer.
pub fn code(
    file: &Path,
    number: NumberType,
    room: Option<SceneModel>,
) -> Result<String, InputError> {
    let scene = WrittenScene::read(file, f64::from(f32::MAX))?;
    let corners = match number {
        NumberType::F32 => check::<f32>(&scene)?,
        NumberType::Fixed => check::<Fixed>(&scene)?,
    };
    let smallest = SceneModel {
        corners,
        ..SceneModel::smallest(&scene)
    };
    let model = room.map_or(smallest, |room| room.with(smallest));
    Ok(scene_code(&scene, model, number))
}

/// Checks that the numbers make a scene. Returns the capacity for corners that its obstacles need, as far as they are within the range of the
/// number type.
fn check<R: Real<Si = f32>>(scene: &WrittenScene) -> Result<usize, InputError> {
    scene.scene::<R>()?;
    let (corners, _) = scene.described::<R, _>(|description| {
        let counts = description.obstacles.iter().map(|o| o.vertices.len());
        counts.sum()
    });
    Ok(corners)
}
