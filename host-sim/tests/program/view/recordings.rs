//! Recordings: in a file from the first sample on, whatever becomes of the program; from where the body is, with the changes of its
//! setting; offered again, and run again bit for bit.

use std::collections::hash_map::RandomState;
use std::fs;
use std::hash::{BuildHasher, Hasher};
use std::thread;
use std::time::Duration;

use serde_json::{Value, json};

use super::program::{Client, View};
use crate::common::{Folder, numbers, records, said, text};

/// The hand of box-flat at the beginning, on the floor, and farther along.
const HOME: [f64; 3] = [0.0, 0.07, 0.0];
const DOWN: [f64; 3] = [0.0, 0.04, 0.0];
const ALONG: [f64; 3] = [0.03, 0.04, 0.0];
/// The first recording of box-flat.
const FILE: &str = "recordings/box-flat-1.jsonl";

fn replayed(folder: &Folder, file: &str, options: &str) -> (Option<i32>, String) {
    let output = folder.stiction(&format!("replay {file} {options}"));
    (output.status.code(), said(&output))
}

/// Begins to record; where the body is then.
fn recording(client: &mut Client) -> Value {
    client.done(json!({"type": "record", "value": true}));
    client.state(|state| !state["recording"].is_null());
    client.frame(|_| true)
}

fn recorded(client: &mut Client) -> Value {
    client.done(json!({"type": "record", "value": false}));
    client.state(|state| !state["recorded"].is_null())["recorded"].clone()
}

/// Up to a number.
fn random(below: u64) -> u64 {
    RandomState::new().build_hasher().finish() % below
}

/// The newest frame that a client was sent when the program was killed.
fn last_frame(client: &mut Client) -> Option<Value> {
    let mut last = None;
    while let Ok(message) = client.socket.read() {
        let message: Value = match message.to_text() {
            Ok(text) => serde_json::from_str(text).unwrap_or_default(),
            Err(_) => Value::Null,
        };
        if message["type"] == "frame" {
            last = Some(message["frame"].clone());
        }
    }
    last
}

/// Killed at any moment, it has every tick that anybody has seen, and no line that is not whole but the last one.
#[test]
fn a_recording_survives_kill_9_at_any_moment() {
    let mut folder = Folder::new();
    for k in 1..=20 {
        let view = View::in_folder(folder, "box-flat");
        let mut client = view.client();
        client.done(json!({"type": "rate", "value": 1000}));
        recording(&mut client);
        for step in 1..=5 {
            let down = 0.07 - 0.006 * f64::from(step);
            client.say(&json!({"type": "hand", "pose": [0.0, down, 0.0], "held": true}));
            thread::sleep(Duration::from_micros(random(100_000)));
        }
        folder = view.kill();
        let seen = last_frame(&mut client).expect("a frame");
        let file = format!("recordings/box-flat-{k}.jsonl");
        let recorded = folder.read(&file);
        let whole = recorded.rfind('\n').expect("a line");
        let lines: Vec<Value> = records(&recorded[..whole]);
        let tick = (seen["t"].as_f64().expect("a time") * 1000.0).round() as usize;
        assert_eq!(lines[tick + 1]["answer"], seen, "recording {k}");
        let (status, message) = replayed(&folder, &file, "");
        assert_eq!(status, Some(1), "{message}");
        let count = lines.len() - 1;
        let compared = format!("{count} of {count} frames compared, the same bits");
        assert!(message.contains(&compared), "{message}");
    }
}

#[test]
fn what_was_recorded_is_offered_again_at_the_next_start() {
    let view = View::start("box-flat");
    let mut client = view.client();
    recording(&mut client);
    client.lead(HOME, DOWN, 20);
    client.lead(DOWN, ALONG, 40);
    let last = client.frame(|frame| frame["frame"]["hand"][0] == json!(0.03));
    let view = View::in_folder(view.kill(), "ladder");
    let mut client = view.client();
    let state = client.state(|state| !state["recorded"].is_null());
    let offered = &state["recorded"];
    assert_eq!(offered["earlier"], true);
    assert!(offered["file"].as_str().expect("a place").ends_with(FILE));
    let end = last["frame"]["t"].as_f64().expect("a time");
    assert!(offered["seconds"].as_f64() >= Some(end), "{offered}");
    let trace = records(&text(&view.get("/recording/trace.jsonl")));
    assert!(trace.contains(&last["frame"]));
    client.done(json!({"type": "replay", "what": "recording"}));
    let state = client.state(|state| !state["replay"].is_null());
    assert_eq!(state["scene"]["title"], "box-flat");
    client.done(json!({"type": "pause", "value": true}));
    client.done(json!({"type": "seek", "seconds": end}));
    let there = client.frame(|frame| frame["frame"]["t"] == last["frame"]["t"]);
    assert_eq!(there["frame"], last["frame"]);
    // The next one has another name.
    client.done(json!({"type": "record", "value": true}));
    let state = client.state(|state| !state["recording"].is_null());
    let file = state["recording_file"].as_str().expect("a place");
    assert!(file.ends_with("recordings/box-flat-2.jsonl"), "{file}");
}

#[cfg(unix)]
#[test]
fn a_program_that_is_ended_ends_its_recording() {
    let mut view = View::start("box-flat");
    let mut client = view.client();
    recording(&mut client);
    client.lead(HOME, DOWN, 20);
    view.interrupt();
    assert!(view.child.wait().expect("it ends").success());
    let (status, message) = replayed(view.folder(), FILE, "");
    assert_eq!(status, Some(0), "{message}");
}

/// A box that was taken at a corner and is pressed onto the floor: nothing moves when it is recorded.
#[test]
fn a_recording_begins_where_the_body_is() {
    for number in ["f32", "f64", "fixed"] {
        let view = View::start(&format!("box-flat --number {number}"));
        let mut client = view.client();
        client.lead(HOME, [0.02, 0.06, 0.1], 20);
        for held in [false, true] {
            client.done(json!({"type": "hand", "pose": [0.05, 0.07, 0.2], "held": held}));
        }
        client.lead([0.05, 0.07, 0.2], [0.04, 0.04, 0.25], 40);
        let before = client.frame(|frame| numbers(&frame["frame"]["hand"])[1] < 0.0401);
        let state = &before["frame"]["state"];
        assert_ne!(*state, "non-contact");
        recording(&mut client);
        let after = client.frame(|frame| frame["tick"].as_u64() > Some(1));
        let off = |key: &str| {
            let pairs = [&before, &after].map(|frame| numbers(&frame["frame"][key]));
            let [a, b] = pairs;
            let pairs = a.into_iter().zip(b);
            pairs.fold(0.0, |off: f64, (a, b)| off.max((a - b).abs()))
        };
        assert_eq!(after["frame"]["state"], *state);
        assert!(off("hand") < 1e-6, "{number}: {before} {after}");
        // Where friction holds by more than mu_d N, the contacts slide as they are loaded anew, until N is what makes them stick: by less
        // than a memory length, L / 4096, and the springs, 500 N/m, yield by that.
        let memory = 0.1_f64.hypot(0.06) / 4096.0;
        assert!(off("pose") < memory, "{number}: {before} {after}");
        assert!(off("wrench") < 500.0 * memory, "{number}: {before} {after}");
        client.lead([0.04, 0.04, 0.25], [0.08, 0.04, 0.0], 40);
        recorded(&mut client);
        let (trace, again) = super::paths::run_again(&view, number, "path");
        assert!(trace == again, "{number}: not the same bytes");
        // A reset leads to the beginning of the scene.
        client.done(json!({"type": "reset"}));
        let frame = client.frame(|frame| frame["tick"].as_u64() < Some(100));
        assert_eq!(numbers(&frame["frame"]["hand"])[..2], HOME[..2]);
    }
}

#[test]
fn a_changed_setting_is_in_the_recording() {
    let view = View::start("box-flat");
    let mut client = view.client();
    client.lead(HOME, DOWN, 20);
    recording(&mut client);
    client.lead(DOWN, ALONG, 20);
    client.done(
        json!({"type": "set", "parameters": {"stiffness_translation": 700.0, "static": 0.7}}),
    );
    client.lead(ALONG, DOWN, 20);
    client.done(json!({"type": "number", "value": "f64"}));
    client.lead(DOWN, ALONG, 20);
    client.done(json!({"type": "evolution", "value": "frame"}));
    client.lead(ALONG, DOWN, 20);
    client.done(json!({"type": "set", "parameters": {"weight": 3.0}}));
    client.lead(DOWN, HOME, 20);
    let end = client.frame(|_| true)["frame"].clone();
    let whole = recorded(&mut client);
    assert!(whole["seconds"].as_f64() >= end["t"].as_f64());
    let folder = view.folder();
    let written = folder.read(FILE);
    assert_eq!(written.matches(r#"{"change":{"number":"#).count(), 4);
    assert_eq!(written, text(&view.get("/recording/recording.jsonl")));
    let again = "--out again.jsonl --record again-recording.jsonl";
    let (status, message) = replayed(folder, FILE, again);
    assert_eq!(status, Some(0), "{message}");
    assert_eq!(
        folder.read("again.jsonl"),
        text(&view.get("/recording/trace.jsonl"))
    );
    assert_eq!(folder.read("again-recording.jsonl"), written);
    // The page replays it with its changes, and goes to any place in it.
    client.done(json!({"type": "replay", "what": "recording"}));
    client.state(|state| state["number"] == "f32" && !state["replay"].is_null());
    client.done(json!({"type": "pause", "value": true}));
    client.done(json!({"type": "seek", "seconds": end["t"]}));
    let there = client.frame(|frame| frame["frame"]["t"] == end["t"]);
    assert_eq!(there["frame"], end);
    let state = view.state();
    assert_eq!(
        (&state["number"], &state["evolution"]),
        (&json!("f64"), &json!("frame"))
    );
    assert_eq!(state["parameters"]["static"], 0.7);
    assert_eq!(state["parameters"]["weight"], 3.0);
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_the_page_is_there() {
    let folder = Folder::new();
    folder.write("taken", "");
    for place in ["taken", "taken/below"] {
        let typed = format!("view --listen 127.0.0.1:0 --recordings {place}");
        let expected = format!("{place}: cannot be written: ");
        folder.refused(&typed, &[&expected, "allowed: a folder for recordings"]);
    }
    assert_eq!(folder.read("taken"), "");
}

#[test]
fn a_folder_that_is_lost_later_is_reported_and_nothing_changes() {
    let view = View::start("box-flat");
    let place = view.folder().file("recordings");
    fs::remove_dir(&place).expect("an empty folder");
    fs::write(&place, "").expect("a file");
    let mut client = view.client();
    let refusal = client
        .ask(json!({"type": "record", "value": true}))
        .expect_err("a refusal");
    assert!(
        refusal.contains("recordings: cannot be written") && refusal.contains("allowed"),
        "{refusal}"
    );
    let state = view.state();
    assert!(state["recording"].is_null() && state["recorded"].is_null());
}

/// Nothing is deleted, so the program reports at its start how many recordings there are.
#[test]
fn the_start_tells_how_many_recordings_there_are_and_how_long() {
    let folder = Folder::new();
    fs::create_dir(folder.file("recordings")).expect("a folder");
    folder.write("recordings/a-1.jsonl", vec![b'\n'; 1_900_000]);
    folder.write("recordings/a-2.jsonl", vec![b'\n'; 400_000]);
    folder.write("recordings/notes.txt", vec![b'\n'; 1_000_000]);
    #[cfg(unix)]
    nix::unistd::mkfifo(
        &folder.file("recordings/pipe.jsonl"),
        nix::sys::stat::Mode::S_IRWXU,
    )
    .expect("a pipe");
    let mut view = View::in_folder(folder, "box-flat");
    let printed = view.line();
    let place = view.folder().file("recordings");
    let expected = format!(
        "recordings so far: 2, 2.3 MB in {}; the program deletes none\n",
        place.display()
    );
    assert_eq!(printed, expected);
    assert_eq!(fs::read_dir(place).expect("the folder").count(), 4);
}

/// As with a full disk: the failure is reported, nothing that was written is lost, and the program goes on.
#[cfg(unix)]
#[test]
fn a_recording_ends_where_there_is_no_room_and_says_so() {
    const BLOCKS: u32 = 200;
    let mut view = View::with_room(BLOCKS, Folder::new(), "box-flat");
    let mut client = view.client();
    client.done(json!({"type": "record", "value": true}));
    let state = client.state(|state| !state["recorded"].is_null());
    assert!(state["recording"].is_null());
    let problem = state["recorded"]["problem"].as_str().expect("a problem");
    let expected = "box-flat-1.jsonl: cannot be written: ";
    assert!(problem.contains(expected), "{problem}");
    let printed = loop {
        let line = view.line();
        if line.starts_with("the recording has ended after ") {
            break line;
        }
    };
    assert!(printed.contains(expected), "{printed}");
    client.frame(|_| true);
    let written = view.folder().read(FILE);
    assert_eq!(written.len(), BLOCKS as usize * 512);
    let (status, message) = replayed(view.folder(), FILE, "");
    let whole = written.matches('\n').count() - 1;
    assert_eq!(status, Some(1), "{message}");
    let compared = format!("{whole} of {whole} frames compared, the same bits");
    assert!(message.contains(&compared), "{message}");
}

/// Where not even the head has room, nothing is left behind.
#[cfg(unix)]
#[test]
fn a_recording_without_room_is_refused_and_leaves_no_file() {
    let view = View::with_room(0, Folder::new(), "box-flat");
    let refusal = view.client().ask(json!({"type": "record", "value": true}));
    let refusal = refusal.expect_err("a refusal");
    assert!(
        refusal.contains("recordings: cannot be written: "),
        "{refusal}"
    );
    let left = fs::read_dir(view.folder().file("recordings")).expect("the folder");
    assert_eq!(left.count(), 0);
}
