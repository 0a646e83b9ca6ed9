//! Bad lines and bad clients: silence, floods, damaged bytes, a client that goes and comes back, commands in mid-contact.

use crate::beside::{Beside, assert_same};
use crate::board::Board;
use crate::chip::{Chip, F405, MICROBIT};
use crate::client::{BOX, Client, Said, hand_path, scene};
use crate::random::{Random, garbled};
use std::collections::HashMap;
use stiction_core::frame::{Command, Drive, Mode, Parameters, Pose, Reset, Stepping};
use stiction_core::{Fixed, Hand, Real, Wrench};

const DEEP: [f32; 3] = [0.0, 0.045, 0.0];

fn deep() -> Hand<f32> {
    let [x, y, phi] = DEEP;
    Hand::new(x, y, phi)
}

/// The hand presses until the board gives force.
fn pressed(board: &mut Board) -> Pose {
    loop {
        board.send(Command::Hand(deep()));
        let pose = board.wait(|_, said| match said {
            Said::Pose(pose) => Some(*pose),
            _ => None,
        });
        if !pose.force_off && pose.held {
            return pose;
        }
    }
}

/// From the last sample to zero force, on the clock of the board (us); nothing where something is missing.
pub(crate) fn silence(chip: &'static Chip) -> Option<u32> {
    let mut board = Board::start(chip)?;
    let mode = board.info().mode;
    board.done(Command::Mode(Mode {
        forces_every: 10,
        ..mode
    }));
    for _ in 0..30 {
        pressed(&mut board);
    }
    // The tick of the last sample, and that of the first pose after it without force. Meanwhile the emulator's time may have
    // gone on for long enough for silence between two samples, too.
    board.send(Command::Hand(deep()));
    let last = board.client.sequence.wrapping_sub(1);
    let mut came_us = None;
    let (off_us, pose) = board.wait(|time, said| match said {
        Said::Pose(pose) if pose.sample == last => {
            let came_us = *came_us.get_or_insert(time);
            (pose.force_off).then(|| (time.wrapping_sub(came_us), *pose))
        }
        _ => None,
    });
    let feedback = board.wait(|_, said| match said {
        Said::Forces { feedback, .. } => Some(*feedback),
        _ => None,
    });
    assert!(off_us <= 20_000);
    assert!(pose.held && pose.status == stiction_core::Status::HeldLast);
    assert_eq!(feedback, Wrench::default());
    assert_eq!(board.health().drive, Drive::Silent);
    // Samples return.
    assert_eq!(pressed(&mut board).position, pose.position);
    Some(off_us)
}

#[test]
fn silence_on_the_f405_is_zero_force_within_20_ms() {
    silence(&F405);
}

#[test]
fn silence_on_the_microbit_is_zero_force_within_20_ms() {
    silence(&MICROBIT);
}

/// Bytes as fast as the emulator takes them.
fn flood(chip: &'static Chip, size: usize) {
    let Some(mut board) = Board::start(chip) else {
        return;
    };
    let mut random = Random(5);
    let noise: Vec<u8> = (0..size).map(|_| random.bits() as u8).collect();
    let pings: Vec<u8> = (0..size / 13)
        .flat_map(|_| board.client.encode(Command::Ping))
        .collect();
    for bytes in [&noise, &pings] {
        board.send_bytes(bytes);
        board.send_bytes(&[0]);
        // It answers, if not at once: the queue was full.
        let health = board.health();
        assert_eq!(health.drive, Drive::Silent);
        board.settle();
        assert_eq!(board.info().name, chip.name);
    }
    pressed(&mut board);
    let health = board.health();
    println!("{}: {health:?}", chip.name);
    assert_eq!(health.missed_ticks, 0, "no tick was missed for it");
}

#[test]
fn a_flood_does_not_stop_the_f405() {
    flood(&F405, 60_000);
}

#[test]
fn a_flood_does_not_stop_the_microbit() {
    flood(&MICROBIT, 30_000);
}

/// Both directions are damaged: every pose that the board sends is that of a sample that was sent, bit for bit, and every
/// pose that is accepted is one that the board sent. The number of a sample comes back as the depth of its pose.
fn faulty_line<R: Real<Si = f32>>(chip: &'static Chip, frames: u32, per_byte: u64) {
    let Some(mut board) = Board::start(chip) else {
        return;
    };
    let mode = Mode {
        stepping: Stepping::PerSample,
        events: false,
        health_every: 0,
        ..board.info().mode
    };
    board.done(Command::Mode(mode));
    let path = hand_path(3_000);
    let hand = |number: u32| Hand {
        depth: number as f32,
        ..path[number as usize % path.len()]
    };
    let (mut out, mut back) = (Random(6), Random(7));
    // What the board says, before the line damages it, and after.
    let (mut at_board, mut beyond) = (Client::new(), Client::new());
    let mut beside = Beside::<R>::new(&mode);
    let mut sent: HashMap<u32, Pose> = HashMap::new();
    let mut accepted = 0;
    for number in 0..frames {
        let wire = board.client.encode(Command::Hand(hand(number)));
        board.send_bytes(&garbled(&mut out, &wire, per_byte));
        for _ in 0..3 {
            let bytes = board.bytes();
            at_board.listen(&bytes);
            beyond.listen(&garbled(&mut back, &bytes, per_byte));
        }
        for pose in poses(&mut at_board) {
            let number = pose.depth as u32;
            assert_same(&pose, &beside.step(hand(number)), chip.name);
            assert!(sent.insert(number, pose).is_none());
        }
        for pose in poses(&mut beyond) {
            accepted += 1;
            assert_eq!(sent.get(&(pose.depth as u32)), Some(&pose));
        }
    }
    board.send_bytes(&[0]);
    board.settle();
    // The gap before hello is none: ping, so that the last loss is counted.
    board.send(Command::Ping);
    board.done(Command::Mode(Mode {
        health_every: 50,
        ..mode
    }));
    let health = board.health();
    assert_eq!(health.samples + health.lost_frames, frames);
    assert!(health.faults.total() > 0 && beyond.faults().total() > 0);
    assert!(health.samples > frames / 2);
    println!(
        "{}: {} of {frames} samples came, {accepted} poses accepted, none wrong",
        chip.name, health.samples
    );
}

fn poses(client: &mut Client) -> Vec<Pose> {
    let said = client.heard.drain(..).map(|heard| heard.said);
    said.filter_map(|said| match said {
        Said::Pose(pose) => Some(pose),
        _ => None,
    })
    .collect()
}

#[test]
fn no_wrong_pose_over_a_faulty_line_to_the_f405() {
    faulty_line::<f32>(&F405, 4_000, 400);
}

#[test]
fn no_wrong_pose_over_a_faulty_line_to_the_microbit() {
    faulty_line::<Fixed>(&MICROBIT, 4_000, 400);
}

#[test]
#[ignore = "takes minutes"]
fn no_wrong_pose_in_100_000_frames_over_faulty_lines() {
    faulty_line::<f32>(&F405, 100_000, 400);
    faulty_line::<Fixed>(&MICROBIT, 100_000, 400);
}

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

#[test]
fn commands_in_mid_contact_on_both_boards() {
    in_mid_contact(&F405);
    in_mid_contact(&MICROBIT);
}
