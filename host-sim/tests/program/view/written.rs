//! Scenes of a client's own: sent as files, changed in place, saved; and the file of the command line, which is shown anew whenever it is
//! edited.

use serde_json::{Value, json};

use super::program::{Answer, Client, View};
use crate::common::{Folder, numbers, text};

/// A rod that falls on a floor, with a hand that rests.
const ROD: &str = "# A rod of somebody's own.\n[body]\nvertices = [[-0.1, 0.0], [0.1, 0.0]]\nstart = [0.0, 0.2, 0.3]\nweight = 2.0\n\
    [grasp]\npoint = [0.0, 0.0]\n[spring]\ntranslation = 300.0\nrotation = 0.4\n\
    [[surface]]\nname = \"ice\"\nnormal = [0.0, 1.0]\noffset = 0.0\nstatic = 0.1\ndynamic = 0.05\n\
    [hand]\nrate = 100.0\nkeyframes = [\n  [0.0, 0.0, 0.2, 0.3], # at rest\n  [1.0, 0.05, 0.1, 0.3],\n]\n";

fn post(view: &View, path: &str, body: &str) -> Answer {
    view.http("POST", path, "", body.as_bytes())
}

/// What an answer says is wrong.
fn refusal(answer: &Answer) -> String {
    assert_eq!(answer.status, 400, "{}", text(&answer.body));
    let body: Value = serde_json::from_slice(&answer.body).expect("JSON");
    body["message"].as_str().expect("a message").to_owned()
}

/// The scene of this title is shown.
fn shown(client: &mut Client, title: &str) -> Value {
    client.state(|state| state["scene"]["title"] == title)
}

/// The scene that is shown is a file that `stiction run` takes; its text.
fn run_shown(view: &View) -> String {
    let scene = text(&view.get("/scene.toml"));
    let folder = Folder::new();
    folder.write("shown.toml", &scene);
    let output = folder.stiction("run shown.toml --quiet");
    assert!(output.status.success(), "{}\n{scene}", text(&output.stderr));
    scene
}

#[test]
fn a_scene_that_is_sent_is_shown_and_stays_among_those_to_choose_from() {
    let view = View::start("ladder");
    let mut client = view.client();
    let answer = post(&view, "/scene?name=folder%2Frod.toml", ROD);
    assert_eq!(text(&answer.body), r#"{"scene":"rod"}"#);
    let state = shown(&mut client, "rod");
    assert_eq!(state["scene"]["weight"], 2.0);
    assert!(
        state["scenes"]
            .as_array()
            .expect("a list")
            .contains(&json!("rod"))
    );
    client.frame(|frame| frame["frame"]["held"] == true);
    assert_eq!(run_shown(&view), ROD);
    client.done(json!({"type": "scene", "name": "ladder"}));
    client.done(json!({"type": "scene", "name": "rod"}));
    // The name of a bundled scene stays with that.
    assert_eq!(
        text(&post(&view, "/scene?name=hook.toml", ROD).body),
        r#"{"scene":"my-hook"}"#
    );
    shown(&mut client, "my-hook");
    // What is refused names the line, and changes nothing.
    let broken = ROD.replace("rotation = 0.4", "rotation = -0.4");
    let problem = refusal(&post(&view, "/scene?name=rod.toml", &broken));
    assert!(
        problem.contains("rod.toml, line 10: `spring.rotation` is -0.4"),
        "{problem}"
    );
    let unknown = ROD.replace("[hand]", "[hand]\nreach = 1.0");
    assert!(refusal(&post(&view, "/scene?name=rod.toml", &unknown)).contains("line 18"));
    assert_eq!(view.state()["scene"]["title"], "my-hook");
    let large = format!("{ROD}#{}", "x".repeat(1 << 20));
    assert_eq!(post(&view, "/scene?name=rod.toml", &large).status, 413);
    assert_eq!(post(&view, "/scene", ROD).status, 400);
    // Who can reach the program cannot have it open a file.
    let begin = ROD.find("keyframes").expect("keyframes");
    let path = format!("{}path = \"/etc/passwd\"\n", &ROD[..begin]);
    assert_eq!(post(&view, "/scene?name=far.toml", &path).status, 200);
    client.state(|state| state["scene"]["title"] == "far");
    assert!(
        client
            .ask(json!({"type": "replay", "what": "scene"}))
            .is_err()
    );
}

/// What the editor sends of box-flat, with another start, weight and friction, and an obstacle.
fn edit() -> Value {
    json!({
        "body": {"vertices": [[-0.05, -0.03], [0.05, -0.03], [0.0, 0.05]], "start": [0.02, 0.06, 0.0], "weight": 1.5},
        "grasp": {"point": [0.0, 0.02], "reach": 0.0},
        "spring": {"translation": 400.0, "rotation": 0.5},
        "surface": [{"name": "floor", "normal": [0.0, 2.0], "offset": 0.0, "static": 0.9, "dynamic": 0.7, "memory": null}],
        "obstacle": [{"name": "post", "vertices": [[0.2, 0.0], [0.25, 0.0], [0.25, 0.1]], "static": 0.4, "dynamic": 0.2, "memory": 1e-5}],
    })
}

#[test]
fn an_edit_changes_the_scene_and_moves_the_hands_path_with_the_holding_point() {
    let view = View::start("box-flat");
    let mut client = view.client();
    let before = client.state(|_| true);
    let answer = post(&view, "/edit?name=box-flat", &edit().to_string());
    assert_eq!(text(&answer.body), r#"{"scene":"my-box-flat"}"#);
    let state = shown(&mut client, "my-box-flat");
    let (scene, old) = (&state["scene"], &before["scene"]);
    assert_eq!(scene["surfaces"][0]["normal"], json!([0.0, 1.0]));
    assert_eq!(scene["surfaces"][0]["static"], 0.9);
    assert_eq!(
        scene["obstacles"][0]["vertices"],
        edit()["obstacle"][0]["vertices"]
    );
    assert_eq!(state["parameters"]["stiffness_translation"], 400.0);
    // The holding point was at (0, 0.05 + 0.02) and is at (0.02, 0.06 + 0.02).
    for (axis, by) in [(0, 0.02), (1, 0.01)] {
        let [now, then] = [scene, old].map(|scene| scene["home"][axis].as_f64().expect("a number"));
        assert!((now - then - by).abs() < 1e-12, "{now} {then}");
    }
    let saved = run_shown(&view);
    // A file that is opened again is the same scene.
    post(&view, "/scene?name=again.toml", &saved);
    let mut again = shown(&mut client, "again")["scene"].clone();
    again["title"] = scene["title"].clone();
    assert_eq!(&again, scene);
    let mut wrong = edit();
    wrong["body"]["vertices"] = json!([[0.0, 0.0], [1.0, 0.0], [0.2, 0.2], [0.0, 1.0]]);
    let problem = refusal(&post(&view, "/edit?name=x", &wrong.to_string()));
    assert!(problem.contains("`body.vertices["), "{problem}");
    wrong = edit();
    wrong["surface"][0]["mass"] = json!(1.0);
    assert!(refusal(&post(&view, "/edit?name=x", &wrong.to_string())).contains("mass"));
    assert_eq!(view.state()["scene"]["title"], "again");
}

#[test]
fn a_reset_restores_the_parameters_where_it_says_so_and_defaults_leave_the_body() {
    let view = View::start("box-flat");
    let mut client = view.client();
    let file = client.state(|_| true)["parameters"].clone();
    let changed =
        json!({"type": "set", "parameters": {"static": 0.9, "stiffness_translation": 800.0}});
    client.done(changed.clone());
    assert!(run_shown(&view).contains("translation = 800.0"));
    client.done(json!({"type": "reset"}));
    client.state(|state| state["parameters"]["static"] == 0.9);
    client.done(json!({"type": "reset", "parameters": true}));
    client.state(|state| state["parameters"] == file);
    client.done(changed);
    client.lead([0.0, 0.07, 0.0], [0.0, 0.09, 0.0], 20);
    let lifted = client.frame(|_| true)["frame"]["pose"].clone();
    client.done(json!({"type": "defaults"}));
    client.state(|state| state["parameters"] == file);
    let pose = client.frame(|_| true)["frame"]["pose"].clone();
    for (now, then) in numbers(&pose).iter().zip(numbers(&lifted)) {
        // The digits of f32 at 0.1 m.
        assert!((now - then).abs() < 1e-7, "{pose} {lifted}");
    }
}

#[test]
fn a_file_that_is_edited_is_shown_anew_and_a_broken_one_is_reported_with_its_line() {
    let folder = Folder::new();
    folder.write("mine.toml", ROD);
    let mut view = View::in_folder(folder, "mine.toml");
    let mut client = view.client();
    assert_eq!(client.state(|_| true)["scene_problem"], Value::Null);
    view.folder()
        .write("mine.toml", ROD.replace("weight = 2.0", "weight = 3.0"));
    client.state(|state| state["scene"]["weight"] == 3.0);
    view.folder().write(
        "mine.toml",
        ROD.replace("weight = 2.0", "weight = \"much\""),
    );
    let state = client.state(|state| state["scene_problem"] != Value::Null);
    let problem = state["scene_problem"].as_str().expect("a text");
    assert!(
        problem.contains("mine.toml, line 5: `body.weight` is "),
        "{problem}"
    );
    assert_eq!(state["scene"]["weight"], 3.0);
    assert!(view.line().contains("line 5"));
    view.folder().write("mine.toml", ROD);
    client.state(|state| state["scene"]["weight"] == 2.0 && state["scene_problem"] == Value::Null);
}
