//! The hand's path in a scene: from the scene's file or from another one.

use std::path::Path;

use stiction_scene::{HandPath, InputError, Motion, SceneFile, doubts};

/// Returns the file that [`open_path`] reads, if it reads one.
pub fn path_file<'a>(scene: &'a SceneFile, hand: Option<&'a Path>) -> Option<&'a Path> {
    hand.or(match &scene.hand.motion {
        Some(Motion::Recorded(file)) => Some(file),
        Some(Motion::Keyframes(_)) | None => None,
    })
}

/// Returns what is to be said about a path that was read from a file for this scene: what was skipped or assumed, and what looks wrong. Empty
/// for keyframes.
pub fn remarks(scene: &SceneFile, hand: Option<&Path>, path: &HandPath) -> Vec<String> {
    let Some(file) = path_file(scene, hand) else {
        return Vec::new();
    };
    let notes = path.notes().iter().cloned();
    let all = notes.chain(doubts(scene, path));
    all.map(|note| format!("{}: {note}", file.display()))
        .collect()
}

/// Returns the hand's path and the rate (Hz) to resample it to: from a file, and a rate with the name of its source; otherwise
/// those of the scene.
///
/// # Errors
/// There is no path or no rate, the file cannot be read, or there would be too many frames.
pub fn open_path(
    scene: &SceneFile,
    hand: Option<&Path>,
    given: Option<(&str, f64)>,
) -> Result<(HandPath, Option<f64>), InputError> {
    let rate = given.map(|(_, rate)| rate).or(scene.hand.rate);
    let path = match (path_file(scene, hand), &scene.hand.motion) {
        (Some(file), _) => HandPath::read(file, &scene.hand.placement)?,
        (None, Some(Motion::Keyframes(path))) if rate.is_some() => path.clone(),
        (None, Some(Motion::Keyframes(_))) => {
            let problem = "[hand] has `keyframes` but no `rate`, allowed: a rate there or --rate";
            return Err(scene.source().error(problem));
        }
        (None, Some(Motion::Recorded(_)) | None) => {
            let problem =
                "[hand] has neither `keyframes` nor `path`, allowed: one of the two, or --hand";
            return Err(scene.source().error(problem));
        }
    };
    let count = path.frame_count(rate);
    if count <= HandPath::LARGEST_COUNT {
        return Ok((path, rate));
    }
    let problem = format!(
        "{:?} Hz of `{}` and a path of {:?} s give {count} frames, allowed: at most {}",
        rate.unwrap_or_default(),
        given.map_or("hand.rate", |(by, _)| by),
        path.seconds(),
        HandPath::LARGEST_COUNT
    );
    Err(match path_file(scene, hand) {
        Some(file) => HandPath::error_at_end(file, &problem),
        None if given.is_some() => scene.source().error(&problem),
        None => scene.error_at_rate(&problem),
    })
}
