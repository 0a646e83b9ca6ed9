//! `--verify`: equal bits are equal, one bit that is not is found, what is lost is not equal.

use std::collections::BTreeSet;

use stiction_core::{Fixed, Real};

use super::fake::{Part, Tricks, behind_socket};
use super::{DRAGGED, SAMPLES, board, place, streamed, tricks};
use crate::common::{records, said, text};

/// The last line of `--verify` and the exit status.
fn verdict(faults: Tricks) -> (String, Option<i32>) {
    let (_, output, seen) = streamed(faults, "--verify --quiet");
    assert_eq!(seen.samples, SAMPLES);
    (said(&output).trim().to_owned(), output.status.code())
}

fn trace_is_that_of_the_host<R: Real<Si = f32>>(number: &str, options: &str) {
    let (folder, socket) = place(&DRAGGED);
    let fake = behind_socket::<R>(&socket, 1, Tricks::default());
    let output = board(&folder, &format!("--verify --out board.jsonl {options}"));
    assert!(output.status.success(), "{}", said(&output));
    assert!(text(&output.stdout).ends_with("301 of 301 frames equal\n"));
    assert_eq!(fake.join().expect("no panic").samples, SAMPLES);
    folder.done(&format!(
        "run scene.toml --out run.jsonl --number {number} {options}"
    ));
    let trace = folder.read("board.jsonl");
    assert_eq!(trace, folder.read("run.jsonl"), "{number} {options}");
    let trace = records(&trace);
    let states: BTreeSet<_> = trace
        .iter()
        .filter_map(|record| record["state"].as_str())
        .collect();
    assert!(states.len() >= 3, "the scene is poor: {states:?}");
}

#[test]
fn equal_answers_are_equal_and_leave_the_trace_of_the_host() {
    trace_is_that_of_the_host::<f32>("f32", "");
    trace_is_that_of_the_host::<f32>("f32", "--evolution frame");
    trace_is_that_of_the_host::<Fixed>("fixed", "");
}

/// Its body is behind the hand where much happens in a step.
#[test]
fn the_budget_of_a_tick_is_that_of_both() {
    let working = tricks(|t| t.work_rate = Some(8_000));
    let options = "--verify --record recording.jsonl --out board.jsonl --tick 2000 --rate 50";
    let (folder, output, _) = streamed(working, options);
    assert!(output.status.success(), "{}", said(&output));
    let recording = folder.read("recording.jsonl");
    assert!(recording.contains(r#","budget":4,"#) && recording.contains(r#""status":"behind""#));
    folder.done("run scene.toml --out run.jsonl --budget 4 --rate 50");
    assert_eq!(folder.read("board.jsonl"), folder.read("run.jsonl"));
    folder.done("replay recording.jsonl");
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
        let (said, status) = verdict(tricks(|t| t.flip = Some((frame, part))));
        let expected = format!("300 of 301 frames equal; first difference: frame {frame} (t = ");
        assert!(said.starts_with(&expected) && said.contains(what), "{said}");
        assert_eq!(status, Some(1), "{said}");
    }
}

#[test]
fn lost_answers_are_not_equal() {
    let faults = tricks(|t| (t.lost, t.forceless) = (vec![50, 51, 200], vec![220]));
    let (said, status) = verdict(faults);
    assert_eq!(
        said,
        "297 of 301 frames equal, 4 lost; first difference: frame 50 (t = 0.05 s), no pose came"
    );
    assert_eq!(status, Some(1));
}

#[test]
fn garbage_on_the_line_changes_nothing() {
    let (folder, socket) = place(&DRAGGED);
    let fake = behind_socket::<Fixed>(&socket, 1, tricks(|t| t.garbage = true));
    let output = board(&folder, "--verify");
    let said = said(&output);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("301 of 301 frames equal"), "{said}");
    let garbled = said
        .lines()
        .find(|line| line.contains("garbled"))
        .expect("a count");
    let count = garbled.split_whitespace().last().expect("a number");
    assert!(
        count.parse().is_ok_and(|count: u64| count >= 2 * SAMPLES),
        "{said}"
    );
    assert_eq!(fake.join().expect("no panic").samples, SAMPLES);
}
