//! `stiction board` and `stiction info` with a board that is a thread of the test. No verdict hangs on how fast anything is.
#![cfg(unix)]

mod fake;
mod lines;
mod made;
mod streaming;
mod tracker;
mod verified;

use std::path::PathBuf;
use std::process::Output;

use crate::common::{Folder, text};

/// A box that comes down in a corner, is dragged along, turned over, let go and taken again: 301 samples in 0.3 s.
const DRAGGED: &str = r#"
[body]
rectangle = [0.10, 0.06]
start = [0.2, 0.12, 0.5]
weight = 0.5

[grasp]
point = [0.0, 0.02]
reach = 0.05

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
rate = 1000.0
keyframes = [
  [0.00, 0.20, 0.14, 0.5],
  [0.05, 0.20, 0.04, 0.5],
  [0.12, 0.06, 0.04, 2.5, 0],
  [0.14, 0.08, 0.05, 2.5, 1],
  [0.20, 0.01, 0.03, 7.0],
  [0.30, 0.20, 0.02, 8.0],
]
"#;
const SAMPLES: u64 = 301;

/// A folder with the scene `scene.toml`, and the place of a socket in it.
fn place(scene: &str) -> (Folder, PathBuf) {
    let folder = Folder::new();
    folder.write("scene.toml", scene);
    let socket = folder.file("line");
    (folder, socket)
}

/// `stiction board scene.toml --socket line`, patient with a slow machine.
fn board(folder: &Folder, arguments: &[&str]) -> Output {
    let fixed = ["board", "scene.toml", "--socket", "line"];
    let patience = ["--timeout", "20"];
    let patience: &[&str] = match arguments.contains(&"--timeout") {
        true => &[],
        false => &patience,
    };
    folder.stiction(&[&fixed, patience, arguments].concat())
}

fn said(output: &Output) -> String {
    text(&output.stdout) + &text(&output.stderr)
}

/// It failed with status 2 and says all of this.
fn assert_error(output: &Output, parts: &[&str]) {
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    for part in parts {
        assert!(said.contains(part), "{part:?} in {said:?}");
    }
}
