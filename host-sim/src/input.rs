//! The input of a command: a scene by its name, and the hand's path in it.

use std::path::Path;

use stiction_scene::{HandPath, InputError, SceneFile, Source, fitted};

use stiction_live::input::{path_file, remarks};

use stiction_live::number::Number;
use stiction_live::scenes;

/// A scene file, or the bundled scene of a name.
pub fn open_scene(name: &Path, number: Number) -> Result<SceneFile, InputError> {
    SceneFile::parse(source(name)?, number.limit())
}

/// The text of a scene file, or of the bundled scene of a name.
pub(crate) fn source(name: &Path) -> Result<Source, InputError> {
    if name.exists() {
        return Source::read(name);
    }
    let unknown = || InputError::of_file(name, scenes::unknown(name));
    scenes::find(name).ok_or_else(unknown)
}

/// Places the path of a file over a scene, instead of where its keys place it. Returns what was done: the keys that do the same.
pub(crate) fn fit(scene: &mut SceneFile, hand: &Path) -> Result<String, InputError> {
    let (placement, keys) = fitted(scene, hand)?;
    scene.hand.placement = placement;
    let file = hand.display();
    Ok(match keys.is_empty() {
        true => format!("{file}: lies over the scene as it is"),
        false => {
            let keys = keys.join("\n");
            format!("{file}: placed over the scene, as by these keys:\n[hand]\n{keys}")
        }
    })
}

/// The path of a file in a scene, and what is to be said about it.
pub(crate) fn hand_path(
    scene: &SceneFile,
    file: &Path,
    fits: bool,
) -> Result<(HandPath, Vec<String>), InputError> {
    let (mut scene, mut notes) = (scene.clone(), Vec::new());
    if fits {
        notes.push(fit(&mut scene, file)?);
    }
    let path = HandPath::read(file, &scene.hand.placement)?;
    notes.extend(remarks(&scene, Some(file), &path));
    Ok((path, notes))
}

/// Checks that a board supports a scene: errors are reported with the key and the line, which the board does not know.
pub(crate) fn suits_boards(scene: &SceneFile) -> Result<(), InputError> {
    scene.scene::<f32>().map(drop)
}

/// The input files, which no output may replace: those that are read, and the scene's path if another one replaces it.
pub(crate) fn files<'a>(
    name: &'a Path,
    scene: &'a SceneFile,
    hand: Option<&'a Path>,
) -> impl Iterator<Item = &'a Path> {
    [Some(name), hand, path_file(scene, None)]
        .into_iter()
        .flatten()
}
