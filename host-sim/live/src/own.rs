//! A client's own scenes: makes a scene that can be shown from the text of a scene file or from edits to the shown scene, and
//! the text of a file for `stiction run` from a scene.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use stiction_core::Hand;
use stiction_scene::{InputError, Motion, ObstacleInfo, SceneFile, Source, SurfaceInfo};

use crate::scenes;
use crate::stage::{Stage, at_start, written};

/// Longest name of a file, in characters.
const NAME: usize = 100;
/// Decimal places of an origin (m, rad): moving a path back and forth leaves no rounding error.
const DIGITS: i32 = 12;
/// Frames a second (Hz) and length (s) of the path of a resting hand.
const RATE: f64 = 1000.0;
const REST: f64 = 1.0;

/// Returns the file name of a client's scene: never the name of a bundled one, which stays unchanged.
pub fn file_of(name: &str) -> PathBuf {
    let name = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let name = name.strip_suffix(".toml").unwrap_or(name);
    let name: String = name.chars().take(NAME).collect();
    let before = match scenes::find(Path::new(&name)) {
        Some(_) => "my-",
        None => "",
    };
    match name.trim_matches('.').trim() {
        "" => PathBuf::from("scene.toml"),
        name => PathBuf::from(format!("{before}{name}.toml")),
    }
}

/// Parses a scene from a text, for a number type whose largest number is `limit`. Does not open a file with the hand's path:
/// the text comes from anyone who can reach the program.
///
/// # Errors
/// It is not a scene: the key and the line.
pub fn parse(name: &str, text: Vec<u8>, limit: f64) -> Result<Stage, InputError> {
    let source = Source::of_bytes(&file_of(name), text)?;
    let scene = SceneFile::parse(source, limit)?;
    scene.scene::<f64>().map(drop)?;
    Stage::unopened(scene)
}

/// A client's edits to a scene: all sections of a scene file except the hand's, with every value.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Edit {
    body: EditedBody,
    grasp: Grasp,
    spring: Spring,
    surface: Vec<SurfaceInfo>,
    obstacle: Vec<ObstacleInfo>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct EditedBody {
    vertices: Vec<[f64; 2]>,
    start: [f64; 3],
    weight: f64,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Grasp {
    point: Option<[f64; 2]>,
    reach: f64,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Spring {
    translation: f64,
    rotation: f64,
}

/// Returns the scene of `base` with edits (JSON), under the client's name. The hand's path stays, and moves with the holding
/// point.
///
/// # Errors
/// The edits do not make a scene: the key and the line in the resulting text.
pub fn edited(base: &Stage, name: &str, json: &[u8], limit: f64) -> Result<Stage, String> {
    let edit: Edit = serde_json::from_slice(json).map_err(|error| error.to_string())?;
    let mut scene = SceneFile::clone(&base.scene);
    edit.put(&mut scene);
    let text = whole(&scene, &moved(&base.scene, &scene));
    // The file of an opened path is relative to the scene's file.
    let file = base.scene.source().file().with_file_name(file_of(name));
    let scene = SceneFile::parse(Source::new(file, text), limit);
    let stage = scene.and_then(|scene| {
        scene.scene::<f64>().map(drop)?;
        match base.path.is_some() {
            true => Stage::new(scene),
            false => Stage::unopened(scene),
        }
    });
    stage.map_err(|error| error.to_string())
}

impl Edit {
    fn put(self, scene: &mut SceneFile) {
        let written = &mut scene.written;
        written.vertices = self.body.vertices;
        (written.start, written.weight) = (self.body.start, self.body.weight);
        (written.holding_point, written.reach) = (self.grasp.point, self.grasp.reach);
        written.stiffness_translation = self.spring.translation;
        written.stiffness_rotation = self.spring.rotation;
        (written.surfaces, written.obstacles) = (self.surface, self.obstacle);
    }
}

fn pose(hand: &Hand<f64>) -> [f64; 3] {
    let [x, y] = hand.position;
    [x, y, hand.angle.radians()]
}

/// Returns the origin of the hand's path after the holding point has moved.
fn moved(before: &SceneFile, now: &SceneFile) -> [f64; 3] {
    let (old, new) = (pose(&at_start(before)), pose(&at_start(now)));
    let (origin, scale) = (now.hand.placement.origin, 10_f64.powi(DIGITS));
    std::array::from_fn(|i| {
        let place = origin[i] + (new[i] - old[i]);
        match new[i] == old[i] {
            true => origin[i],
            false => (place * scale).round() / scale,
        }
    })
}

/// Returns the text of the shown scene: the text of its file, unless a parameter was changed since or the file has no path of
/// the hand, without which it could not be run. `stage`: the scene as it is after a reset; `now`: with the present parameters.
pub fn text(stage: &Stage, now: &SceneFile) -> String {
    let (of_file, source) = (&stage.scene, stage.scene.source());
    let is_as_in_file = of_file.stiffness_translation == now.stiffness_translation
        && of_file.stiffness_rotation == now.stiffness_rotation
        && of_file.weight == now.weight
        && of_file.surfaces == now.surfaces
        && of_file.obstacles == now.obstacles;
    if is_as_in_file && of_file.hand.motion.is_some() {
        return source.text().to_owned();
    }
    let mut scene = now.clone();
    scene.written.begin_as(of_file);
    whole(&scene, &scene.hand.placement.origin)
}

/// Returns a scene file with its hand, whose path has this origin.
fn whole(scene: &SceneFile, origin: &[f64; 3]) -> String {
    let hand = match scene.hand.motion {
        Some(Motion::Keyframes(_) | Motion::Recorded(_)) => scene.hand_text(origin),
        None => resting(scene),
    };
    format!("{}\n{hand}", written(scene))
}

/// Returns the section of a hand at rest that exerts no force.
fn resting(scene: &SceneFile) -> String {
    let [x, y, phi] = pose(&at_start(scene));
    let rate = scene.hand.rate.unwrap_or(RATE);
    format!(
        "[hand]\nrate = {rate:?}\nkeyframes = [\n  [0.0, {x:?}, {y:?}, {phi:?}],\n  [{REST:?}, {x:?}, {y:?}, {phi:?}],\n]\n"
    )
}
