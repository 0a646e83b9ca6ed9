//! Obstacles from the scene file to what a run leaves: contacts in JSON Lines and CSV, replays, sweeps, plots; and where they are not
//! taken.

use std::sync::LazyLock;

use crate::command::assert_same;
use crate::common::{Folder, numbers, with_hand};
use serde_json::Value;

/// A box over the edge of a table: two contacts, of a vertex on the table's top and of the table's corner on the box's lower side; a floor
/// far below.
static SCENE: LazyLock<String> = LazyLock::new(|| {
    let hand = "rate = 20.0\nkeyframes = [[0.0, -0.02, 0.05, 0.0], [1.0, -0.02, 0.045, 0.0], [2.0, -0.02, 0.08, 0.0], \
                [3.0, -0.02, 0.05, 0.02]]";
    let table =
        "name = \"table\"\nvertices = [[-0.50, -0.04], [0.0, -0.04], [0.0, 0.0], [-0.50, 0.0]]";
    let scene = with_hand(hand).replace(
        "[[surface]]\nname = \"wall\"",
        &format!("[[obstacle]]\n{table}"),
    );
    let scene = scene
        .replace("normal = [1.0, 0.0]\noffset = 0.0\n", "")
        .replace("offset = 0.0", "offset = -1.0");
    let scene = scene
        .replace("weight = 0.0", "weight = 3.0")
        .replace("reach = 0.01\n", "");
    scene.replace("start = [0.2, 0.12, 0.5]", "start = [-0.02, 0.03, 0.0]")
});

fn contacts(trace: &[Value]) -> Vec<&Value> {
    let contacts = trace
        .iter()
        .filter_map(|record| record["contacts"].as_array());
    contacts.flatten().collect()
}

#[test]
fn a_contact_tells_the_obstacle_its_side_and_where_it_faces() {
    let folder = Folder::new();
    for number in ["f64", "f32", "fixed"] {
        let trace = folder.trace(&SCENE, &format!("--number {number}"));
        assert_eq!(trace.len(), 61);
        let contacts = contacts(&trace);
        assert!(!contacts.is_empty());
        for contact in contacts {
            assert_eq!(contact["obstacle"], "table");
            assert!(contact.get("surface").is_none(), "{contact}");
            let [of_vertex, of_corner] = [["vertex", "side"], ["corner", "body_side"]]
                .map(|keys| keys.map(|key| contact[key].is_u64()));
            assert_eq!(of_vertex, of_corner.map(|is_there| !is_there), "{contact}");
            assert_eq!(of_vertex[0], of_vertex[1], "{contact}");
            let direction = numbers(&contact["direction"]);
            let length = direction[0].hypot(direction[1]);
            assert!((length - 1.0).abs() < 1e-6, "{contact}");
        }
    }
}

/// Among obstacles a contact with a half-plane has its direction, too.
#[test]
fn a_half_plane_among_obstacles_faces_its_normal() {
    let folder = Folder::new();
    let scene = SCENE.replace("offset = -1.0", "offset = 0.0");
    let scene = scene.replace(
        "[[-0.50, -0.04], [0.0, -0.04], [0.0, 0.0], [-0.50, 0.0]]",
        "[[0.5, 0.5]]",
    );
    let trace = folder.trace(&scene, "");
    let contacts = contacts(&trace);
    assert!(!contacts.is_empty());
    for contact in contacts {
        assert_eq!(contact["surface"], "floor");
        assert_eq!(numbers(&contact["direction"]), [0.0, 1.0]);
    }
    // Without obstacles there is no such key.
    let pin = scene.find("[[obstacle]]").zip(scene.find("[hand]"));
    let (from, to) = pin.expect("both");
    let alone = folder.trace(&(scene[..from].to_owned() + &scene[to..]), "");
    for (alone, among) in alone.iter().zip(&trace) {
        let mut among = among.clone();
        for contact in among["contacts"].as_array_mut().expect("contacts") {
            contact
                .as_object_mut()
                .expect("a contact")
                .remove("direction");
        }
        assert_eq!(*alone, among);
    }
}

#[test]
fn csv_carries_the_same_as_json_among_obstacles() {
    let folder = Folder::new();
    let json = folder.trace(&SCENE, "");
    folder.done("run scene.toml --out trace.csv");
    let table = folder.read("trace.csv");
    let begin = ",contacts,c0_vertex,c0_surface,c0_obstacle,c0_side,c0_corner,c0_body_side,c0_x,c0_y,c0_normal,c0_friction,\
                 c0_sliding,c0_direction_x,c0_direction_y,c1_vertex";
    let header = table.lines().next().expect("a header");
    assert!(header.contains(begin), "{header}");
    assert!(
        header.ends_with(",c3_direction_x,c3_direction_y"),
        "{header}"
    );
    assert_same(&table, &json);
    assert!(!contacts(&json).is_empty());
}

#[test]
fn a_recording_among_obstacles_gives_the_same_bits_again() {
    let folder = Folder::new();
    folder.write("scene.toml", &*SCENE);
    for number in ["f64", "f32", "fixed"] {
        folder.done(&format!(
            "run scene.toml --record run.jsonl --quiet --number {number}"
        ));
        let said = folder.done("replay run.jsonl --record again.jsonl");
        assert!(
            said.contains("61 of 61 frames compared, the same bits"),
            "{said}"
        );
        assert_eq!(folder.read("run.jsonl"), folder.read("again.jsonl"));
    }
}

/// A table beyond the range of fixed point is cut there, and keeps its name and its sides.
#[test]
fn a_table_that_goes_on_is_the_same_in_fixed_point() {
    let folder = Folder::new();
    let near = folder.trace(&SCENE, "--number fixed");
    let far = SCENE.replace("-0.50", "-50.0").replace("-0.04", "-30.0");
    let far = folder.trace(&far, "--number fixed");
    for (near, far) in near.iter().zip(&far) {
        let names = |record: &Value| -> Vec<_> {
            let contacts = record["contacts"].as_array().expect("contacts").iter();
            let keys = ["vertex", "obstacle", "side", "corner", "body_side"];
            contacts
                .map(|contact| keys.map(|key| contact[key].clone()))
                .collect()
        };
        assert_eq!(names(near), names(far));
    }
}

#[test]
fn a_sweep_varies_the_keys_of_an_obstacle() {
    let folder = Folder::new();
    folder.write("scene.toml", &*SCENE);
    folder.write(
        "sweep.toml",
        "scenes = [\"scene.toml\"]\n[vary]\nobstacle.table.static = [0.4, 0.6]\n\"obstacle.table.vertices.2.0\" = [0.0, 0.01]\n",
    );
    folder.done("sweep sweep.toml --quiet --out out.csv");
    let table = folder.read("out.csv");
    let mut lines = table.lines();
    let header = lines.next().expect("a header");
    assert!(
        header.starts_with("index,scene,obstacle.table.static,obstacle.table.vertices.2.0,status")
    );
    let rows: Vec<&str> = lines.collect();
    let begins = [
        "0,scene.toml,0.4,0.0,ok",
        "1,scene.toml,0.4,0.01,ok",
        "2,scene.toml,0.6,0.0,ok",
        "3,scene.toml,0.6,0.01,ok",
    ];
    assert_eq!(rows.len(), begins.len());
    for (row, begin) in rows.iter().zip(begins) {
        assert!(row.starts_with(begin), "{row}");
    }
}

#[test]
fn pictures_show_obstacles_with_their_names_and_corners_in_contact() {
    let folder = Folder::new();
    folder.write("scene.toml", &*SCENE);
    folder.done("run scene.toml --quiet --plot plots");
    for (picture, shown) in [
        ("trajectory", &["\ntable\n", "corners in contact"][..]),
        ("strip", &["\ntable\n"]),
        ("forces", &["table [N]"]),
        ("motion", &["vertices and corners in contact"]),
    ] {
        let svg = folder.read(&format!("plots/{picture}.svg"));
        for part in shown {
            assert!(svg.contains(part), "{picture}: {part}");
        }
    }
}

#[test]
fn commands_that_take_no_obstacles_say_so() {
    let folder = Folder::new();
    folder.write("scene.toml", &*SCENE);
    let line = SCENE.lines().position(|line| line == "[[obstacle]]");
    let place = format!(
        "scene.toml, line {}: there is an `[[obstacle]]`",
        line.expect("one") + 1
    );
    let allowed = "allowed: `[[surface]]` alone; `run`, `replay`, `check`, `sweep`, `board` and, without a board, `view` take obstacles";
    folder.refused(
        "view scene.toml --headless --socket absent",
        &[&place, allowed],
    );
}
