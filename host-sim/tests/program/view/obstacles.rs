//! Scenes with obstacles as a client meets them: the state, contacts with corners, the meter of a peg in its hole, changes during a run.

use serde_json::{Value, json};

use super::paths::run_again;
use super::program::{Client, View};
use crate::common::{numbers, records, text};

/// A hand above the hole of `peg-in-hole`, and one half way down.
const ABOVE: [f64; 3] = [0.0008, 0.065, 0.005];
const HALF_WAY: [f64; 3] = [0.0008, 0.036, 0.005];

fn insertion(frame: &Value) -> &Value {
    &frame["frame"]["insertion"]
}

fn verdict(frame: &Value) -> &str {
    insertion(frame)["verdict"].as_str().unwrap_or_default()
}

/// The peg with both walls.
fn with_two_points(client: &mut Client) -> Value {
    client.lead(ABOVE, HALF_WAY, 100);
    client.frame(|frame| {
        let depth = insertion(frame)["depth"].as_f64();
        verdict(frame) == "two-point" && depth.is_some_and(|depth| depth > 0.01)
    })
}

#[test]
fn the_state_tells_of_the_obstacles_and_of_the_peg() {
    let view = View::start("peg-in-hole");
    let mut client = view.client();
    let scenes = client.hello["scenes"].as_array().expect("names").clone();
    for name in ["table-edge", "peg-in-hole", "hook"] {
        assert!(scenes.contains(&json!(name)), "{name}");
    }
    let state = client.state(|_| true);
    let obstacles = state["scene"]["obstacles"].as_array().expect("obstacles");
    let names: Vec<_> = obstacles.iter().map(|obstacle| &obstacle["name"]).collect();
    assert_eq!(names, ["left", "right", "bottom"]);
    assert_eq!(obstacles[2]["vertices"][0], json!([-0.05, -0.065]));
    assert_eq!(
        (&obstacles[0]["static"], &obstacles[0]["dynamic"]),
        (&json!(0.12), &json!(0.1))
    );
    assert_eq!(state["scene"]["peg"]["radius"], json!(0.01));
    assert_eq!(state["parameters"]["static"], json!(0.12));
    client.done(json!({"type": "scene", "name": "box-flat"}));
    let state = client.state(|state| state["scene"]["title"] == "box-flat");
    assert_eq!(
        (&state["scene"]["obstacles"], &state["scene"]["peg"]),
        (&json!([]), &Value::Null)
    );
}

#[test]
fn a_frame_tells_of_corners_and_of_the_load_beside_the_formulas() {
    let view = View::start("peg-in-hole");
    let mut client = view.client();
    let frame = with_two_points(&mut client);
    let contacts = frame["frame"]["contacts"].as_array().expect("contacts");
    assert!(
        contacts.iter().any(|contact| contact["corner"].is_u64()),
        "{frame}"
    );
    for contact in contacts {
        assert_eq!(numbers(&contact["direction"]).len(), 2, "{frame}");
    }
    // At small angles the force of contacts that slide is near that of the formula; where they stick it is up to mu_s / mu_d times as large.
    let fz = insertion(&frame)["fz"].as_f64().expect("a force");
    let formula = frame["small_angles"]["two_points"]
        .as_f64()
        .expect("two points");
    assert!(
        fz > 0.05 && (0.95..1.05 * 0.12 / 0.1).contains(&(fz / formula)),
        "{fz} {formula}"
    );
    // N and T of every obstacle.
    let rows = frame["strip"].as_array().expect("rows");
    let last = numbers(rows.last().expect("a row"));
    assert_eq!(last.len(), 7);
    assert!(last[1] > 0.0 && last[3] > 0.0, "{last:?}");
}

#[test]
fn friction_number_and_evolution_change_on_the_way() {
    let view = View::start("peg-in-hole");
    let mut client = view.client();
    let before = with_two_points(&mut client);
    let depth = |frame: &Value| insertion(frame)["depth"].as_f64().expect("a depth");
    for change in [
        json!({"type": "number", "value": "f64"}),
        json!({"type": "number", "value": "fixed"}),
        json!({"type": "evolution", "value": "frame"}),
        json!({"type": "set", "parameters": {"static": 0.2, "dynamic": 0.2}}),
    ] {
        client.done(change.clone());
        let after = client.frame(|_| true);
        assert!(
            (depth(&after) - depth(&before)).abs() < 2e-5,
            "{change}: {before} {after}"
        );
    }
    let state = client.state(|state| state["parameters"]["dynamic"] == json!(0.2));
    assert_eq!(state["scene"]["peg"]["friction"], json!(0.2));
    for obstacle in state["scene"]["obstacles"].as_array().expect("obstacles") {
        assert_eq!(
            (&obstacle["static"], &obstacle["dynamic"]),
            (&json!(0.2), &json!(0.2))
        );
    }
    // More friction bears the load: it does not slide in.
    let after = client.frame(|_| true);
    assert!(matches!(verdict(&after), "jammed" | "wedged"), "{after}");
}

#[test]
fn a_recorded_insertion_is_the_solvers_own_run() {
    let view = View::start("peg-in-hole");
    let mut client = view.client();
    client.done(json!({"type": "record", "value": true}));
    with_two_points(&mut client);
    client.done(json!({"type": "record", "value": false}));
    let (trace, again) = run_again(&view, "f32", "path");
    assert!(trace == again, "not the same bytes");
    let trace = records(&text(&trace));
    assert!(
        trace
            .iter()
            .any(|record| record["insertion"]["verdict"] == "two-point")
    );
}
