//! `--verify`: equal bits are equal, one bit that is not is found, what is lost is not equal.

use stiction_core::{Fixed, Real};

use super::fake::{Part, Tricks, behind_socket};
use super::{DRAGGED, SAMPLES, assert_error, board, place, said};
use crate::common::{records, text};

/// The last line of `--verify` and the exit status.
fn verdict<R: Real<Si = f32>>(tricks: Tricks, arguments: &[&str]) -> (String, Option<i32>) {
    let (folder, socket) = place(&DRAGGED);
    let fake = behind_socket::<R>(&socket, 1, tricks);
    let output = board(&folder, &[&["--verify", "--quiet"], arguments].concat());
    let said = said(&output);
    assert!(output.status.code() != Some(2), "{said}");
    assert_eq!(fake.join().expect("no panic").samples, SAMPLES);
    (said.trim().to_owned(), output.status.code())
}

fn trace_is_that_of_the_host<R: Real<Si = f32>>(number: &str, arguments: &[&str]) {
    let (folder, socket) = place(&DRAGGED);
    let fake = behind_socket::<R>(&socket, 1, Tricks::default());
    let with_trace = [&["--verify", "--out", "board.jsonl"], arguments].concat();
    let output = board(&folder, &with_trace);
    assert!(output.status.success(), "{}", said(&output));
    assert!(text(&output.stdout).ends_with("301 of 301 frames equal\n"));
    assert_eq!(fake.join().expect("no panic").samples, SAMPLES);
    let run = [
        "run",
        "scene.toml",
        "--out",
        "run.jsonl",
        "--number",
        number,
    ];
    let output = folder.stiction(&[&run[..], arguments].concat());
    assert!(output.status.success(), "{}", said(&output));
    let trace = folder.read("board.jsonl");
    assert_eq!(trace, folder.read("run.jsonl"), "{number} {arguments:?}");
    let mut states: Vec<String> = records(&trace)
        .iter()
        .map(|record| record["state"].to_string())
        .collect();
    states.sort();
    states.dedup();
    assert!(states.len() >= 3, "the scene is poor: {states:?}");
}

#[test]
fn equal_answers_are_equal_and_leave_the_trace_of_the_host() {
    trace_is_that_of_the_host::<f32>("f32", &[]);
    trace_is_that_of_the_host::<f32>("f32", &["--evolution", "frame"]);
    trace_is_that_of_the_host::<Fixed>("fixed", &[]);
}

/// Its body is behind the hand where much happens in a step.
#[test]
fn the_budget_of_a_tick_is_that_of_both() {
    let arguments = ["--tick", "2000", "--rate", "50"];
    let (folder, socket) = place(&DRAGGED);
    let tricks = Tricks {
        work_rate: Some(500_000),
        ..Tricks::default()
    };
    let _fake = behind_socket::<f32>(&socket, 1, tricks);
    let record = [
        "--verify",
        "--record",
        "recording.jsonl",
        "--out",
        "board.jsonl",
    ];
    let output = board(&folder, &[&record[..], &arguments].concat());
    assert!(output.status.success(), "{}", said(&output));
    let recording = folder.read("recording.jsonl");
    assert!(recording.contains(r#","budget":250,"#) && recording.contains(r#""status":"behind""#));
    let run = ["run", "scene.toml", "--out", "run.jsonl", "--budget", "250"];
    let output_of_run = folder.stiction(&[&run[..], &arguments[2..]].concat());
    assert!(output_of_run.status.success(), "{}", said(&output_of_run));
    assert_eq!(folder.read("board.jsonl"), folder.read("run.jsonl"));
    let output = folder.stiction(&["replay", "recording.jsonl"]);
    assert!(output.status.success(), "{}", said(&output));
}

#[test]
fn one_flipped_bit_is_found_in_its_frame() {
    for (frame, part, what) in [
        (123, Part::PoseX, "pose x"),
        (0, Part::Theta, "pose theta"),
        (300, Part::Wrench, "wrench moment"),
        (60, Part::Friction, "T of contact"),
        (60, Part::Sliding, "sliding of contact"),
    ] {
        let tricks = Tricks {
            flip: Some((frame, part)),
            ..Tricks::default()
        };
        let (said, status) = verdict::<f32>(tricks, &[]);
        let expected = format!("300 of 301 frames equal; first difference: frame {frame} (t = ");
        assert!(said.starts_with(&expected) && said.contains(what), "{said}");
        assert_eq!(status, Some(1), "{said}");
    }
}

#[test]
fn lost_answers_are_not_equal() {
    let tricks = Tricks {
        lost: vec![50, 51, 200],
        forceless: vec![220],
        ..Tricks::default()
    };
    let (said, status) = verdict::<f32>(tricks, &[]);
    assert_eq!(
        said,
        "297 of 301 frames equal, 4 lost; first difference: frame 50 (t = 0.05 s), no pose came"
    );
    assert_eq!(status, Some(1));
}

#[test]
fn garbage_on_the_line_changes_nothing() {
    let (folder, socket) = place(&DRAGGED);
    let tricks = Tricks {
        garbage: true,
        ..Tricks::default()
    };
    let fake = behind_socket::<Fixed>(&socket, 1, tricks);
    let output = board(&folder, &["--verify"]);
    let said = said(&output);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("301 of 301 frames equal"), "{said}");
    let garbled = said
        .lines()
        .find(|line| line.contains("garbled"))
        .expect("a count");
    let count: u64 = garbled
        .split_whitespace()
        .last()
        .expect("a number")
        .parse()
        .expect("a number");
    assert!(count >= 2 * SAMPLES, "{said}");
    assert_eq!(fake.join().expect("no panic").samples, SAMPLES);
}

#[test]
fn a_board_that_goes_away_cannot_be_verified() {
    let (folder, socket) = place(&DRAGGED);
    let tricks = Tricks {
        leaves_after: Some(100),
        ..Tricks::default()
    };
    let _fake = behind_socket::<f32>(&socket, 1, tricks);
    let output = board(&folder, &["--verify", "--out", "trace.jsonl"]);
    assert_error(&output, &["line: "]);
    assert!(
        !text(&output.stdout).contains("301 of"),
        "{}",
        said(&output)
    );
}

#[test]
fn a_board_that_falls_silent_is_named() {
    let (folder, socket) = place(&DRAGGED);
    let tricks = Tricks {
        silent_after: Some(100),
        ..Tricks::default()
    };
    let _fake = behind_socket::<f32>(&socket, 1, tricks);
    let output = board(&folder, &["--verify", "--timeout", "0.5"]);
    assert_error(&output, &["no answer to a sample within 0.5 s"]);
}

/// What it says is no answer to what it was given.
#[test]
fn a_board_that_says_everything_but_answers_is_named() {
    let (folder, socket) = place(&DRAGGED);
    let tricks = Tricks {
        floods_after: Some(100),
        ..Tricks::default()
    };
    let _fake = behind_socket::<f32>(&socket, 1, tricks);
    let output = board(&folder, &["--verify", "--timeout", "0.5"]);
    assert_error(
        &output,
        &["no answer to a sample within 0.5 s; ", " frames came"],
    );
}
