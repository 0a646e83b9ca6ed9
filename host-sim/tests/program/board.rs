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

use crate::common::{Folder, assert_error, text, with_hand};
use fake::{Seen, Tricks, behind_socket};

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
fn board(folder: &Folder, options: &str) -> Output {
    let patience = if options.contains("--timeout") {
        ""
    } else {
        "--timeout 20"
    };
    folder.stiction(&format!(
        "board scene.toml --socket line {patience} {options}"
    ))
}

/// As [`board`], with a board of f32 that does so, and what that saw.
fn streamed(tricks: Tricks, options: &str) -> (Folder, Output, Seen) {
    let (folder, socket) = place(&DRAGGED);
    let fake = behind_socket::<f32>(&socket, 1, tricks);
    let output = board(&folder, options);
    (folder, output, fake.join().expect("no panic"))
}

/// Only this is not as it should be.
fn tricks(set: impl FnOnce(&mut Tricks)) -> Tricks {
    let mut tricks = Tricks::default();
    set(&mut tricks);
    tricks
}

/// What a stream that does not succeed says, for each of what goes wrong.
#[test]
fn what_goes_wrong_on_the_line_is_named() {
    let cases: [(Tricks, &str, &[&str]); 8] = [
        (
            tricks(|t| t.silent_after = Some(0)),
            "--timeout 0.3 --out trace.jsonl",
            &["no answer to hello within 0.3 s; not a single byte came"],
        ),
        (
            tricks(|t| t.echo = true),
            "--timeout 0.3",
            &["no answer to hello", "an echo"],
        ),
        (
            tricks(|t| t.is_of_version_1 = true),
            "",
            &["another version of the wire format, allowed: 4"],
        ),
        (
            tricks(|t| t.measures = true),
            "",
            &["refuses the hand", "no use for it", "no samples"],
        ),
        (
            Tricks::default(),
            "--tick 9000 --out trace.jsonl",
            &[
                "refuses the mode",
                "9000.0 Hz",
                "allowed: 1 to 5000",
                "the nearest: 5000.0 Hz",
            ],
        ),
        (
            tricks(|t| t.silent_after = Some(100)),
            "--verify --timeout 0.5",
            &["no answer to a sample within 0.5 s"],
        ),
        // What it says is no answer to what it was given.
        (
            tricks(|t| t.floods_after = Some(100)),
            "--verify --timeout 0.5",
            &["no answer to a sample within 0.5 s; ", " frames came"],
        ),
        (
            tricks(|t| t.leaves_after = Some(100)),
            "--verify",
            &["line: "],
        ),
    ];
    for (tricks, options, expected) in cases {
        let (folder, output, _) = streamed(tricks, options);
        assert_error(options, &output, expected);
        assert_eq!(folder.names(), ["line", "scene.toml"]);
        assert!(!text(&output.stdout).contains("301 of"), "{options}");
    }
}
