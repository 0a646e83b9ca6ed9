//! A scene that is shown: its file, the hand's path in it, and the initial hand.

use std::sync::Arc;

use stiction_core::{Angle, Hand};
use stiction_scene::{HandPath, InputError, Motion, Sample, SceneFile, Source};

use crate::body::Setting;
use crate::input::open_path;

/// Smallest reach for grasping a point or a rod (m): the tremor of a hand.
const LEAST_REACH: f64 = 1e-4;

/// A scene with its hand.
#[derive(Clone, Debug)]
pub struct Stage {
    /// The scene.
    pub scene: Arc<SceneFile>,
    /// The path of its hand, if it has one.
    pub path: Option<Arc<HandPath>>,
    /// The initial hand.
    pub home: Hand<f64>,
}

impl Stage {
    /// Creates a stage from a scene file.
    ///
    /// # Errors
    /// Its path cannot be read.
    pub fn new(scene: SceneFile) -> Result<Self, InputError> {
        let opens = scene.hand.motion.is_some();
        Self::with_path(scene, opens)
    }

    /// Creates a stage from a scene file, without opening the hand's path if it is a file of its own.
    ///
    /// # Errors
    /// Its path is too long.
    pub fn unopened(scene: SceneFile) -> Result<Self, InputError> {
        let opens = matches!(scene.hand.motion, Some(Motion::Keyframes(_)));
        Self::with_path(scene, opens)
    }

    fn with_path(mut scene: SceneFile, opens: bool) -> Result<Self, InputError> {
        let reach = graspable(&scene);
        scene.written.reach = reach;
        let path = match opens {
            true => Some(Arc::new(open_path(&scene, None, Some(("view", 1000.0)))?.0)),
            false => None,
        };
        let first = path.as_ref().and_then(|path| path.frames(None).next());
        let home = first.map_or_else(|| at_start(&scene), |sample: Sample| sample.hand);
        Ok(Self {
            scene: Arc::new(scene),
            path,
            home,
        })
    }
}

/// Returns a reach with which the body can be grasped again after a release: a point and a rod have no inside where a hand
/// could be.
fn graspable(scene: &SceneFile) -> f64 {
    match scene.vertices.len() {
        ..3 => scene.reach.max(LEAST_REACH),
        _ => scene.reach,
    }
}

/// Returns a hand that exerts no force, at the holding point or at the body's origin.
pub(crate) fn at_start(scene: &SceneFile) -> Hand<f64> {
    let [x, y, theta] = scene.start;
    let [gx, gy] = scene.holding_point.unwrap_or_default();
    let (sin, cos) = theta.sin_cos();
    Hand {
        position: [x + cos * gx - sin * gy, y + sin * gx + cos * gy],
        // The spring of a given holding point is relaxed if hand and body have the same angle.
        angle: Angle::from_radians(theta),
        depth: 0.0,
        held: true,
        tilted: false,
    }
}

/// Returns a scene as a file without its hand, with enough digits to read back the same values.
pub fn written(scene: &SceneFile) -> String {
    let pair = |[x, y]: [f64; 2]| format!("[{x:?}, {y:?}]");
    let pairs = |points: &[[f64; 2]]| {
        points
            .iter()
            .map(|&point| pair(point))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let [x, y, theta] = scene.start;
    let mut text = format!(
        "[body]\nvertices = [{}]\nstart = [{x:?}, {y:?}, {theta:?}]\nweight = {:?}\n\n[grasp]\n",
        pairs(&scene.vertices),
        scene.weight
    );
    if let Some(point) = scene.holding_point {
        text += &format!("point = {}\n", pair(point));
    }
    text += &format!(
        "reach = {:?}\n\n[spring]\ntranslation = {:?}\nrotation = {:?}\n",
        scene.reach, scene.stiffness_translation, scene.stiffness_rotation
    );
    let friction = |of_static: f64, of_dynamic: f64, memory: Option<f64>| {
        let memory = memory.map_or_else(String::new, |memory| format!("memory = {memory:?}\n"));
        format!("static = {of_static:?}\ndynamic = {of_dynamic:?}\n{memory}")
    };
    for surface in &scene.surfaces {
        text += &format!(
            "\n[[surface]]\nname = {}\nnormal = {}\noffset = {:?}\n{}",
            quoted(&surface.name),
            pair(surface.normal),
            surface.offset,
            friction(
                surface.friction_static,
                surface.friction_dynamic,
                surface.memory
            )
        );
    }
    for obstacle in &scene.obstacles {
        text += &format!(
            "\n[[obstacle]]\nname = {}\nvertices = [{}]\n{}",
            quoted(&obstacle.name),
            pairs(&obstacle.vertices),
            friction(
                obstacle.friction_static,
                obstacle.friction_dynamic,
                obstacle.memory
            )
        );
    }
    text
}

/// Returns a TOML string, which has the same syntax as JSON except for one character.
fn quoted(text: &str) -> String {
    let json = serde_json::to_string(text).unwrap_or_else(|_| "\"\"".to_owned());
    json.replace('\u{7f}', "\\u007f")
}

/// Returns a setting whose scene is written and read again: its results are those for a reader of the file, to the last bit.
///
/// # Errors
/// The parameters are not those of a scene.
pub fn reread(setting: &Setting) -> Result<Setting, String> {
    let scene = &setting.scene;
    let source = Source::new(format!("{}.toml", scene.title), written(scene));
    let read = SceneFile::parse(source, setting.number.limit());
    let read = read.map_err(|error| error.to_string())?;
    Ok(Setting {
        scene: Arc::new(SceneFile {
            // The placement of paths stays unchanged.
            hand: scene.hand.clone(),
            ..read
        }),
        ..setting.clone()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Number;
    use stiction_core::Evolution;

    #[test]
    fn a_written_scene_keeps_its_surfaces_and_obstacles() {
        let text = "[body]\nvertices = [[0.0, 0.0]]\nstart = [0.0, 1.0, 0.0]\n[spring]\ntranslation = 1.0\nrotation = 0.0\n\
                    [friction]\nstatic = 0.5\ndynamic = 0.3\n[[surface]]\nname = \"a\"\nnormal = [0.0, 1.0]\noffset = 0.0\n\
                    memory = 3e-5\n[[surface]]\nname = \"b\"\nnormal = [1.0, 0.0]\noffset = -1.0\n\
                    [[obstacle]]\nname = \"pin\"\nvertices = [[0.5, 0.5]]\nmemory = 1e-4\n\
                    [[obstacle]]\nname = \"wall\"\nvertices = [[0.1, 0.3], [0.2, 0.7]]\nstatic = 0.7\n";
        let scene = SceneFile::parse(Source::new("point.toml", text), 1e9).expect("a scene");
        let setting = Setting {
            scene: Arc::new(scene.clone()),
            number: Number::F64,
            evolution: Evolution::Path,
        };
        let again = reread(&setting).expect("the same scene").scene;
        let lengths: Vec<_> = again
            .surfaces
            .iter()
            .map(|surface| surface.memory)
            .collect();
        assert_eq!(lengths, [Some(3e-5), None]);
        assert_eq!(again.surfaces, scene.surfaces);
        assert_eq!(scene.obstacles.len(), 2);
        assert_eq!(again.obstacles, scene.obstacles);
    }
}
