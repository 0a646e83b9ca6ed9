//! What a page shows a stranger first: pictures and stories of the scenes, the demonstration, the weight.

use serde_json::{Value, json};

use super::program::{Client, View};
use crate::common::{Folder, numbers, on_the_floor, text};

/// A scene whose path takes 0.2 s: a box is lowered onto the floor and dragged along it.
fn scene() -> String {
    let keyframes =
        "keyframes = [[0.0, 0.0, 0.07, 0.0], [0.1, 0.0, 0.04, 0.0], [0.2, 0.03, 0.04, 0.0]]";
    format!(
        "# A box is set down and dragged.{}",
        on_the_floor(keyframes)
    )
}

fn short(options: &str) -> View {
    let folder = Folder::new();
    folder.write("short.toml", scene());
    View::in_folder(folder, &format!("short.toml {options}"))
}

fn demonstration(client: &mut Client) -> Result<(), String> {
    client.ask(json!({"type": "replay", "what": "scene", "demonstration": true}))
}

#[test]
fn every_scene_has_a_story_and_a_picture() {
    let view = short("");
    let hello = view.client().hello;
    let list = |key: &str| hello[key].as_array().expect("a list").clone();
    let (scenes, stories) = (list("scenes"), list("stories"));
    assert_eq!(
        (&scenes[0], &stories[0]),
        (&json!("short"), &json!("A box is set down and dragged."))
    );
    assert_eq!(scenes.len(), stories.len());
    for (scene, story) in scenes.iter().zip(&stories) {
        assert!(
            story.as_str().is_some_and(|story| story.ends_with('.')),
            "{story}"
        );
        let name = scene.as_str().expect("a name");
        let answer = view.http("GET", &format!("/scenes/{name}.svg"), "", b"");
        assert!(
            answer.head.contains("content-type: image/svg+xml"),
            "{}",
            answer.head
        );
        assert!(text(&answer.body).starts_with("<svg "), "{name}");
    }
    for other in [
        "/scenes/nowhere.svg",
        "/scenes/ladder",
        "/scenes/../ladder.svg",
    ] {
        assert_eq!(view.http("GET", other, "", b"").status, 404, "{other}");
    }
}

#[test]
fn a_demonstration_goes_on_until_somebody_takes_the_hand() {
    let view = short("");
    let (mut page, mut other) = (view.client(), view.client());
    let before = page.state(|_| true);
    assert_eq!(before["replay"], Value::Null);
    demonstration(&mut page).expect("nobody holds the hand");
    let state = other.state(|state| !state["replay"].is_null());
    assert_eq!(
        state["replay"],
        json!({"what": "scene", "seconds": 0.2, "demonstration": true})
    );
    // To its end, and from its beginning again.
    for _ in 0..2 {
        page.frame(|frame| frame["position"] == 0.2);
        page.frame(|frame| frame["position"].as_f64() < Some(0.1));
    }
    // Another client takes the hand: it is live, and the body where it was.
    page.done(json!({"type": "pause", "value": true}));
    let there = page.frame(|_| true);
    let hand = numbers(&there["frame"]["hand"]);
    other.say(&json!({"type": "hand", "pose": hand, "held": true, "sent": 1}));
    let state = other.state(|state| state["replay"].is_null());
    assert_eq!(state["hand"]["client"], other.hello["you"]);
    other.done(json!({"type": "pause", "value": false}));
    let taken = other.frame(|frame| frame["echo"] == 1);
    for part in ["hand", "pose"] {
        assert_eq!(taken["frame"][part], there["frame"][part]);
    }
    // It is not taken from there, but for a demonstration of its own.
    let why = demonstration(&mut page).expect_err("the other one holds the hand");
    assert!(why.contains("client 2 holds the hand, allowed"), "{why}");
    demonstration(&mut other).expect("its own hand");
    // Who sees it no more leaves the scene as it was.
    drop((page, other));
    let mut next = view.client();
    next.state(|state| state["clients"] == 1 && state["replay"].is_null());
    let frame = next.frame(|frame| frame["position"].is_null());
    assert_eq!(frame["frame"]["hand"], json!([0.0, 0.07, 0.0]));
}

#[test]
fn a_hand_that_comes_from_elsewhere_is_not_taken() {
    for options in ["--osc-in 0", "--opentrack-in 0"] {
        let view = short(options);
        let why = demonstration(&mut view.client()).expect_err("a tracker leads the hand");
        assert!(why.contains("allowed"), "{why}");
    }
}

/// The box on the floor: the reaction is what the spring presses, 500 N/m by 10 mm, and the weight.
#[test]
fn the_weight_adds_to_the_reaction() {
    let view = short("");
    let mut client = view.client();
    let down = [0.0, 0.04, 0.0];
    client.lead([0.0, 0.07, 0.0], down, 20);
    let pressed = |client: &mut Client, weight: f64| {
        let loaded = |frame: &Value| {
            let contacts = frame["frame"]["contacts"].as_array().expect("contacts");
            let forces = contacts
                .iter()
                .filter_map(|contact| contact["normal"].as_f64());
            forces.sum::<f64>()
        };
        let frame = client.frame(|frame| (loaded(frame) - 5.0 - weight).abs() < 1e-3);
        assert_eq!(frame["frame"]["state"], "edge");
        let error = numbers(&frame["reference"]["error"]);
        assert!(error[0] < 1e-6, "{error:?}");
    };
    pressed(&mut client, 0.0);
    for weight in [4.0, 0.5] {
        client.done(json!({"type": "set", "parameters": {"weight": weight}}));
        let state = client.state(|state| state["parameters"]["weight"] == weight);
        assert_eq!(state["scene"]["weight"], weight);
        pressed(&mut client, weight);
    }
    for bad in [-1.0, 1e300] {
        let refused = client.ask(json!({"type": "set", "parameters": {"weight": bad}}));
        assert!(refused.is_err_and(|why| why.contains("allowed")), "{bad}");
    }
    // One that is let go stays where it is.
    client.say(&json!({"type": "hand", "pose": down, "held": false}));
    let open = client.frame(|frame| frame["frame"]["held"] == false);
    client.done(json!({"type": "set", "parameters": {"weight": 8.0}}));
    let after =
        client.frame(|frame| frame["tick"].as_u64() > open["tick"].as_u64().map(|tick| tick + 50));
    // To the last place of f32 at the size of the body.
    let [before, after] = [&open, &after].map(|frame| numbers(&frame["frame"]["pose"]));
    let off = before.iter().zip(&after).map(|(a, b)| (a - b).abs());
    assert!(off.fold(0.0, f64::max) <= 1e-7, "{before:?}, {after:?}");
}
