//! Frames as the text of a trace, and the judge's answer to it.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::PathBuf;

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

/// A number in JSON: one that is not finite is null.
fn digits(x: f64) -> String {
    if x.is_finite() {
        format!("{x:?}")
    } else {
        "null".to_owned()
    }
}

fn list(numbers: &[f64]) -> String {
    let numbers: Vec<_> = numbers.iter().map(|&x| digits(x)).collect();
    format!("[{}]", numbers.join(","))
}

/// The touching features, by JSON key and in the order of the CSV columns.
fn reported(scene: &Scene, touch: Touch) -> [(&'static str, Option<String>); 6] {
    let index = |index: usize| Some(index.to_string());
    let (mut vertex, mut surface, mut obstacle) = (None, None, None);
    let (mut side, mut corner, mut body_side) = (None, None, None);
    match touch {
        Touch::Surface {
            vertex: v,
            surface: s,
        } => {
            vertex = index(v);
            surface = Some(scene.surfaces[s].name.clone());
        }
        Touch::Side {
            vertex: v,
            obstacle: o,
            side: e,
        } => {
            vertex = index(v);
            obstacle = Some(scene.obstacles[o].name.clone());
            side = index(e);
        }
        Touch::Corner {
            obstacle: o,
            corner: k,
            body_side: j,
        } => {
            obstacle = Some(scene.obstacles[o].name.clone());
            (corner, body_side) = (index(k), index(j));
        }
    }
    [
        ("vertex", vertex),
        ("surface", surface),
        ("obstacle", obstacle),
        ("side", side),
        ("corner", corner),
        ("body_side", body_side),
    ]
}

fn object(scene: &Scene, frame: &Frame) -> String {
    let contact = |c: &Contact| {
        let is_name = |key: &str| matches!(key, "surface" | "obstacle");
        let keys: Vec<_> = (reported(scene, c.touch).into_iter())
            .filter_map(|(key, value)| value.map(|value| (key, value)))
            .map(|(key, value)| match is_name(key) {
                true => format!(r#""{key}":{value:?}"#),
                false => format!(r#""{key}":{value}"#),
            })
            .collect();
        let sliding = c.sliding.map(|sign| format!(r#","sliding":{sign}"#));
        let direction = c.direction.map(|n| format!(r#","direction":{}"#, list(&n)));
        format!(
            r#"{{{},"point":{},"normal":{},"friction":{}{}{}}}"#,
            keys.join(","),
            list(&c.point),
            digits(c.normal),
            digits(c.friction),
            sliding.unwrap_or_default(),
            direction.unwrap_or_default()
        )
    };
    let contacts: Vec<_> = frame.contacts.iter().map(contact).collect();
    let behind = (frame.behind).map(|part| format!(r#","behind":{}"#, digits(part)));
    let events: Vec<_> = frame
        .events
        .iter()
        .map(|&e| format!("{:?}", e.name()))
        .collect();
    format!(
        r#"{{"t":{},"hand":{},"held":{},"pose":{},"depth":{},"state":{:?},"contacts":[{}],"wrench":{},"slips":{},"events":[{}],"status":{:?}{},"more":1}}"#,
        digits(frame.t),
        list(&frame.hand),
        frame.held,
        list(&frame.pose),
        digits(frame.depth),
        frame.state.name(),
        contacts.join(","),
        list(&frame.wrench),
        frame.slips,
        events.join(","),
        frame.status.name(),
        behind.unwrap_or_default()
    )
}

fn row(scene: &Scene, frame: &Frame, columns: &[&str]) -> String {
    let numbers = |list: &[f64]| {
        list.iter()
            .map(|x| format!("{x:?}"))
            .collect::<Vec<_>>()
            .join(",")
    };
    let events: Vec<_> = frame.events.iter().map(|e| e.name()).collect();
    let mut row = format!(
        "{:?},{},{},{},{:?},{},{},{},{},{}",
        frame.t,
        numbers(&frame.hand),
        frame.held,
        numbers(&frame.pose),
        frame.depth,
        frame.state.name(),
        numbers(&frame.wrench),
        frame.slips,
        events.join(" "),
        frame.status.name()
    );
    let behind = frame.behind.map(digits).unwrap_or_default();
    write!(row, ",{behind}").expect("a string");
    for k in 0..4 {
        for &column in columns {
            let field = |c: &Contact| field(scene, c, column);
            let field = frame.contacts.get(k).map(field).unwrap_or_default();
            write!(row, ",{field}").expect("a string");
        }
    }
    row
}

fn field(scene: &Scene, c: &Contact, column: &str) -> String {
    match column {
        "x" => format!("{:?}", c.point[0]),
        "y" => format!("{:?}", c.point[1]),
        "normal" => format!("{:?}", c.normal),
        "friction" => format!("{:?}", c.friction),
        "sliding" => c.sliding.map(|sign| sign.to_string()).unwrap_or_default(),
        "direction_x" => c
            .direction
            .map(|n| format!("{:?}", n[0]))
            .unwrap_or_default(),
        "direction_y" => c
            .direction
            .map(|n| format!("{:?}", n[1]))
            .unwrap_or_default(),
        _ => {
            let reported = reported(scene, c.touch)
                .into_iter()
                .find(|(key, _)| *key == column);
            reported.and_then(|(_, value)| value).unwrap_or_default()
        }
    }
}

fn header(columns: &[&str]) -> String {
    let mut header = "t,hand_x,hand_y,hand_phi,held,pose_x,pose_y,pose_theta,depth,state,wrench_x,wrench_y,wrench_moment,\
                      slips,events,status,behind"
        .to_owned();
    for k in 0..4 {
        for column in columns {
            write!(header, ",c{k}_{column}").expect("a string");
        }
    }
    header
}

/// The columns of a contact that the frames need.
fn columns(scene: &Scene, frames: &[Frame]) -> Vec<&'static str> {
    let contacts = || frames.iter().flat_map(|frame| &frame.contacts);
    let mut columns = vec!["vertex", "surface"];
    if !scene.obstacles.is_empty() {
        columns.extend(["obstacle", "side", "corner", "body_side"]);
    }
    columns.extend(["x", "y", "normal", "friction"]);
    if contacts().any(|contact| contact.sliding.is_some()) {
        columns.push("sliding");
    }
    if contacts().any(|contact| contact.direction.is_some()) {
        columns.extend(["direction_x", "direction_y"]);
    }
    columns
}

/// The lines of a trace; in CSV the first one is the header.
pub(crate) fn lines(format: &str, scene: &Scene, frames: &[Frame]) -> Vec<String> {
    let columns = columns(scene, frames);
    match format {
        "csv" => std::iter::once(header(&columns))
            .chain(frames.iter().map(|frame| row(scene, frame, &columns)))
            .collect(),
        _ => frames.iter().map(|frame| object(scene, frame)).collect(),
    }
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
