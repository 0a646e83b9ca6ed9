//! Every message and its effect; the messages that a client receives.

use serde_json::json;

use super::program::{Client, View};
use crate::common::numbers;

#[test]
fn hello_and_the_state_tell_what_there_is() {
    let view = View::start("ladder");
    let mut client = view.client();
    let hello = client.hello.clone();
    assert_eq!((&hello["version"], &hello["you"]), (&json!(1), &json!(1)));
    assert_eq!(hello["source"], json!({"kind": "core"}));
    let scenes = hello["scenes"].as_array().expect("names");
    assert!(scenes.contains(&json!("box-flat")) && scenes.contains(&json!("ladder")));
    // It is counted as soon as the solver knows of it.
    let state = client.state(|state| state["clients"] == 1);
    assert_eq!(state["scene"]["title"], "ladder");
    assert_eq!(
        state["scene"]["surfaces"][0]["normal"]
            .as_array()
            .map(Vec::len),
        Some(2)
    );
    assert_eq!(
        (&state["number"], &state["evolution"]),
        (&json!("f32"), &json!("path"))
    );
    assert_eq!(
        (&state["paused"], &state["speed"]),
        (&json!(false), &json!(1.0))
    );
    for key in ["recording", "recorded", "replay"] {
        assert!(state[key].is_null(), "{key}");
    }
    assert_eq!(state["hand"], json!({"by": null, "client": null}));
}

#[test]
fn a_frame_tells_of_the_springs_the_reference_and_the_strip() {
    let view = View::start("box-flat");
    let mut client = view.client();
    client.lead([0.0, 0.07, 0.0], [0.0, 0.04, 0.0], 20);
    let frame = client.frame(|frame| frame["frame"]["hand"][1] == json!(0.04));
    // The edge lies on the floor: the box is 0.06 m high and held 0.02 m above its middle, the hand 10 mm below that.
    let holding = numbers(&frame["holding"]);
    assert!(
        holding[0].abs() < 1e-6 && (holding[1] - 0.05).abs() < 1e-6,
        "{holding:?}"
    );
    let ghost = numbers(&frame["ghost"]);
    assert!(
        (ghost[1] - 0.02).abs() < 1e-6 && ghost[2].abs() < 1e-6,
        "{ghost:?}"
    );
    let row = frame["strip"].as_array().and_then(|strip| strip.last());
    let row = numbers(row.expect("a row"));
    // 500 N/m times 10 mm.
    assert!(row.len() == 3 && (row[1] - 5.0).abs() < 1e-3, "{row:?}");
    assert_eq!(frame["reference"]["state"], "edge");
    let error = numbers(&frame["reference"]["error"]);
    assert!(error[0] < 1e-6 && error[1] < 1e-5, "{error:?}");
    let counts = &frame["counts"];
    assert_eq!(counts["transitions"]["non-contact>edge"], 1);
    assert_eq!(counts["events"]["land"], 1);
    assert_eq!(frame["frame"]["status"], "ok");
    assert!(frame["board"].is_null() && frame["position"].is_null());
}

#[test]
fn a_hand_that_lets_go_leaves_the_body_where_it_is() {
    let view = View::start("box-flat");
    let mut client = view.client();
    client.say(&json!({"type": "hand", "pose": [0.0, 0.07, 0.0], "held": false}));
    let free = client.frame(|frame| frame["frame"]["held"] == false);
    assert!(free["ghost"].is_null() && free["holding"].is_null());
    assert_eq!(free["counts"]["events"]["release"], 1);
    client.lead([0.5, 0.5, 0.0], [0.5, 0.5, 0.0], 1);
    let away = client.frame(|frame| frame["frame"]["hand"][0] == json!(0.5));
    // Too far away to take hold.
    assert_eq!(away["frame"]["held"], false);
    assert_eq!(away["frame"]["pose"], free["frame"]["pose"]);
}

#[test]
fn pause_steps_speed_and_reset() {
    let view = View::start("box-flat");
    let mut client = view.client();
    assert!(
        client.ask(json!({"type": "step", "ticks": 1})).is_err(),
        "not paused"
    );
    client.done(json!({"type": "pause", "value": true}));
    client.state(|state| state["paused"] == true);
    client.done(json!({"type": "reset"}));
    let begun = client.frame(|frame| frame["tick"] == 0);
    assert_eq!(begun["counts"]["ticks"], 0);
    client.done(json!({"type": "step", "ticks": 1}));
    client.frame(|frame| frame["tick"] == 1);
    client.done(json!({"type": "step", "ticks": 1000}));
    let after = client.frame(|frame| frame["tick"] == 1001);
    assert_eq!(after["frame"]["t"], 1.001);
    client.done(json!({"type": "speed", "value": 0.001}));
    client.done(json!({"type": "pause", "value": false}));
    let state = client.state(|state| state["paused"] == false);
    assert_eq!(state["speed"], 0.001);
    // A tick a second.
    client.frame(|frame| frame["tick"] == 1002);
    client.done(json!({"type": "speed", "value": 1}));
    client.frame(|frame| frame["tick"].as_u64() > Some(1100));
}

#[test]
fn parameters_number_and_evolution_change_while_the_body_stays() {
    let view = View::start("box-flat");
    let mut client = view.client();
    client.lead([0.0, 0.07, 0.0], [0.01, 0.04, 0.0], 20);
    let pose = |client: &mut Client| {
        numbers(&client.frame(|frame| frame["frame"]["hand"][1] == json!(0.04))["frame"]["pose"])
    };
    let before = pose(&mut client);
    for change in [
        json!({"type": "set", "parameters": {"stiffness_translation": 800.0, "static": 0.9, "dynamic": 0.4}}),
        json!({"type": "set", "parameters": {"memory": 1e-4}}),
        json!({"type": "set", "parameters": {"memory": null}}),
        json!({"type": "set", "parameters": {"memory": 2e-5}}),
        json!({"type": "number", "value": "fixed"}),
        json!({"type": "evolution", "value": "frame"}),
        json!({"type": "number", "value": "f64"}),
        json!({"type": "number", "value": "f32"}),
    ] {
        client.done(change.clone());
        let after = pose(&mut client);
        for (a, b) in before.iter().zip(&after) {
            assert!((a - b).abs() < 1e-5, "{change}: {before:?} {after:?}");
        }
    }
    let state = client.state(|state| state["evolution"] == "frame" && state["number"] == "f32");
    assert_eq!(
        state["parameters"],
        json!({"stiffness_translation": 800.0, "stiffness_rotation": 0.5, "static": 0.9, "dynamic": 0.4, "memory": 2e-5, "weight": 0.0})
    );
    let loaded = client.frame(|frame| frame["frame"]["state"] == "edge");
    let normal: f64 = loaded["frame"]["contacts"]
        .as_array()
        .expect("contacts")
        .iter()
        .map(|contact| contact["normal"].as_f64().expect("a number"))
        .sum();
    assert!((normal - 8.0).abs() < 1e-2, "{normal}");
    client.done(json!({"type": "reset"}));
    let begun = client
        .frame(|frame| frame["counts"]["slips"] == 0 && frame["frame"]["state"] == "non-contact");
    assert_eq!(begun["frame"]["held"], true);
}

#[test]
fn a_hold_that_was_taken_on_the_way_goes_on_under_other_parameters() {
    let view = View::start("box-flat --number f64");
    let mut client = view.client();
    client.say(&json!({"type": "hand", "pose": [0.0, 0.07, 0.0], "held": false}));
    let free = client.frame(|frame| frame["frame"]["held"] == false);
    let [x, y, _] = [0, 1, 2].map(|i| numbers(&free["frame"]["pose"])[i]);
    // Taken at a corner, and turned five times.
    let from = [x + 0.04, y + 0.02, 1.0];
    client.say(&json!({"type": "hand", "pose": from, "held": true}));
    client.frame(|frame| frame["counts"]["events"]["grasp"] == 1);
    client.lead(from, [from[0], from[1] + 0.3, 1.0], 10);
    client.lead(
        [from[0], from[1] + 0.3, 1.0],
        [from[0], from[1] + 0.3, 31.0],
        60,
    );
    let turned = |client: &mut Client| client.frame(|frame| frame["frame"]["hand"][2] == 31.0);
    let before = turned(&mut client)["frame"].clone();
    client.done(json!({"type": "set", "parameters": {"stiffness_rotation": 0.9}}));
    client.done(json!({"type": "number", "value": "f32"}));
    client.done(json!({"type": "number", "value": "f64"}));
    let frame = client.frame(|_| true);
    let after = &frame["frame"];
    assert!(
        (before["hand"][2].as_f64().expect("phi") - after["hand"][2].as_f64().expect("phi")).abs()
            < 1e-5
    );
    for (a, b) in numbers(&before["pose"]).iter().zip(numbers(&after["pose"])) {
        assert!((a - b).abs() < 1e-5, "{before} {after}");
    }
}
