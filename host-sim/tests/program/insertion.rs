//! Whitney's meter in what a run leaves: traces, summary, plots; and nothing of it where there is no peg in a hole.

use crate::command::assert_same;
use crate::common::{Folder, numbers, records, text};
use serde_json::Value;
use std::collections::BTreeSet;

/// A bundled scene with a peg and a hole, with fewer frames.
fn run(folder: &Folder, options: &str) -> String {
    folder.done(&format!("run peg-in-hole --rate 100 {options}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The hand's force and moment are what the walls bear, where nothing else holds the peg.
#[test]
fn the_load_on_the_walls_is_that_of_the_hand() {
    let folder = Folder::new();
    let (k_h, mouth) = (1000.0, -0.003);
    for (name, bound) in [("f64", 1e-9), ("f32", 1e-3), ("fixed", 1e-3)] {
        run(&folder, &format!("--number {name} --out trace.jsonl"));
        let trace = records(&folder.read("trace.jsonl"));
        let mut compared = 0;
        for record in &trace {
            let [pose, wrench, hand] = ["pose", "wrench", "hand"].map(|key| numbers(&record[key]));
            let (sin, cos) = f64::sin_cos(pose[2]);
            // The tip is 0.035 below the body's origin and 0.02 wide.
            let tip = [pose[0] + 0.035 * sin, pose[1] - 0.035 * cos];
            let depth = mouth - tip[1] - 0.01 * sin.abs();
            let Some(found) = record.get("insertion") else {
                assert!(depth < 1e-6, "{record}");
                continue;
            };
            assert!((number(&found["depth"]) - depth).abs() < 1e-6, "{record}");
            if depth > 0.0469 {
                continue;
            }
            compared += 1;
            let holding = [0, 1].map(|axis| hand[axis] - wrench[axis] / k_h);
            let arm = [holding[0] - tip[0], holding[1] - tip[1]];
            let expected = [
                cos * wrench[0] + sin * wrench[1],
                sin * wrench[0] - cos * wrench[1],
                wrench[2] + arm[0] * wrench[1] - arm[1] * wrench[0],
            ];
            for (key, expected) in ["fx", "fz", "m"].into_iter().zip(expected) {
                let value = number(&found[key]);
                assert!(
                    (value - expected).abs() < bound,
                    "{name} {key}: {value}, {expected}: {record}"
                );
            }
            let contacts = record["contacts"].as_array().expect("contacts");
            let walls: BTreeSet<_> = contacts.iter().map(|c| c["obstacle"].as_str()).collect();
            let verdict = ["free", "one-point", "two-point"][walls.len()];
            assert_eq!(found["verdict"], verdict, "{record}");
        }
        assert!(compared > 700, "{compared}");
    }
}

#[test]
fn a_table_has_the_columns_of_the_meter_only_where_there_is_one() {
    let folder = Folder::new();
    run(&folder, "--out trace.csv");
    run(&folder, "--out trace.jsonl");
    let (table, trace) = (
        folder.read("trace.csv"),
        records(&folder.read("trace.jsonl")),
    );
    let header = assert_same(&table, &trace);
    let keys = ["depth", "fx", "fz", "m", "lambda", "margin", "verdict"];
    let begin = header.len() - keys.len();
    assert_eq!(header[begin..], keys.map(|key| format!("insertion_{key}")));
    let readings = trace
        .iter()
        .filter(|record| record.get("insertion").is_some());
    assert!(readings.count() > 800);
    for scene in ["hook", "box-flat"] {
        folder.done(&format!("run {scene} --rate 20 --out other.csv"));
        let other = folder.read("other.csv");
        assert!(!other.contains("insertion"), "{scene}");
    }
}

#[test]
fn a_replay_has_the_same_readings() {
    let folder = Folder::new();
    run(&folder, "--record run.jsonl --out first.jsonl");
    folder.done("replay run.jsonl --out again.jsonl");
    assert_eq!(folder.read("first.jsonl"), folder.read("again.jsonl"));
}

#[test]
fn summary_and_plots_show_the_insertion_only_where_there_is_one() {
    let folder = Folder::new();
    let words = run(&folder, "--plot plots");
    let lines = [
        "deepest insertion     47.000 mm",
        "largest F_z",
        "first two points",
        "frames jammed",
        "least margin",
    ];
    for line in lines {
        assert!(words.contains(line), "{line}: {words}");
    }
    let picture = folder.read("plots/insertion.svg");
    for shown in [
        "Fx / Fz",
        "M / (r Fz)",
        "depth l [mm]",
        "small angles, two points",
        "l = 47 mm",
    ] {
        assert!(picture.contains(shown), "{shown}");
    }
    let output = folder.stiction("run plank-on-posts --rate 20 --plot others");
    let words = text(&output.stdout);
    assert!(
        output.status.success() && !words.contains("insertion"),
        "{words}"
    );
    assert!(!folder.file("others/insertion.svg").exists());
}

#[test]
fn a_peg_that_never_gets_into_its_hole_is_said_to() {
    let folder = Folder::new();
    folder.write(
        "hand.csv",
        "t,x,y,phi\n0,0.0008,0.065,0.005\n1,0.0008,0.06,0.005\n",
    );
    let words = run(&folder, "--hand hand.csv --plot plots");
    assert!(words.contains("the peg is never in its hole"), "{words}");
    assert!(folder.file("plots/insertion.svg").exists());
}
