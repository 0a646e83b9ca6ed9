//! `stiction board --emulate`, `stiction info --emulate` and `stiction knob --emulate` from the command line to the emulator and back. What is not
//! installed is skipped with the command that installs it; with CI=true it must be there.
use crate::common::{Folder, assert_all, said, text};
use stiction_host_sim::firmware::process::may_skip;
use stiction_tests::times;

/// The folder's program with an emulated board, patient with a slow machine: what it prints; nothing where something is
/// missing.
fn emulated(folder: &Folder, line: &str) -> Option<String> {
    let output = folder.stiction(&format!("{line} --timeout 60"));
    if may_skip(&text(&output.stderr)) {
        return None;
    }
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    Some(text(&output.stdout))
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

/// 300 samples: every answer of a board has the bits of this computer. In the place of the Pico 2 is the AN505.
#[test]
fn emulated_boards_have_the_bits_of_this_computer() {
    let boards = [
        ("olimex-stm32-h405", 1000),
        ("microbit", 100),
        ("mps2-an505", 1000),
    ];
    for (board, rate) in &boards[..times(1, boards.len())] {
        let folder = Folder::new();
        folder.write("hand.csv", hand(300, f64::from(*rate)));
        let stream = format!("board box-flat --emulate {board} --rate {rate} --hand hand.csv");
        if let Some(said) = emulated(&folder, &format!("{stream} --verify --quiet")) {
            assert_eq!(said, "300 of 300 frames equal\n", "{board}");
        }
    }
}

/// A bundled scene with obstacles, every answer with the bits of this computer, and the obstacles by their names in the trace.
#[test]
fn the_emulated_f405_has_the_bits_of_this_computer_among_obstacles() {
    let folder = Folder::new();
    let stream = "board table-edge --emulate olimex-stm32-h405 --rate 500";
    let Some(said) = emulated(
        &folder,
        &format!("{stream} --verify --quiet --out board.jsonl"),
    ) else {
        return;
    };
    let (equal, rest) = said.split_once(" of ").expect("a verdict");
    assert_eq!(rest, format!("{equal} frames equal\n"), "{said}");
    let parts = ["\"obstacle\":\"table\"", "\"corner\":2", "\"direction\":["];
    assert_all("the trace", &folder.read("board.jsonl"), &parts);
}

/// With the scene compiled in, as there is no room for others. Its line cannot transfer the forces of two contacts a hundred times
/// a second: they come with every second step.
#[test]
fn the_emulated_microbit_takes_a_scene_with_obstacles() {
    // Its image takes most of a minute to build.
    if !times(false, true) {
        return;
    }
    let folder = Folder::new();
    folder.write("hand.csv", "t,x,y,phi\n0,-0.07,0.05,0\n2,-0.02,0.04,0\n");
    let stream = "board table-edge --emulate microbit --rate 100 --hand hand.csv";
    let Some(_) = emulated(&folder, &format!("{stream} --quiet --out board.jsonl")) else {
        return;
    };
    let parts = ["\"obstacle\":\"table\"", "\"state\":\"edge\""];
    assert_all("the trace", &folder.read("board.jsonl"), &parts);
    let stream = "board table-edge --emulate microbit --rate 100 --hand hand.csv";
    if let Some(said) = emulated(&folder, &format!("{stream} --verify --quiet")) {
        assert!(said.ends_with(" frames equal\n"), "{said}");
    }
}

#[test]
fn emulated_boards_say_what_they_are() {
    let folder = Folder::new();
    let boards = [
        ("olimex-stm32-h405", "f32", "8 vertices, 4 surfaces"),
        ("microbit", "fixed", "8 vertices, 2 surfaces"),
    ];
    for (board, number, room) in &boards[..times(1, boards.len())] {
        let Some(said) = emulated(&folder, &format!("info --emulate {board}")) else {
            continue;
        };
        assert_all(board, &said, &[board, number, room]);
    }
}

/// It stores other numbers in its flash, restarts, and says what it has.
#[test]
fn the_emulated_pico_takes_the_numbers_of_a_knob() {
    // Its image takes most of a minute to build.
    if !times(false, true) {
        return;
    }
    let folder = Folder::new();
    let example = include_str!("../../../firmware/knob.toml");
    folder.write(
        "mine.toml",
        example.replace("radius = 0.015", "radius = 0.01"),
    );
    if let Some(said) = emulated(&folder, "knob mine.toml --emulate pico") {
        assert_all(
            "knob",
            &said,
            &["pico: stored on the board", "radius = 0.01 "],
        );
    }
}
