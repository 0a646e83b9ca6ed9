//! Commands in mid-contact, and another rate of ticks while a board runs.

use crate::board::Board;
use crate::chip::{AN505, Chip, F405, MICROBIT, PICO};
use crate::silence::{alone, pressed};
use stiction_tests::station::BOX;
use stiction_tests::station::client::{Said, scene};
use stiction_wire::{Command, Mode, Parameters, Reset};

/// Commands while the box is pressed to the floor, in the image itself.
fn in_mid_contact(chip: &'static Chip) {
    let Some(mut board) = Board::start(chip) else {
        return;
    };
    let before = pressed(&mut board);
    board.done(Command::Parameters(Parameters {
        stiffness_translation: 400.0,
        stiffness_rotation: 0.5,
        friction_static: 0.5,
        friction_dynamic: 0.3,
        memory: None,
    }));
    let after = pressed(&mut board);
    assert_eq!(after.position, before.position, "it lies on its edge");
    assert_eq!(board.info().stiffness, [400.0, 0.5]);
    board.done(scene(&BOX));
    assert_eq!(board.info().stiffness, [500.0, 0.5]);
    pressed(&mut board);
    board.done(Command::Reset(Reset::Body));
    let pose = board.wait(|_, said| match said {
        Said::Pose(pose) => Some(*pose),
        _ => None,
    });
    assert!(!pose.held);
    board.done(Command::Reset(Reset::Everything));
    assert_eq!(pressed(&mut board).position, before.position);
}

/// Ticks faster and slower: none is counted as missed.
fn another_tick_rate(chip: &'static Chip, rates: [u16; 4]) {
    let Some(mut board) = Board::start(chip) else {
        return;
    };
    let mode = Mode {
        pose_every: 50,
        health_every: 50,
        ..board.info().mode
    };
    for tick_rate in rates {
        board.done(Command::Mode(Mode { tick_rate, ..mode }));
        board.health();
        let health = board.health();
        println!("{tick_rate} Hz: {} missed", health.missed_ticks);
        assert_eq!(health.missed_ticks, 0, "{tick_rate} Hz");
    }
}

#[test]
fn another_tick_rate_misses_no_tick() {
    let _alone = alone();
    another_tick_rate(&F405, [500, 1000, 250, 1000]);
    another_tick_rate(&MICROBIT, [125, 250, 100, 500]);
    another_tick_rate(&PICO, [500, 1000, 250, 2000]);
    another_tick_rate(&AN505, [2500, 1000, 250, 5000]);
}

#[test]
fn commands_in_mid_contact() {
    let _alone = alone();
    for chip in [&F405, &MICROBIT, &PICO, &AN505] {
        in_mid_contact(chip);
    }
}
