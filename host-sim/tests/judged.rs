//! Every bundled scene and a recorded hand, frame by frame before the judge: a program apart that knows the laws and
//! nothing of the solver. Both judge and recording lie beside the workspace; without them the tests say so and pass.

mod common;

use std::path::{Path, PathBuf};
use std::process::Command;

use common::{Folder, records, text};

const NUMBERS: [&str; 3] = ["f64", "f32", "fixed"];
const EVOLUTIONS: [&str; 2] = ["path", "frame"];

/// A file of the folder that is shared beside the workspace, if it is there.
fn shared(name: &str) -> Option<PathBuf> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../shared")
        .join(name);
    if !file.exists() {
        eprintln!("skipped: there is no {}", file.display());
    }
    file.canonicalize().ok()
}

/// Runs a scene and returns its trace after the judge has found every frame lawful.
fn judged(judge: &Path, scene: &Path, number: &str, evolution: &str) -> String {
    let folder = Folder::new();
    let name = scene.to_string_lossy();
    let arguments = [
        "run",
        &name,
        "--number",
        number,
        "--evolution",
        evolution,
        "--out",
        "trace.jsonl",
    ];
    let output = folder.stiction(&arguments);
    assert!(output.status.success(), "{name}: {}", text(&output.stderr));
    // A trace in fixed point holds f32 values.
    let printed = if number == "fixed" { "f32" } else { number };
    let verdict = Command::new("python3")
        .arg(judge)
        .args([scene, &folder.file("trace.jsonl")])
        .args(["--number", printed])
        .output()
        .expect("python3 starts");
    assert!(
        verdict.status.success(),
        "{name} {number} {evolution}:\n{}",
        text(&verdict.stdout)
    );
    folder.read("trace.jsonl")
}

#[test]
fn bundled_scenes_are_lawful_in_every_frame() {
    let Some(judge) = shared("tools/judge.py") else {
        return;
    };
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    for (name, _) in stiction_host_sim::scenes::ALL {
        for number in NUMBERS {
            for evolution in EVOLUTIONS {
                judged(
                    &judge,
                    &scenes.join(name).with_extension("toml"),
                    number,
                    evolution,
                );
            }
        }
    }
}

/// A box in the corner of floor and wall, in a hand that was recorded by motion capture.
const RECORDED: &str = r#"
[body]
rectangle = [0.10, 0.06]
start = [0.10, 0.10, 0.0]

[grasp]
point = [0.0, 0.02]

[spring]
translation = 500.0
rotation = 0.5

[friction]
static = 0.5
dynamic = 0.3

[[surface]]
name = "floor"
normal = [0.0, 1.0]
offset = 0.0

[[surface]]
name = "wall"
normal = [1.0, 0.0]
offset = 0.0

[hand]
path = "hand.txt"
plane = "xy"
scale = 0.1
origin = [-0.075, -0.01, -1.386]
"#;

#[test]
fn a_recorded_hand_moves_the_box_lawfully() {
    let (Some(judge), Some(hand)) = (
        shared("tools/judge.py"),
        shared("data/tum-freiburg1-xyz-groundtruth.txt"),
    ) else {
        return;
    };
    let folder = Folder::new();
    folder.write("scene.toml", RECORDED);
    folder.write("hand.txt", std::fs::read(hand).expect("the recording"));
    for number in NUMBERS {
        for evolution in EVOLUTIONS {
            let trace = records(&judged(
                &judge,
                &folder.file("scene.toml"),
                number,
                evolution,
            ));
            assert_eq!(trace.len(), 3000);
            for surface in ["floor", "wall"] {
                let on_it = |contact: &serde_json::Value| contact["surface"] == surface;
                let touching = |record: &&serde_json::Value| {
                    record["contacts"]
                        .as_array()
                        .is_some_and(|contacts| contacts.iter().any(on_it))
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
