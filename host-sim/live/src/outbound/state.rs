//! The message of the state: the scene, its parameters, the setting, and who holds the hand.

use serde::Serialize;
use serde_json::json;
use stiction_judge::insertion::Meter;

use super::text;
use crate::pair::Pair;
use crate::stage::Stage;

/// The part of the state other than scene and setting.
#[derive(Clone, Debug, Serialize)]
pub struct Status {
    /// Whether time stands still.
    pub paused: bool,
    /// Speed of the solver's time: 1 is real time.
    pub speed: f64,
    /// Seconds recorded so far.
    pub recording: Option<f64>,
    /// The file of that recording.
    pub recording_file: Option<String>,
    /// The recording that can be downloaded.
    pub recorded: Option<Downloadable>,
    /// The path that the hand follows.
    pub replay: Option<Replayed>,
    /// The holder of the hand.
    pub hand: By,
    /// Number of clients.
    pub clients: usize,
    /// The names of the scenes that can be shown.
    pub scenes: Vec<String>,
    /// Why the scene's file, in its present form, cannot be shown.
    pub scene_problem: Option<String>,
}

/// A finished recording.
#[derive(Clone, Debug, Serialize)]
pub struct Downloadable {
    /// Duration from the first tick to the last (s).
    pub seconds: f64,
    /// Number of records.
    pub frames: usize,
    /// Path of the file on the computer of this program.
    pub file: String,
    /// Whether it was made before this program was started.
    pub earlier: bool,
    /// Why its file is incomplete.
    pub problem: Option<String>,
}

/// A path that is being followed.
#[derive(Clone, Debug, Serialize)]
pub struct Replayed {
    /// Name of the path.
    pub what: String,
    /// Duration from the first tick to the last (s).
    pub seconds: f64,
    /// Whether it repeats until somebody takes the hand.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub demonstration: bool,
}

/// The holder of the hand.
#[derive(Clone, Debug, Serialize)]
pub struct By {
    /// Kind of the holder.
    pub by: Option<&'static str>,
    /// Number of the client, if it is one.
    pub client: Option<u32>,
}

#[derive(Serialize)]
struct State<'a> {
    r#type: &'static str,
    scene: serde_json::Value,
    parameters: serde_json::Value,
    number: &'static str,
    evolution: &'static str,
    #[serde(flatten)]
    status: &'a Status,
}

/// Returns the state as a message.
pub fn state(stage: &Stage, pair: &Pair, status: &Status) -> String {
    let setting = &pair.setting;
    let scene = &setting.scene;
    let of_surface = scene.surfaces.first().map(|surface| {
        let friction = [surface.friction_static, surface.friction_dynamic];
        (friction, surface.memory)
    });
    let of_obstacle = scene.obstacles.first().map(|obstacle| {
        let friction = [obstacle.friction_static, obstacle.friction_dynamic];
        (friction, obstacle.memory)
    });
    let first = of_surface.or(of_obstacle);
    let message = State {
        r#type: "state",
        scene: described(stage, pair),
        parameters: json!({
            "stiffness_translation": scene.stiffness_translation,
            "stiffness_rotation": scene.stiffness_rotation,
            "static": first.map(|(friction, _)| friction[0]),
            "dynamic": first.map(|(friction, _)| friction[1]),
            "memory": first.and_then(|(_, memory)| memory),
            "weight": scene.weight,
        }),
        number: setting.number.name(),
        evolution: setting.evolution.name(),
        status,
    };
    text(&message)
}

fn described(stage: &Stage, pair: &Pair) -> serde_json::Value {
    // A recording may have begun elsewhere: start, holding point and reach are those after a reset.
    let (scene, of_stage) = (&pair.setting.scene, &stage.scene);
    let peg = |meter: &Meter| {
        json!({
            "radius": meter.radius,
            "width": meter.width,
            "friction": meter.friction,
            "length": meter.length,
        })
    };
    let [x, y] = stage.home.position;
    json!({
        "title": scene.title,
        "story": of_stage.source().story(),
        "body": scene.vertices,
        "surfaces": scene.surfaces,
        "obstacles": scene.obstacles,
        "peg": pair.meter.as_deref().map(peg),
        "weight": scene.weight,
        "grasp": of_stage.holding_point,
        "reach": of_stage.reach,
        "start": of_stage.start,
        "home": [x, y, stage.home.angle.radians()],
    })
}
