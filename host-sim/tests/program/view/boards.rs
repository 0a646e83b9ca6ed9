//! The solver runs on a board: clients see the board's answers, and the reference runs in parallel.

use serde_json::{Value, json};

use super::program::{Client, View};
use super::station::Board;
use crate::common::{Folder, numbers, records, text};

/// A board of f32, and the view that it is the source of.
pub(crate) fn with_board(scene: &str) -> (Board, View) {
    let folder = Folder::new();
    let board = Board::f32(&folder.file("line"));
    (
        board,
        View::in_folder(folder, &format!("{scene} --socket line --timeout 20")),
    )
}

/// The next frame in which the board has answered this hand.
pub(crate) fn with_hand(client: &mut Client, pose: [f64; 3]) -> Value {
    client.frame(|frame| {
        let hand = numbers(&frame["frame"]["hand"]);
        hand.iter().zip(pose).all(|(a, b)| (a - b).abs() < 1e-6)
    })
}

/// The hand goes there in a straight line, with a sample for every frame that comes.
pub(crate) fn lead(client: &mut Client, from: [f64; 3], to: [f64; 3]) -> Value {
    for k in 1..=20 {
        let part = f64::from(k) / 20.0;
        let pose = [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * part);
        client.say(&json!({"type": "hand", "pose": pose, "held": true}));
        client.frame(|_| true);
    }
    with_hand(client, to)
}

#[test]
fn a_board_says_who_it_is_and_how_it_fares() {
    let (_board, view) = with_board("box-flat");
    let mut client = view.client();
    assert_eq!(
        client.hello["source"],
        json!({"kind": "board", "name": "a thread", "number": "f32", "where": "line", "emulated": false})
    );
    let frame = client.frame(|frame| frame["board"]["latency"].is_f64());
    let board = &frame["board"];
    assert_eq!(board["connected"], true);
    assert!(board["rate"].as_f64() > Some(0.0), "{board}");
    for count in ["late", "lost", "missed", "faults"] {
        assert!(board[count].is_u64(), "{count}: {board}");
    }
    assert!(frame["step"]["median"].is_null(), "it is not reported");
}

#[test]
fn the_body_of_a_board_is_pressed_to_the_floor_and_dragged() {
    let (_board, view) = with_board("box-flat");
    let mut client = view.client();
    let state = client.state(|_| true);
    assert_eq!(state["number"], "f32");
    let (home, down) = ([0.0, 0.07, 0.0], [0.0, 0.04, 0.0]);
    let pressed = lead(&mut client, home, down);
    assert_eq!(pressed["frame"]["state"], "edge");
    // 500 N/m times 10 mm, shared by two vertices.
    let contacts = pressed["frame"]["contacts"].as_array().expect("contacts");
    let sum: f64 = contacts.iter().filter_map(|c| c["normal"].as_f64()).sum();
    assert!((sum - 5.0).abs() < 1e-3, "{contacts:?}");
    let dragged = lead(&mut client, down, [0.05, 0.04, 0.0]);
    assert!(dragged["counts"]["slips"].as_u64() > Some(0));
    // Friction holds the body back by less than mu_s N / k_h.
    let x = numbers(&dragged["frame"]["pose"])[0];
    assert!(x > 0.05 - 0.5 * 5.0 / 500.0 - 1e-6 && x < 0.05, "{x}");
    let error = numbers(&dragged["reference"]["worst"]);
    assert_eq!(dragged["reference"]["state"], "edge");
    assert!(error[0] < 0.01 && error[1] < 0.01, "{error:?}");
}

#[test]
fn parameters_scene_and_evolution_of_a_board_change() {
    let (_board, view) = with_board("box-flat");
    let mut client = view.client();
    let down = [0.0, 0.04, 0.0];
    lead(&mut client, [0.0, 0.07, 0.0], down);
    client.done(json!({"type": "set", "parameters": {"stiffness_translation": 1000.0}}));
    let state = client.state(|state| state["parameters"]["stiffness_translation"] == 1000.0);
    assert_eq!(state["parameters"]["stiffness_rotation"], 0.5);
    let force = |frame: &Value| numbers(&frame["frame"]["wrench"])[1];
    // The body stays on the floor: the spring is as long as before.
    let frame = client.frame(|frame| (force(frame) + 10.0).abs() < 1e-3);
    assert_eq!(frame["frame"]["state"], "edge");
    client.done(json!({"type": "evolution", "value": "frame"}));
    client.state(|state| state["evolution"] == "frame");
    client.done(json!({"type": "scene", "name": "ladder"}));
    let state = client.state(|state| state["scene"]["title"] == "ladder");
    let home = numbers(&state["scene"]["home"]);
    with_hand(&mut client, [home[0], home[1], home[2]]);
    client.done(json!({"type": "reset"}));
    client.frame(|frame| frame["tick"].as_u64() < Some(1000));
}

#[test]
fn what_a_board_refuses_changes_nothing() {
    let (_board, view) = with_board("box-flat");
    let mut client = view.client();
    let set = |parameters: Value| json!({"type": "set", "parameters": parameters});
    let stiffness = set(json!({"stiffness_translation": -1.0}));
    let friction = set(json!({"static": 0.1, "dynamic": 0.3}));
    let demonstration = json!({"type": "replay", "what": "scene", "demonstration": true});
    for (message, part) in [
        (
            json!({"type": "number", "value": "f64"}),
            "allowed on this board: f32",
        ),
        (stiffness, "allowed"),
        (friction, "allowed"),
        (set(json!({"memory": -1e-5})), "memory of surface 0"),
        (
            set(json!({"weight": 1.0})),
            "a board keeps the weight of its scene, allowed",
        ),
        (demonstration, "a board gives no demonstration, allowed"),
    ] {
        let error = client.ask(message.clone()).expect_err("a refusal");
        assert!(error.contains(part), "{message}: {error}");
    }
    let frame = client.frame(|_| true);
    assert_eq!(frame["board"]["connected"], true);
    client.done(set(json!({"static": 0.6})));
}

/// The box over a floor and walls with frictions of their own.
fn walls(count: usize) -> String {
    let wall = |k: usize| {
        format!(
            "[[surface]]\nname = \"wall {k}\"\nnormal = [{}, 1.0]\noffset = 0.0\nstatic = 0.{}\ndynamic = 0.1\n",
            k,
            k + 3
        )
    };
    let body =
        "[body]\nrectangle = [0.1, 0.06]\nstart = [0.0, 0.5, 0.0]\n[grasp]\npoint = [0.0, 0.0]\n";
    let spring = "[spring]\ntranslation = 500.0\nrotation = 0.5\n";
    format!("{body}{spring}{}", (0..count).map(wall).collect::<String>())
}

#[test]
fn a_board_has_one_friction_for_all_surfaces() {
    let folder = Folder::new();
    let _board = Board::f32(&folder.file("line"));
    folder.write("walls.toml", walls(2));
    let view = View::in_folder(folder, "walls.toml --socket line");
    let mut client = view.client();
    let error = client.ask(json!({"type": "set", "parameters": {"stiffness_rotation": 1.0}}));
    assert!(error.is_err_and(|error| error.contains("frictions of their own")));
    let all = json!({"static": 0.6, "dynamic": 0.2, "memory": 5e-5, "stiffness_rotation": 1.0});
    client.done(json!({"type": "set", "parameters": all}));
    let state = client.state(|state| state["parameters"]["stiffness_rotation"] == 1.0);
    for surface in state["scene"]["surfaces"].as_array().expect("surfaces") {
        assert_eq!(
            [&surface["static"], &surface["dynamic"], &surface["memory"]],
            [&json!(0.6), &json!(0.2), &json!(5e-5)]
        );
    }
}

#[test]
fn a_scene_that_a_board_has_no_room_for_is_an_error() {
    let folder = Folder::new();
    let _board = Board::f32(&folder.file("line"));
    folder.write("walls.toml", walls(3));
    folder.refused("view walls.toml --socket line", &["surfaces is 3"]);
}

#[test]
fn a_paused_hand_stands_still_and_steps() {
    let (_board, view) = with_board("box-flat");
    let mut client = view.client();
    client.done(json!({"type": "pause", "value": true}));
    let tick = client.frame(|_| true)["tick"].as_u64().expect("a tick");
    client.done(json!({"type": "step", "ticks": 10}));
    client.frame(|frame| frame["tick"] == json!(tick + 10));
    for _ in 0..20 {
        let frame = client.frame(|_| true);
        assert_eq!(frame["tick"], json!(tick + 10));
        // The samples go on: the board is not silent.
        assert_eq!(frame["frame"]["status"], "ok");
    }
}

#[test]
fn a_path_is_followed_and_what_a_board_says_is_recorded() {
    let (_board, view) = with_board("box-flat");
    let mut client = view.client();
    client.done(json!({"type": "record", "value": true}));
    lead(&mut client, [0.0, 0.07, 0.0], [0.0, 0.04, 0.0]);
    let last = lead(&mut client, [0.0, 0.04, 0.0], [0.03, 0.04, 0.0]);
    client.done(json!({"type": "record", "value": false}));
    client.state(|state| !state["recorded"].is_null());
    let records = records(&text(&view.get("/recording/trace.jsonl")));
    assert!(records.iter().any(|record| *record == last["frame"]));
    let times: Vec<f64> = records.iter().filter_map(|r| r["t"].as_f64()).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    // Of every sample, from the first on, but those that were overtaken.
    let hand = text(&view.get("/recording/hand.csv"));
    let sampled: Vec<f64> = hand
        .lines()
        .filter_map(|line| line.split(',').next()?.parse().ok())
        .collect();
    assert_eq!(sampled.first(), Some(&0.0));
    assert!(times.iter().all(|time| sampled.contains(time)));
    assert!(2 * times.len() > sampled.len(), "{times:?} of {sampled:?}");
    client.done(json!({"type": "replay", "what": "recording"}));
    let replayed = with_hand(&mut client, [0.03, 0.04, 0.0]);
    // In the hand that was recorded; where samples were overtaken it slips elsewhere, by less than friction holds it back.
    let (a, b) = (&last["frame"]["pose"], &replayed["frame"]["pose"]);
    assert!((numbers(a)[0] - numbers(b)[0]).abs() < 2.0 * 0.005);
    let error = client.ask(json!({"type": "seek", "seconds": 0.0}));
    assert!(error.is_err_and(|error| error.contains("allowed: a reset")));
}

#[test]
fn what_a_board_said_is_what_this_computer_runs_where_no_sample_was_overtaken() {
    // A slow machine gets more time for every sample.
    let compared = [0.5, 0.1, 0.02].into_iter().any(|speed| {
        let (_board, view) = with_board("box-flat");
        let mut client = view.client();
        client.done(json!({"type": "speed", "value": speed}));
        client.done(json!({"type": "record", "value": true}));
        for (pose, ticks) in [([0.0, 0.04, 0.0], 60), ([0.03, 0.04, 0.1], 120)] {
            client.say(&json!({"type": "hand", "pose": pose, "held": true}));
            client.frame(|frame| frame["tick"].as_u64() > Some(ticks));
        }
        client.done(json!({"type": "record", "value": false}));
        client.state(|state| !state["recorded"].is_null());
        let folder = Folder::new();
        for name in ["scene.toml", "hand.csv", "trace.jsonl"] {
            folder.write(name, text(&view.get(&format!("/recording/{name}"))));
        }
        let lines = |name| folder.read(name).lines().count();
        if lines("trace.jsonl") + 1 != lines("hand.csv") {
            return false;
        }
        folder.done("run scene.toml --hand hand.csv --out run.jsonl --quiet");
        let [recorded, run] = ["trace.jsonl", "run.jsonl"].map(|name| folder.read(name));
        assert!(recorded == run, "not the same bytes");
        true
    });
    assert!(compared, "samples were overtaken even in slow motion");
}

#[test]
fn changes_that_nobody_waits_for_are_made_one_after_the_other() {
    let (_board, view) = with_board("box-flat");
    let mut client = view.client();
    let changes = [
        json!({"type": "scene", "name": "vertex-stick-slip"}),
        json!({"type": "set", "parameters": {"stiffness_translation": 321.0}}),
        json!({"type": "set", "parameters": {"static": 0.75}}),
        json!({"type": "evolution", "value": "frame"}),
        json!({"type": "record", "value": true}),
        json!({"type": "record", "value": false}),
    ];
    for (id, mut message) in (100..).zip(changes) {
        message["id"] = json!(id);
        client.say(&message);
    }
    for id in 100..106 {
        let answer = client.until(|message| message["id"] == json!(id));
        assert_eq!(answer["type"], "done", "{answer}");
    }
    let state = client.state(|state| !state["recorded"].is_null());
    assert_eq!(state["scene"]["title"], "vertex-stick-slip");
    assert_eq!(state["parameters"]["stiffness_translation"], 321.0);
    assert_eq!(state["parameters"]["static"], 0.75);
    assert_eq!(state["evolution"], "frame");
    assert!(state["recording"].is_null());
}

#[test]
fn a_change_that_makes_the_body_slip_counts_the_slip_once() {
    let slips_of = |view: &View| {
        let mut client = view.client();
        lead(&mut client, [0.0, 0.07, 0.0], [0.0, 0.04, 0.0]);
        // T = 0.5 N of mu_s N = 2.5 N.
        let stuck = lead(&mut client, [0.0, 0.04, 0.0], [0.001, 0.04, 0.0]);
        assert_eq!(stuck["counts"]["slips"], 0);
        client.done(json!({"type": "set", "parameters": {"static": 0.05, "dynamic": 0.04}}));
        let slipped = client.frame(|frame| frame["frame"]["pose"][0].as_f64() > Some(1e-4));
        // What comes later would be counted by now.
        let tick = slipped["tick"].as_u64().expect("a tick");
        let later = client.frame(|frame| frame["tick"].as_u64() > Some(tick + 50));
        later["counts"]["slips"].as_u64()
    };
    let (_board, view) = with_board("box-flat");
    let on_board = slips_of(&view);
    assert_eq!(on_board, slips_of(&View::start("box-flat")));
    assert!(on_board > Some(0));
}

#[test]
fn steps_of_a_path_are_samples_each() {
    let (_board, view) = with_board("box-flat");
    let mut client = view.client();
    client.done(json!({"type": "pause", "value": true}));
    client.done(json!({"type": "replay", "what": "scene"}));
    client.done(json!({"type": "step", "ticks": 50}));
    client.done(json!({"type": "step", "ticks": 50}));
    let mut times = Vec::new();
    client.frame(|frame| {
        let rows = frame["strip"].as_array().expect("rows").iter();
        times.extend(rows.filter_map(|row| row[0].as_f64()));
        frame["frame"]["t"] == 0.1
    });
    times.dedup();
    // Some may have been overtaken.
    assert!(times.len() > 20, "{times:?}");
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
}

#[test]
fn an_echo_is_of_the_answered_hand() {
    let (_board, view) = with_board("box-flat");
    let mut client = view.client();
    let height = |frame: &Value| numbers(&frame["frame"]["hand"])[1];
    let mut last = height(&client.frame(|_| true));
    for k in 1..50 {
        let pose = [0.0, 0.07 + 1e-4 * f64::from(k), 0.0];
        client.say(&json!({"type": "hand", "pose": pose, "held": true, "sent": k}));
        let frame = client.frame(|frame| frame["echo"] == json!(k));
        // It has begun to go there, from wherever it was.
        let now = height(&frame);
        assert!(last < now && now <= pose[1] + 1e-6, "{k}: {last} {now}");
        last = now;
    }
}

#[test]
fn the_reference_beside_a_board_of_fixed_point() {
    let folder = Folder::new();
    let _board = Board::fixed(&folder.file("line"));
    let view = View::in_folder(folder, "box-flat --socket line");
    let mut client = view.client();
    assert_eq!(client.state(|_| true)["number"], "fixed");
    let frame = lead(&mut client, [0.0, 0.07, 0.0], [0.0, 0.04, 0.0]);
    let error = numbers(&frame["reference"]["error"]);
    assert!(error[0] < 1e-4 && error[1] < 1e-3, "{error:?}");
}
