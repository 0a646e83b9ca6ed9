//! `stiction board --emulate` and `stiction info --emulate` from the command line to the emulator and back. What is not
//! installed is skipped with the command that installs it; with CI=true it must be there.
use crate::common::{Folder, text};
use stiction_host_sim::firmware::process::may_skip;

/// The folder's program with an emulated board, patient with a slow machine: what it prints; nothing where something is
/// missing.
fn emulated(folder: &Folder, arguments: &[&str]) -> Option<String> {
    let output = folder.stiction(&[arguments, &["--timeout", "60"]].concat());
    let errors = text(&output.stderr);
    if may_skip(&errors) {
        return None;
    }
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{errors}");
    Some(said)
}

/// A hand that takes the box of `box-flat`, presses it 10 mm deep to the floor, drags it and turns it a little.
fn hand(samples: u32, rate: f64) -> String {
    let rows = (0..samples).map(|i| {
        let part = f64::from(i) / f64::from(samples - 1);
        let down = (part / 0.3).min(1.0);
        let along = (part - 0.3).max(0.0) / 0.7;
        let (x, y, phi) = (0.05 * along, 0.07 - 0.03 * down, 0.2 * along);
        format!("{},{x},{y},{phi}\n", f64::from(i) / rate)
    });
    "t,x,y,phi\n".to_owned() + &rows.collect::<String>()
}

/// 300 samples: every answer of the board has the bits of this computer.
fn streamed_and_verified(board: &str, rate: f64) {
    let folder = Folder::new();
    folder.write("hand.csv", hand(300, rate));
    let emulate = ["board", "box-flat", "--emulate", board];
    let rate = rate.to_string();
    let rest = ["--rate", &rate, "--hand", "hand.csv", "--verify", "--quiet"];
    if let Some(said) = emulated(&folder, &[&emulate[..], &rest].concat()) {
        assert_eq!(said, "300 of 300 frames equal\n", "{board}");
    }
}

#[test]
fn the_emulated_f405_has_the_bits_of_this_computer() {
    streamed_and_verified("olimex-stm32-h405", 1_000.0);
}

#[test]
fn the_emulated_microbit_has_the_bits_of_this_computer() {
    streamed_and_verified("microbit", 100.0);
}

#[test]
fn what_is_emulated_in_the_place_of_the_pico_2_has_the_bits_of_this_computer() {
    streamed_and_verified("mps2-an505", 1_000.0);
}

/// A bundled scene with obstacles, every answer with the bits of this computer, and the obstacles by their names in the trace.
fn among_obstacles(board: &str, rate: &str, scene: &str) {
    let folder = Folder::new();
    let emulate = ["board", scene, "--emulate", board, "--rate", rate];
    let rest = ["--verify", "--quiet", "--out", "board.jsonl"];
    let Some(said) = emulated(&folder, &[&emulate[..], &rest].concat()) else {
        return;
    };
    let (equal, rest) = said.split_once(" of ").expect("a verdict");
    assert_eq!(rest, format!("{equal} frames equal\n"), "{board}: {said}");
    let trace = std::fs::read_to_string(folder.file("board.jsonl")).expect("a trace");
    for part in ["\"obstacle\":\"table\"", "\"corner\":2", "\"direction\":["] {
        assert!(trace.contains(part), "{part} in the trace of {board}");
    }
}

#[test]
fn the_emulated_f405_has_the_bits_of_this_computer_among_obstacles() {
    among_obstacles("olimex-stm32-h405", "500", "table-edge");
}

/// With the scene compiled in, as there is no room for others. Its line cannot transfer the forces of two contacts a hundred times
/// a second.
#[test]
fn the_emulated_microbit_takes_a_scene_with_obstacles() {
    let folder = Folder::new();
    folder.write("hand.csv", "t,x,y,phi\n0,-0.07,0.05,0\n2,-0.02,0.04,0\n");
    let hand = ["--rate", "100", "--hand", "hand.csv"];
    let emulate = ["board", "table-edge", "--emulate", "microbit"];
    let out = ["--quiet", "--out", "board.jsonl"];
    let Some(_) = emulated(&folder, &[&emulate[..], &hand, &out].concat()) else {
        return;
    };
    let trace = std::fs::read_to_string(folder.file("board.jsonl")).expect("a trace");
    for part in ["\"obstacle\":\"table\"", "\"state\":\"edge\""] {
        assert!(trace.contains(part), "{part} in the trace");
    }
}

#[test]
fn the_line_of_the_microbit_is_too_slow_to_compare_every_step_among_obstacles() {
    let folder = Folder::new();
    let verify = ["board", "table-edge", "--emulate", "microbit", "--verify"];
    let output = folder.stiction(&[&verify[..], &["--timeout", "60"]].concat());
    let errors = text(&output.stderr);
    if !may_skip(&errors) {
        assert_eq!(output.status.code(), Some(2), "{errors}");
        assert!(errors.contains("bytes per second"), "{errors}");
    }
}

#[test]
fn emulated_boards_say_what_they_are() {
    let folder = Folder::new();
    for (board, number, room) in [
        ("olimex-stm32-h405", "f32", "8 vertices, 4 surfaces"),
        ("microbit", "fixed", "8 vertices, 2 surfaces"),
    ] {
        let Some(said) = emulated(&folder, &["info", "--emulate", board]) else {
            continue;
        };
        for part in [board, number, room] {
            assert!(said.contains(part), "{part:?} in {said}");
        }
    }
}
