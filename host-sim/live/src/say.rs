//! Messages to a client: hello, the state, frames, answers. JSON, as specified in `host-sim/VIEW.md`.

use std::sync::Arc;

use serde::Serialize;
use serde_json::{Number as JsonNumber, json};
use stiction_insertion::Meter;
use stiction_scene::{ObstacleInfo, SurfaceInfo};

use super::free::Springs;
use crate::counts::Counts;
use crate::feed::{Latest, Shown};
use crate::meter;
use crate::pair::{Comparison, Pair, SlipMark};
use crate::record::{Frame, Names, Scenery};
use crate::scenes::Offer;
use crate::stage::Stage;
use crate::trace::Record;

/// Version of the protocol.
const VERSION: u32 = 1;
/// Largest number of ticks in a strip.
const STRIP: usize = 64;

/// Statistics of a board.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Fares {
    /// Whether it is connected.
    pub connected: bool,
    /// Answers per second.
    pub rate: f64,
    /// Time from a sample to its answer (s), median of the last ones.
    pub latency: Option<f64>,
    /// Samples overtaken by a newer one.
    pub late: u64,
    /// Samples without an answer.
    pub lost: u64,
    /// Ticks that the board made too late.
    pub missed: u64,
    /// Garbled frames, in both directions.
    pub faults: u64,
    /// Longest step of its solver (s).
    #[serde(skip)]
    pub worst_step: Option<f64>,
}

impl Fares {
    /// The statistics without a board.
    pub const NONE: Self = Self {
        connected: false,
        rate: 0.0,
        latency: None,
        late: 0,
        lost: 0,
        missed: 0,
        faults: 0,
        worst_step: None,
    };
}

/// What runs the solver.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Source<'a> {
    /// The program or the page itself.
    Core,
    /// A board.
    Board {
        /// Name that it reports.
        name: &'a str,
        /// Its number type.
        number: &'a str,
        /// Where it is connected.
        r#where: &'a str,
        /// Whether it is emulated on this computer.
        emulated: bool,
    },
}

/// Returns the first message to a client.
pub fn hello(client: u32, scenes: &[Offer], source: &Source<'_>) -> String {
    let names: Vec<_> = scenes.iter().map(|scene| &scene.name).collect();
    let stories: Vec<_> = scenes.iter().map(|scene| &scene.story).collect();
    json!({
        "type": "hello",
        "version": VERSION,
        "you": client,
        "program": concat!("stiction ", env!("CARGO_PKG_VERSION")),
        "scenes": names,
        "stories": stories,
        "source": source,
    })
    .to_string()
}

/// Returns the answer to a message; none if nobody waits for one.
pub fn answer(id: Option<i64>, result: Result<(), String>) -> Option<String> {
    match (result, id) {
        (Ok(()), id) => id.map(done),
        (Err(problem), id) => Some(error(id, &problem)),
    }
}

/// Returns the answer to a message that succeeded.
pub fn done(id: i64) -> String {
    json!({"type": "done", "id": id}).to_string()
}

/// Returns the answer to one that failed.
pub fn error(id: Option<i64>, problem: &str) -> String {
    match id {
        Some(id) => json!({"type": "error", "id": id, "message": problem}),
        None => json!({"type": "error", "message": problem}),
    }
    .to_string()
}

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
    pub recorded: Option<Recorded>,
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
pub struct Recorded {
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
    let surface = |surface: &SurfaceInfo| {
        json!({
            "name": surface.name,
            "normal": surface.normal,
            "offset": surface.offset,
            "static": surface.friction_static,
            "dynamic": surface.friction_dynamic,
            "memory": surface.memory,
        })
    };
    let obstacle = |obstacle: &ObstacleInfo| {
        json!({
            "name": obstacle.name,
            "vertices": obstacle.vertices,
            "static": obstacle.friction_static,
            "dynamic": obstacle.friction_dynamic,
            "memory": obstacle.memory,
        })
    };
    let peg = |meter: &Meter| {
        json!({
            "radius": meter.radius,
            "width": meter.width,
            "friction": meter.friction,
            "length": meter.length,
        })
    };
    let surfaces: Vec<_> = scene.surfaces.iter().map(surface).collect();
    let obstacles: Vec<_> = scene.obstacles.iter().map(obstacle).collect();
    let [x, y] = stage.home.position;
    json!({
        "title": scene.title,
        "story": of_stage.source().story(),
        "body": scene.vertices,
        "surfaces": surfaces,
        "obstacles": obstacles,
        "peg": pair.meter.as_deref().map(peg),
        "weight": scene.weight,
        "grasp": of_stage.holding_point,
        "reach": of_stage.reach,
        "start": of_stage.start,
        "home": [x, y, stage.home.angle.radians()],
    })
}

#[derive(Serialize)]
struct FrameMessage<'a> {
    r#type: &'static str,
    tick: u64,
    skipped: u64,
    frame: Record<'a>,
    holding: Option<[f64; 2]>,
    ghost: Option<[f64; 3]>,
    /// F_z by the formulas for small angles, while a peg is in its hole.
    #[serde(skip_serializing_if = "Option::is_none")]
    small_angles: Option<Formulas>,
    echo: Option<&'a JsonNumber>,
    reference: &'a Comparison,
    counts: &'a Counts,
    slips: &'a [SlipMark],
    strip: Vec<Vec<f64>>,
    step: StepTime,
    board: Option<Fares>,
    position: Option<f64>,
}

/// F_z (N) of one-point and of two-point contact.
#[derive(Serialize)]
struct Formulas {
    one_point: Option<f64>,
    two_points: Option<f64>,
}

impl Formulas {
    fn of(latest: &Latest) -> Option<Self> {
        let (meter, frame, scene) = (latest.meter.as_deref()?, &latest.frame, &latest.scene);
        let depth = meter::read(meter, frame)?.depth;
        let springs = [scene.stiffness_translation, scene.stiffness_rotation];
        let small = meter::small_angles((meter, depth), frame, springs);
        Some(Self {
            one_point: small.one_point,
            two_points: small.two_points,
        })
    }
}

#[derive(Serialize)]
struct StepTime {
    /// None from a board, which reports only the worst one.
    median: Option<f64>,
    worst: Option<f64>,
}

impl StepTime {
    fn of(latest: &Latest) -> Self {
        let [median, worst] = match (latest.step, latest.board) {
            (Some(times), _) => times.map(|time| Some(time.into())),
            (None, board) => [None, board.and_then(|board| board.worst_step)],
        };
        Self { median, worst }
    }
}

/// The newest record with the records before it, for one client.
#[derive(Debug)]
pub struct News {
    latest: Latest,
    since: Vec<Arc<Frame>>,
}

impl News {
    /// Returns the records since `next`, and advances `next` to the number of the next one to come.
    pub fn since(shown: &Shown, next: &mut u64) -> Option<Self> {
        let latest = shown.latest.clone()?;
        let (records, now) = shown.since(*next);
        *next = now;
        let count = records.len();
        let every = count.div_ceil(STRIP).max(1);
        // The last one is always included.
        let from = (count + every - 1) % every;
        let since = records.skip(from).step_by(every).cloned().collect();
        Some(Self { latest, since })
    }

    /// Returns the message for a client that lost `skipped` frames.
    pub fn message(&self, client: u32, skipped: u64) -> String {
        let latest = &self.latest;
        let scene = &latest.scene;
        let scenery = Scenery {
            names: Names::of(&scene.surfaces, &scene.obstacles),
            meter: latest.meter.as_deref().cloned(),
        };
        let springs = Springs::of(scene, &latest.frame);
        let echo = latest.echo.as_ref().filter(|(to, _)| *to == client);
        let strip = self
            .since
            .iter()
            .map(|frame| strip(frame, [scene.surfaces.len(), scene.obstacles.len()]));
        text(&FrameMessage {
            r#type: "frame",
            tick: latest.tick,
            skipped,
            frame: Record::new(&latest.frame, &scenery, latest.number.is_single()),
            holding: springs.holding,
            ghost: springs.ghost,
            small_angles: Formulas::of(latest),
            echo: echo.map(|(_, sent)| sent),
            reference: &latest.reference,
            counts: &latest.counts,
            slips: &latest.slips,
            strip: strip.collect(),
            step: StepTime::of(latest),
            board: latest.board,
            position: latest.position,
        })
    }
}

/// Returns t, and N and T of every surface and every obstacle.
fn strip(frame: &Frame, [surfaces, obstacles]: [usize; 2]) -> Vec<f64> {
    let mut row = vec![0.0; 1 + 2 * (surfaces + obstacles)];
    row[0] = frame.t;
    for contact in &frame.contacts {
        let of_obstacle = contact.obstacle().map(|k| surfaces + k);
        let Some(solid) = contact.surface().or(of_obstacle) else {
            continue;
        };
        let place = 1 + 2 * solid;
        if let Some([normal, friction]) = row.get_mut(place..place + 2) {
            *normal += contact.normal;
            *friction += contact.friction;
        }
    }
    row
}

/// Cannot fail: whatever is serialised here has only text keys.
fn text(message: &impl Serialize) -> String {
    serde_json::to_string(message).unwrap_or_default()
}
