//! Every bundled scene and a recorded hand, frame by frame before the judge, `stiction check`, which knows the laws and nothing
//! of the solver; faults in real traces, which it must find; and a second judge, a program apart. That one and the recording lie
//! next to the workspace; if they are missing, the tests say so and skip these cases.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::common::{Folder, assert_error, records, text, with_hand};
use stiction_live::scenes;

const NUMBERS: [&str; 3] = ["f64", "f32", "fixed"];
const EVOLUTIONS: [&str; 2] = ["path", "frame"];

/// A file of the shared folder next to the workspace, if it exists.
fn shared(name: &str) -> Option<PathBuf> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../shared")
        .join(name);
    if !file.exists() {
        eprintln!("skipped: there is no {}", file.display());
    }
    file.canonicalize().ok()
}

/// Runs a scene to `trace.jsonl` and `trace.csv`.
fn run(folder: &Folder, scene: &str, number: &str, evolution: &str) {
    for trace in ["trace.jsonl", "trace.csv"] {
        folder.done(&format!(
            "run {scene} --number {number} --evolution {evolution} --out {trace}"
        ));
    }
}

/// The status and the report of `stiction check`, with options.
fn checked(folder: &Folder, trace: &str, scene: &str, options: &str) -> (Option<i32>, String) {
    let verdict = folder.stiction(&format!("check {trace} --scene {scene} {options}"));
    (verdict.status.code(), text(&verdict.stdout))
}

/// The trace of a scene after the judge has found every frame lawful, and the other judge, where it is.
fn judged(folder: &Folder, scene: &str, number: &str, evolution: &str) -> Vec<Value> {
    run(folder, scene, number, evolution);
    let trace = folder.read("trace.jsonl");
    let count = trace.lines().count();
    for file in ["trace.jsonl", "trace.csv"] {
        let dials = format!("--number {number} --evolution {evolution}");
        let (status, report) = checked(folder, file, scene, &dials);
        let case = format!("{scene} {number} {evolution}:\n{report}");
        assert_eq!(status, Some(0), "{case}");
        assert!(
            report.starts_with(&format!("{count} frames, 0 unlawful\n")),
            "{case}"
        );
    }
    let file = scene_file(folder, scene);
    // The other judge knows half-planes alone.
    let is_known = !fs::read_to_string(&file).is_ok_and(|text| text.contains("[[obstacle]]"));
    if let Some(judge) = shared("tools/judge.py").filter(|_| is_known) {
        // A trace in fixed point holds f32 values.
        let printed = if number == "fixed" { "f32" } else { number };
        let verdict = Command::new("python3")
            .arg(judge)
            .args([file, folder.file("trace.jsonl")])
            .args(["--number", printed])
            .output()
            .expect("python3 starts");
        let report = text(&verdict.stdout);
        assert!(
            verdict.status.success(),
            "{scene} {number} {evolution}:\n{report}"
        );
    }
    records(&trace)
}

/// The file of a scene in the folder, or of a bundled one.
fn scene_file(folder: &Folder, scene: &str) -> PathBuf {
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let own = folder.file(scene);
    if own.exists() {
        own
    } else {
        bundled.join(scene).with_extension("toml")
    }
}

#[test]
fn bundled_scenes_are_lawful_in_every_frame() {
    for (name, _) in scenes::ALL {
        for number in NUMBERS {
            for evolution in EVOLUTIONS {
                judged(&Folder::new(), name, number, evolution);
            }
        }
    }
}

/// The report on a trace after a change of the record in which `found` is true first.
fn report_after(
    scene: &str,
    found: impl Fn(&Value) -> bool,
    change: impl FnOnce(&mut Value),
) -> (Option<i32>, String) {
    let folder = Folder::new();
    run(&folder, scene, "f64", "path");
    let mut trace = records(&folder.read("trace.jsonl"));
    change(trace.iter_mut().find(|record| found(record)).expect("one"));
    let lines: Vec<String> = trace.iter().map(Value::to_string).collect();
    folder.write("trace.jsonl", lines.join("\n"));
    checked(&folder, "trace.jsonl", scene, F64)
}

fn slips(record: &Value) -> bool {
    record["slips"] == 1
}

/// The names of the laws that a report finds broken.
fn broken(report: &str) -> Vec<&str> {
    let listed = report.lines().filter(|line| line.starts_with("  line "));
    listed.filter_map(|line| line.split(": ").nth(1)).collect()
}

#[test]
fn faults_in_real_traces_are_found() {
    let all = |_: &Value| true;
    let without_events = |record: &mut Value| {
        record["events"] = Value::Array(Vec::new());
        record["slips"] = 0.into();
    };
    let other_moment = |record: &mut Value| record["wrench"][2] = 0.1.into();
    let no_time = |record: &mut Value| record["t"] = Value::Null;
    for ((status, report), law) in [
        (
            report_after("vertex-stick-slip", slips, without_events),
            "a contact that sticks stays",
        ),
        (
            report_after("ladder", all, other_moment),
            "the wrench is that of the springs",
        ),
        (report_after("snap", all, no_time), "every number is finite"),
    ] {
        assert_eq!((status, broken(&report)[0]), (Some(1), law), "{report}");
        assert!(
            law.starts_with("a contact") || broken(&report).len() == 1,
            "{report}"
        );
    }
}

const F64: &str = "--number f64";
const OF_HAND: &str = "the hand is that of its path";

#[test]
fn a_hand_that_is_not_that_of_its_path_is_found() {
    let moved = |record: &mut Value| {
        let x = record["hand"][0].as_f64().expect("a number");
        record["hand"][0] = (x + 1e-9).into();
    };
    let (status, report) = report_after("vertex-stick-slip", slips, moved);
    assert_eq!(status, Some(1));
    assert!(broken(&report).contains(&OF_HAND), "{report}");
}

#[test]
fn the_hand_is_compared_with_the_path_that_is_given() {
    let folder = Folder::new();
    folder.done("run ladder --number f64 --out trace.jsonl --rate 500");
    folder.write("hand.csv", "t,x,y,phi,held\n0,0,0.5,0,1\n10,0,0.5,0,1\n");
    // Its frames, its path at its own times, another path, frames that it does not have.
    for (options, expected) in [
        ("--rate 500", 0),
        ("", 0),
        ("--rate 200", 1),
        ("--hand hand.csv --rate 500", 1),
    ] {
        let options = format!("{F64} {options}");
        let (status, report) = checked(&folder, "trace.jsonl", "ladder", &options);
        assert_eq!(status, Some(expected), "{report}");
        assert!(report.contains(OF_HAND), "{report}");
        assert_eq!(
            broken(&report).contains(&OF_HAND),
            expected == 1,
            "{report}"
        );
    }
}

/// A trace at another rate than the scene's has its hand at times that the scene's frames do not have.
#[test]
fn a_trace_at_any_rate_is_compared_at_its_own_times() {
    for rate in ["200", "333.3", "1000", "1700"] {
        let folder = Folder::new();
        folder.done(&format!("run ladder --rate {rate} --out trace.jsonl"));
        let (status, report) = checked(&folder, "trace.jsonl", "ladder", "");
        assert_eq!(status, Some(0), "{report}");
        let remark = "the hand was compared at the times of the trace";
        assert_eq!(report.contains(remark), rate != "1000", "{report}");
        let moved = folder
            .read("trace.jsonl")
            .replace("\"hand\":[", "\"hand\":[1");
        folder.write("trace.jsonl", moved);
        let (status, report) = checked(&folder, "trace.jsonl", "ladder", "--worst 10000");
        assert_eq!(status, Some(1), "{report}");
        assert!(broken(&report).contains(&OF_HAND), "{report}");
    }
}

/// Nothing but a hand that turns: its angle is turns and a rest, each rounded.
#[test]
fn a_hand_that_turns_three_times_is_lawful_in_every_number_type() {
    let hand = "rate = 100.0\nkeyframes = [[0.0, 0.2, 0.3, 0.5], [5.0, 0.2, 0.3, 20.0], [9.0, 0.2, 0.3, -7.0]]";
    let scene = with_hand(hand).replace("start = [0.2, 0.12, 0.5]", "start = [0.2, 0.3, 0.5]");
    for number in NUMBERS {
        let folder = Folder::new();
        folder.write("scene.toml", &scene);
        judged(&folder, "scene.toml", number, "path");
    }
}

#[test]
fn what_was_not_compared_is_reported() {
    let folder = Folder::new();
    run(&folder, "ladder", "f64", "path");
    let (status, report) = checked(&folder, "trace.jsonl", "ladder", "--number f64 --hand none");
    assert_eq!(status, Some(0));
    let none = "the hand was not compared with a path: --hand none";
    assert!(
        report.contains(none) && !report.contains(OF_HAND),
        "{report}"
    );
    let whole = folder.read("trace.jsonl");
    let count = whole.lines().count();
    let begin: Vec<&str> = whole.lines().take(count - 7).collect();
    folder.write("trace.jsonl", begin.join("\n"));
    let (status, report) = checked(&folder, "trace.jsonl", "ladder", F64);
    assert_eq!(status, Some(0));
    let left = "the hand's path has 7 more samples than the trace";
    assert!(report.contains(left), "{report}");
}

/// A body that stays where it was excuses nothing by a status, which is reported.
#[test]
fn statuses_are_counted_and_excuse_nothing() {
    let folder = Folder::new();
    run(&folder, "box-flat", "f64", "path");
    let mut trace = records(&folder.read("trace.jsonl"));
    let frozen = trace[9].clone();
    for record in &mut trace[10..] {
        for key in ["pose", "contacts", "state", "wrench"] {
            record[key] = frozen[key].clone();
        }
        record["status"] = "ambiguous".into();
        record["events"] = Value::Array(Vec::new());
        record["slips"] = 0.into();
    }
    let count = trace.len() - 10;
    let lines: Vec<String> = trace.iter().map(Value::to_string).collect();
    folder.write("trace.jsonl", lines.join("\n"));
    let (status, report) = checked(&folder, "trace.jsonl", "box-flat", F64);
    assert_eq!(status, Some(1));
    let counted = format!("{:<45}{count:>10}", "ambiguous");
    assert!(report.contains(&counted), "{report}");
    let borne = "a status is borne out by its frame";
    assert!(report.contains(borne), "{report}");
}

/// Slips begin where static friction is exceeded, between frames as well: those of the same scene with a little more of it, which
/// come later by a part of a frame, end at the wrong place.
#[test]
fn slips_that_come_late_are_found() {
    for scene in ["vertex-stick-slip", "box-flat"] {
        let folder = Folder::new();
        let text_of = fs::read_to_string(scene_file(&folder, scene)).expect("a bundled scene");
        let (given, more) = ("static = 0.5\n", "static = 0.5005\n");
        assert!(text_of.contains(given), "{scene}");
        folder.write("late.toml", text_of.replace(given, more));
        run(&folder, "late.toml", "f64", "path");
        let all = format!("{F64} --worst 1000");
        let (status, report) = checked(&folder, "trace.jsonl", scene, &all);
        assert_eq!(status, Some(1), "{report}");
        let end = "a slip ends at ";
        let broken = broken(&report);
        assert!(
            broken.iter().any(|broken| broken.starts_with(end)),
            "{report}"
        );
        // Where a frame comes between the one limit and the other one, nothing holds the body by the other one.
        let others = [
            "friction is in its cone",
            "jammed is what 64 k_h L cannot hold",
        ];
        assert!(
            (broken.iter()).all(|broken| broken.starts_with(end) || others.contains(broken)),
            "{report}"
        );
    }
}

/// The hand lets go and takes hold elsewhere, twice.
#[test]
fn new_holds_are_lawful() {
    let hand = "rate = 100.0\nkeyframes = [[0.0, 0.2, 0.14, 0.5, 0], [0.1, 0.2, 0.14, 0.5, 1], [1.0, 0.2, 0.06, 0.5, 1], \
                [1.1, 0.2, 0.06, 0.5, 0], [1.5, 0.19, 0.05, 0.1, 0], [1.6, 0.19, 0.05, 0.1, 1], [2.6, 0.1, 0.04, 0.3, 1]]\n";
    let given = with_hand(hand);
    for scene in [given.clone(), given.replace("point = [0.0, 0.02]\n", "")] {
        for number in NUMBERS {
            for evolution in EVOLUTIONS {
                let folder = Folder::new();
                folder.write("scene.toml", &scene);
                run(&folder, "scene.toml", number, evolution);
                let trace = folder.read("trace.jsonl");
                assert!(trace.contains("release") && trace.contains("grasp"));
                let dials = format!("--number {number} --evolution {evolution}");
                let (status, report) = checked(&folder, "trace.jsonl", "scene.toml", &dials);
                assert_eq!(status, Some(0), "{report}");
            }
        }
    }
}

#[test]
fn input_that_cannot_be_judged_ends_with_status_2() {
    let folder = Folder::new();
    folder.write("empty.jsonl", "");
    folder.write("broken.jsonl", "{\"t\":0.0\n");
    for (arguments, expected) in [
        (
            "empty.jsonl --scene ladder",
            "empty.jsonl: there is no record in it",
        ),
        ("broken.jsonl --scene ladder", "broken.jsonl, line 1: "),
        (
            "absent.jsonl --scene ladder",
            "absent.jsonl: cannot be read",
        ),
        (
            "empty.jsonl --scene nowhere",
            "nowhere: no such file, allowed: a scene file, or one of ",
        ),
    ] {
        let output = folder.stiction(&format!("check {arguments}"));
        assert!(output.stdout.is_empty());
        assert_error(arguments, &output, &[expected]);
    }
}

/// A box in the corner of floor and wall, in a hand that was recorded by motion capture.
fn in_recorded_hand() -> String {
    let hand = "path = \"hand.txt\"\nplane = \"xy\"\nscale = 0.1\norigin = [-0.075, -0.01, -1.386]";
    let scene = with_hand(hand).replace("[0.2, 0.12, 0.5]", "[0.10, 0.10, 0.0]");
    scene.replace("reach = 0.01\n", "")
}

#[test]
fn a_recorded_hand_moves_the_box_lawfully() {
    let Some(hand) = shared("data/tum-freiburg1-xyz-groundtruth.txt") else {
        return;
    };
    let folder = Folder::new();
    folder.write("scene.toml", in_recorded_hand());
    folder.write("hand.txt", fs::read(hand).expect("the recording"));
    for number in NUMBERS {
        for evolution in EVOLUTIONS {
            let trace = judged(&folder, "scene.toml", number, evolution);
            assert_eq!(trace.len(), 3000);
            for surface in ["floor", "wall"] {
                let on_it = |contact: &Value| contact["surface"] == surface;
                let touching = |record: &&Value| {
                    let contacts = record["contacts"].as_array();
                    contacts.is_some_and(|contacts| contacts.iter().any(on_it))
                };
                let count = trace.iter().filter(touching).count();
                assert!(
                    count > 600,
                    "{surface} in {count} frames, {number} {evolution}"
                );
            }
        }
    }
}
