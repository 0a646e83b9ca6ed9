//! `stiction board` and `stiction info` with a board that is a thread of the test. No verdict hangs on how fast anything is.
mod fake;
mod lines;
mod made;
mod streaming;
mod tracker;
mod verified;

use std::path::PathBuf;
use std::process::Output;
use std::sync::LazyLock;

use crate::common::{Folder, text, with_hand};

/// A box that comes down in a corner, is dragged along, turned over, let go and taken again: 301 samples in 0.3 s.
static DRAGGED: LazyLock<String> = LazyLock::new(|| {
    let hand = "rate = 1000.0\nkeyframes = [[0.00, 0.20, 0.14, 0.5], [0.05, 0.20, 0.04, 0.5], [0.12, 0.06, 0.04, 2.5, 0], \
                [0.14, 0.08, 0.05, 2.5, 1], [0.20, 0.01, 0.03, 7.0], [0.30, 0.20, 0.02, 8.0]]";
    let scene = with_hand(hand).replace("weight = 0.0", "weight = 0.5");
    scene.replace("reach = 0.01", "reach = 0.05")
});
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
