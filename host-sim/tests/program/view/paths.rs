//! The hand leads the body; what was recorded is what the solver makes of the same samples, to the last bit; paths are
//! replayed and sought.

use serde_json::{Value, json};

use super::program::{Client, View};
use crate::common::{Folder, records, text};

/// The hand of box-flat at the beginning, on the floor, and farther along.
const HOME: [f64; 3] = [0.0, 0.07, 0.0];
const DOWN: [f64; 3] = [0.0, 0.04, 0.0];
const ALONG: [f64; 3] = [0.03, 0.04, 0.3];

/// Records a drag; the frames that the client saw.
fn dragged(client: &mut Client) -> Vec<Value> {
    client.done(json!({"type": "rate", "value": 1000}));
    client.done(json!({"type": "record", "value": true}));
    let mut seen = Vec::new();
    for (from, to) in [(HOME, DOWN), (DOWN, ALONG)] {
        client.lead(from, to, 40);
        seen.push(client.frame(|_| true));
    }
    let last = client.frame(|frame| frame["counts"]["slips"].as_u64() > Some(0));
    seen.push(last);
    client.done(json!({"type": "record", "value": false}));
    seen
}

/// The files of the recording, run again.
pub(crate) fn run_again(view: &View, number: &str, evolution: &str) -> (Vec<u8>, Vec<u8>) {
    let folder = Folder::new();
    folder.write("scene.toml", view.get("/recording/scene.toml"));
    folder.write("hand.csv", view.get("/recording/hand.csv"));
    folder.done(&format!(
        "run scene.toml --hand hand.csv --number {number} --evolution {evolution} --out trace.jsonl"
    ));
    let again = folder.read("trace.jsonl").into_bytes();
    (view.get("/recording/trace.jsonl"), again)
}

#[test]
fn a_box_dragged_over_the_floor_is_the_solvers_own_run_of_the_same_samples() {
    let view = View::start("box-flat");
    let mut client = view.client();
    let seen = dragged(&mut client);
    let (trace, again) = run_again(&view, "f32", "path");
    assert!(trace == again, "not the same bytes");
    let trace = records(&text(&trace));
    let states = ["non-contact", "edge", "single-vertex"];
    for state in &states[..2] {
        assert!(
            trace.iter().any(|record| record["state"] == *state),
            "{state}"
        );
    }
    let mut slips = 0;
    let sums: Vec<u64> = trace
        .iter()
        .map(|record| {
            slips += record["slips"].as_u64().expect("a number");
            slips
        })
        .collect();
    assert!(slips > 0);
    for message in seen {
        let tick = message["tick"].as_u64().expect("a number") as usize;
        assert_eq!(message["frame"], trace[tick], "tick {tick}");
        assert_eq!(message["counts"]["slips"], json!(sums[tick]), "tick {tick}");
        assert_eq!(message["counts"]["ticks"], json!(tick));
    }
}

#[test]
fn every_setting_records_what_it_runs() {
    let view = View::start("corner-stick-slip");
    let mut client = view.client();
    for (number, evolution) in [("f64", "frame"), ("fixed", "path")] {
        client.done(json!({"type": "number", "value": number}));
        client.done(json!({"type": "evolution", "value": evolution}));
        client
            .done(json!({"type": "set", "parameters": {"static": 0.8, "stiffness_rotation": 0.7}}));
        let home =
            client.state(|state| state["number"] == number && state["parameters"]["static"] == 0.8);
        let home: Vec<f64> = serde_json::from_value(home["scene"]["home"].clone()).expect("a pose");
        client.done(json!({"type": "record", "value": true}));
        let home = [home[0], home[1], home[2]];
        client.lead(home, [home[0] - 0.02, home[1] - 0.06, home[2] + 0.2], 30);
        client.done(json!({"type": "record", "value": false}));
        let (trace, again) = run_again(&view, number, evolution);
        assert!(trace == again, "{number} {evolution}");
    }
}

#[test]
fn a_recording_is_replayed_as_it_was_and_sought() {
    let view = View::start("box-flat");
    let mut client = view.client();
    dragged(&mut client);
    let trace = records(&text(&view.get("/recording/trace.jsonl")));
    client.done(json!({"type": "pause", "value": true}));
    client.done(json!({"type": "scene", "name": "ladder"}));
    client.done(json!({"type": "replay", "what": "recording"}));
    let last = trace.len() - 1;
    for tick in [last, 7, last / 2, 0, last / 3] {
        client.done(json!({"type": "seek", "seconds": tick as f64 / 1000.0}));
        let message = client.frame(|frame| frame["tick"] == json!(tick));
        assert_eq!(message["frame"], trace[tick]);
        assert_eq!(message["position"], json!(tick as f64 / 1000.0));
    }
    client.done(json!({"type": "pause", "value": false}));
    let end = client.frame(|frame| frame["tick"] == json!(last));
    assert_eq!(end["frame"], trace[last]);
    client.done(json!({"type": "replay", "what": null}));
    let state = client.state(|state| state["replay"].is_null());
    assert_eq!(state["scene"]["title"], "box-flat");
}

#[test]
fn the_path_of_a_scene_and_one_that_is_sent_are_those_of_a_run() {
    let view = View::start("ladder");
    let mut client = view.client();
    client.done(json!({"type": "pause", "value": true}));
    let folder = Folder::new();
    let path = "t,x,y,phi\n0.0,0.0,0.3,0.1\n0.25,0.01,0.25,0.2\n0.7,0.0,0.2,0.0\n";
    folder.write("hand.csv", path);
    let answer = view.http("POST", "/upload?name=my%20hand.csv", "", path.as_bytes());
    let answer_body: Value = serde_json::from_slice(&answer.body).expect("JSON");
    assert_eq!(
        (answer.status, &answer_body),
        (200, &json!({"seconds": 0.7, "records": 3, "notes": []}))
    );
    for (what, name, hand) in [
        ("scene", "scene", ""),
        ("upload", "my hand.csv", "--hand hand.csv"),
    ] {
        folder.done(&format!("run ladder --rate 1000 --out trace.jsonl {hand}"));
        let trace = records(&folder.read("trace.jsonl"));
        client.done(json!({"type": "replay", "what": what}));
        let state = client.state(|state| !state["replay"].is_null());
        assert_eq!(state["replay"]["what"], name);
        assert_eq!(state["hand"]["by"], "replay");
        for tick in [trace.len() - 1, 333, 600] {
            client.done(json!({"type": "seek", "seconds": tick as f64 / 1000.0}));
            let message = client.frame(|frame| frame["tick"] == json!(tick));
            assert_eq!(message["frame"], trace[tick], "{what}");
        }
        client.done(json!({"type": "replay", "what": null}));
        client.state(|state| state["replay"].is_null());
    }
}

#[test]
fn a_path_of_the_command_line_is_followed_from_the_beginning() {
    let folder = Folder::new();
    folder.write("hand.csv", "t,x,y,phi\n0,0,0.07,0\n0.05,0.001,0.04,0\n");
    let view = View::in_folder(folder, "box-flat --hand hand.csv --number f64");
    let mut client = view.client();
    let end = client.frame(|frame| frame["tick"] == 50);
    assert_eq!(end["frame"]["hand"], json!([0.001, 0.04, 0.0]));
    assert_eq!(end["reference"]["error"], json!([0.0, 0.0]), "{end}");
}
