//! Frames as the text of a trace, and the judge's answer to it.

use std::collections::BTreeSet;
use std::path::PathBuf;

use serde_json::{Value, json};
use stiction_judge::{Bounds, Contact, Evolution, Frame, Judge, Scene, State, Status};
use stiction_judge::{InputError, Source, Survey, Touch, Trace};
use tempfile::TempDir;

/// The formats.
pub(crate) const FORMATS: [&str; 2] = ["jsonl", "csv"];

pub(crate) fn scene(text: &str) -> Scene {
    Scene::parse(Source::new("scene.toml", text)).expect("a sound scene")
}

/// A vertex on a surface.
pub(crate) fn on(vertex: usize, surface: usize) -> Touch {
    Touch::Surface { vertex, surface }
}

/// A vertex on a side of an obstacle.
pub(crate) const fn side(vertex: usize, obstacle: usize, side: usize) -> Touch {
    Touch::Side {
        vertex,
        obstacle,
        side,
    }
}

/// A corner of an obstacle on a side of the body.
pub(crate) const fn corner(obstacle: usize, corner: usize, body_side: usize) -> Touch {
    Touch::Corner {
        obstacle,
        corner,
        body_side,
    }
}

/// A frame without contacts, at rest.
pub(crate) fn frame(t: f64, hand: [f64; 3], pose: [f64; 3]) -> Frame {
    Frame {
        t,
        hand,
        held: true,
        pose,
        depth: 0.0,
        state: State::NonContact,
        contacts: Vec::new(),
        complete: true,
        wrench: [0.0; 3],
        slips: 0,
        events: Vec::new(),
        status: Status::Ok,
        behind: None,
    }
}

/// A frame in which vertex 0, the body's origin, stands at `x` on surface 0, a floor, with this wrench of the springs.
pub(crate) fn standing(hand: [f64; 3], [x, theta]: [f64; 2], wrench: [f64; 3]) -> Frame {
    Frame {
        state: State::SingleVertex,
        contacts: vec![Contact {
            touch: on(0, 0),
            direction: None,
            point: [x, 0.0],
            normal: -wrench[1],
            friction: -wrench[0],
            sliding: None,
        }],
        wrench,
        ..frame(0.0, hand, [x, 0.0, theta])
    }
}

/// A contact as in JSON.
fn contact(scene: &Scene, c: &Contact) -> Value {
    let mut contact = match c.touch {
        Touch::Surface { vertex, surface } => {
            json!({ "vertex": vertex, "surface": scene.surfaces[surface].name })
        }
        Touch::Side {
            vertex,
            obstacle,
            side,
        } => json!({ "vertex": vertex, "obstacle": scene.obstacles[obstacle].name, "side": side }),
        Touch::Corner {
            obstacle,
            corner,
            body_side,
        } => {
            let obstacle = &scene.obstacles[obstacle].name;
            json!({ "obstacle": obstacle, "corner": corner, "body_side": body_side })
        }
    };
    contact["point"] = json!(c.point);
    contact["normal"] = json!(c.normal);
    contact["friction"] = json!(c.friction);
    if let Some(sliding) = c.sliding {
        contact["sliding"] = json!(sliding);
    }
    if let Some(direction) = c.direction {
        contact["direction"] = json!(direction);
    }
    contact
}

/// A frame as in JSON, with a key that nobody knows.
fn record(scene: &Scene, frame: &Frame) -> Value {
    let contacts = frame.contacts.iter().map(|c| contact(scene, c));
    let mut record = json!({
        "t": frame.t,
        "hand": frame.hand,
        "held": frame.held,
        "pose": frame.pose,
        "depth": frame.depth,
        "state": frame.state.name(),
        "contacts": contacts.collect::<Vec<_>>(),
        "wrench": frame.wrench,
        "slips": frame.slips,
        "events": frame.events.iter().map(|e| e.name()).collect::<Vec<_>>(),
        "status": frame.status.name(),
        "more": 1,
    });
    if let Some(behind) = frame.behind {
        record["behind"] = json!(behind);
    }
    record
}

/// The columns of a table, each with its place in JSON.
const COLUMNS: [(&str, &str); 17] = [
    ("t", "/t"),
    ("hand_x", "/hand/0"),
    ("hand_y", "/hand/1"),
    ("hand_phi", "/hand/2"),
    ("held", "/held"),
    ("pose_x", "/pose/0"),
    ("pose_y", "/pose/1"),
    ("pose_theta", "/pose/2"),
    ("depth", "/depth"),
    ("state", "/state"),
    ("wrench_x", "/wrench/0"),
    ("wrench_y", "/wrench/1"),
    ("wrench_moment", "/wrench/2"),
    ("slips", "/slips"),
    ("events", "/events"),
    ("status", "/status"),
    ("behind", "/behind"),
];
const FEATURES: [(&str, &str); 2] = [("vertex", "vertex"), ("surface", "surface")];
const OF_OBSTACLES: [(&str, &str); 4] = [
    ("obstacle", "obstacle"),
    ("side", "side"),
    ("corner", "corner"),
    ("body_side", "body_side"),
];
const NUMBERS: [(&str, &str); 4] = [
    ("x", "point/0"),
    ("y", "point/1"),
    ("normal", "normal"),
    ("friction", "friction"),
];
const DIRECTIONS: [(&str, &str); 2] = [
    ("direction_x", "direction/0"),
    ("direction_y", "direction/1"),
];

/// All columns that the frames need: those of four contacts after the others.
fn columns(scene: &Scene, frames: &[Frame]) -> Vec<(String, String)> {
    let contacts = || frames.iter().flat_map(|frame| &frame.contacts);
    let mut of_contact = FEATURES.to_vec();
    if !scene.obstacles.is_empty() {
        of_contact.extend(OF_OBSTACLES);
    }
    of_contact.extend(NUMBERS);
    if contacts().any(|contact| contact.sliding.is_some()) {
        of_contact.push(("sliding", "sliding"));
    }
    if contacts().any(|contact| contact.direction.is_some()) {
        of_contact.extend(DIRECTIONS);
    }
    let mut columns: Vec<_> = COLUMNS.map(|(n, p)| (n.to_owned(), p.to_owned())).to_vec();
    for k in 0..4 {
        let column = |(name, place): &(&str, &str)| {
            (format!("c{k}_{name}"), format!("/contacts/{k}/{place}"))
        };
        columns.extend(of_contact.iter().map(column));
    }
    columns
}

/// A value in a row.
fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Array(names) => names.iter().map(cell).collect::<Vec<_>>().join(" "),
        Value::Bool(_) | Value::Number(_) | Value::Object(_) => value.to_string(),
    }
}

/// The lines of a trace; in CSV the first one is the header.
pub(crate) fn lines(format: &str, scene: &Scene, frames: &[Frame]) -> Vec<String> {
    let records = frames.iter().map(|frame| record(scene, frame));
    if format == "jsonl" {
        return records.map(|record| record.to_string()).collect();
    }
    let (names, places): (Vec<_>, Vec<_>) = columns(scene, frames).into_iter().unzip();
    let row = |record: Value| {
        let cells = places.iter().map(|place| record.pointer(place).map(cell));
        cells
            .map(Option::unwrap_or_default)
            .collect::<Vec<_>>()
            .join(",")
    };
    std::iter::once(names.join(","))
        .chain(records.map(row))
        .collect()
}

/// A file in a temporary folder, which lives as long as the returned handle.
pub(crate) fn file(format: &str, text: &str) -> (TempDir, PathBuf) {
    let folder = TempDir::new().expect("a temporary folder");
    let file = folder.path().join(format!("trace.{format}"));
    std::fs::write(&file, text).expect("a file in it");
    (folder, file)
}

/// The judge's answer to the text of a trace.
pub(crate) fn judged(
    scene: &Scene,
    evolution: Evolution,
    format: &str,
    text: &str,
) -> Result<Survey, InputError> {
    let (_folder, file) = file(format, text);
    let mut judge = Judge::new(scene.clone(), Bounds::DOUBLE, evolution);
    let mut survey = Survey::new(1);
    for frame in Trace::open(&file, scene)? {
        let (line, frame) = frame?;
        survey.add(line, frame.t, &judge.next(frame));
    }
    Ok(survey)
}

/// The laws that frames break, equal in both formats.
pub(crate) fn broken(
    scene: &Scene,
    evolution: Evolution,
    frames: &[Frame],
) -> BTreeSet<&'static str> {
    let [json, csv] = FORMATS.map(|format| {
        let text = lines(format, scene, frames).join("\n") + "\n";
        let survey = judged(scene, evolution, format, &text).expect("a trace");
        assert_eq!(survey.frames, frames.len() as u64);
        let laws = survey.laws.iter().filter(|(_, law)| law.broken > 0);
        laws.map(|(name, _)| *name).collect::<BTreeSet<_>>()
    });
    assert_eq!(json, csv);
    json
}

/// The laws that frames one second apart break along the path.
pub(crate) fn laws(
    scene: &Scene,
    frames: impl IntoIterator<Item = Frame>,
) -> BTreeSet<&'static str> {
    broken(scene, Evolution::Path, &a_second_apart(frames))
}

/// Frames at 0, 1, 2 .. s.
pub(crate) fn a_second_apart(frames: impl IntoIterator<Item = Frame>) -> Vec<Frame> {
    let at = |(i, frame): (usize, Frame)| Frame {
        t: i as f64,
        ..frame
    };
    frames.into_iter().enumerate().map(at).collect()
}

/// A single law.
pub(crate) fn only(law: &'static str) -> BTreeSet<&'static str> {
    BTreeSet::from([law])
}
