//! Bad lines and bad clients: floods, damaged bytes, a client that dies in a frame.

use crate::board::Board;
use crate::chip::{AN505, Chip, F405, MICROBIT, PICO};
use crate::silence::{alone, answered, deep, fallen_silent, last_sample, pressed};
use std::collections::HashMap;
use stiction_core::{Fixed, Hand, Real, Wrench};
use stiction_firmware::safety::Limits;
use stiction_tests::station::beside::{Beside, assert_same};
use stiction_tests::station::client::{Client, Said, hand_path};
use stiction_tests::station::noise::{Random, garbled};
use stiction_wire::{Command, Drive, Mode, Pose, Stepping};

/// How large a force is (N).
fn size(wrench: &Wrench<f32>) -> f32 {
    let [x, y] = wrench.force;
    x.hypot(y)
}

/// The hand presses until its force, reported every few ticks, is almost that of the spring; every pose of this time counts. From one
/// report to the next the force changes no faster than allowed.
fn pressed_to_the_full(board: &mut Board, reported_every_us: u32) -> Vec<Pose> {
    let wanted = 500.0 * (0.05 - deep().position[1]);
    let rate = Limits::DEFAULT.force_rate;
    let (mut poses, mut before): (Vec<Pose>, Option<(u32, f32)>) = (Vec::new(), None);
    loop {
        board.send(Command::Hand(deep()));
        let mut is_answer = answered(board.last());
        let full = board.wait(|time, said| match said {
            Said::Pose(pose) => {
                poses.push(*pose);
                is_answer(pose).then_some(false)
            }
            Said::Forces { feedback, .. } => {
                let now = size(feedback);
                let (at, force) = before.replace((time, now)).unwrap_or((time, 0.0));
                // One that was not sent makes the step to the next larger.
                let passed_us = time.wrapping_sub(at).max(reported_every_us);
                let step = rate * passed_us as f32 * 1e-6;
                assert!(now <= force + 1.001 * step, "{force} N to {now} N");
                (now > 0.99 * wanted).then_some(true)
            }
            _ => None,
        });
        if full {
            return poses;
        }
    }
}

/// A client that dies in the middle of a frame, and another one on the same line.
fn client_dies(chip: &'static Chip) {
    let Some(mut board) = Board::start(chip) else {
        return;
    };
    let mode = Mode {
        forces_every: 10,
        ..board.info().mode
    };
    // More forces, and so fewer poses: the line has room for no more.
    let often = Mode {
        pose_every: 2,
        forces_every: 4,
        ..mode
    };
    let reported_every_us = 4 * 1_000_000 / u32::from(mode.tick_rate);
    board.done(Command::Mode(often));
    pressed_to_the_full(&mut board, reported_every_us);
    board.done(Command::Mode(mode));
    let before = pressed(&mut board);
    let last = last_sample(&mut board);
    let frame = board.client.encode(Command::Hand(deep()));
    board.send_bytes(&frame[..frame.len() / 2]);
    let (off_us, off) = fallen_silent(&mut board, last);
    println!(
        "{}: no force {off_us} us after the last sample",
        chip.name()
    );
    assert!(off.held && off.position == before.position);
    let no_force = board.wait(|_, said| match said {
        Said::Forces { feedback, .. } => Some(*feedback),
        _ => None,
    });
    assert_eq!(no_force, Wrench::default());
    // What is counted up to now, and what the half frame adds to it.
    let health = board.health();
    assert_eq!(health.drive, Drive::Silent);
    let counted = health.faults.total();
    board.client = Client::default();
    assert_eq!(board.info().mode, mode);
    board.done(Command::Mode(often));
    // From nothing, and from where the body was left.
    for pose in pressed_to_the_full(&mut board, reported_every_us) {
        assert!(pose.held && pose.position == before.position, "{pose:?}");
    }
    let health = board.health();
    assert_eq!(
        (health.faults.total() - counted, health.lost_frames),
        (1, 0)
    );
}

#[test]
fn a_client_dies_in_a_frame_and_another_goes_on() {
    let _alone = alone();
    for chip in [&F405, &MICROBIT, &PICO, &AN505] {
        client_dies(chip);
    }
}

/// Noise, and then pings: first as fast as the emulator takes them, which a board survives; then as fast as a line brings
/// them, which costs no tick.
fn flood(chip: &'static Chip, size: usize) {
    let Some(mut board) = Board::start(chip) else {
        return;
    };
    let mut random = Random(5);
    let noise: Vec<u8> = (0..size).map(|_| random.bits() as u8).collect();
    let pings: Vec<u8> = (0..size / 13)
        .flat_map(|_| board.client.encode(Command::Ping))
        .collect();
    let mut missed_ticks = 0;
    for send in [Board::send_bytes, Board::send_at_line_rate] {
        missed_ticks = board.health().missed_ticks;
        for bytes in [&noise, &pings] {
            send(&mut board, bytes);
            board.send_bytes(&[0]);
            // It answers, if not at once: the queue was full.
            let health = board.health();
            assert_eq!(health.drive, Drive::Silent);
            board.settle();
            assert_eq!(board.info().name, chip.name());
        }
    }
    pressed(&mut board);
    let health = board.health();
    println!("{}: {health:?}", chip.name());
    assert_eq!(health.missed_ticks, missed_ticks, "no tick was missed");
}

#[test]
fn a_flood_stops_no_board() {
    let _alone = alone();
    for (chip, size) in [
        (&F405, 60_000),
        (&MICROBIT, 30_000),
        (&PICO, 60_000),
        (&AN505, 60_000),
    ] {
        flood(chip, size);
    }
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
    /// Number of samples that may be unanswered, or lost, before the next one waits: the board must not be flooded.
    const UNDER_WAY: u32 = 8;
    const MOST_READS: u32 = 40;
    let (mut out, mut back) = (Random(6), Random(7));
    // What the board says, before the line damages it, and after.
    let (mut at_board, mut beyond) = (Client::default(), Client::default());
    let mut beside = Beside::<R>::new(&mode);
    beside.solver = beside.solver.with_budget(board.info().budget);
    let mut sent: HashMap<u32, Pose> = HashMap::new();
    let (mut accepted, mut newest) = (0, 0);
    for number in 0..frames {
        let wire = board.client.encode(Command::Hand(hand(number)));
        board.send_bytes(&garbled(&mut out, &wire, per_byte));
        for reads in 1..=MOST_READS {
            let bytes = board.bytes();
            at_board.listen(&bytes);
            beyond.listen(&garbled(&mut back, &bytes, per_byte));
            for pose in poses(&mut at_board) {
                newest = pose.depth as u32;
                assert_same(&pose, &beside.step(hand(newest)), chip.name());
                assert!(sent.insert(newest, pose).is_none());
            }
            if reads > 2 && number < newest + UNDER_WAY {
                break;
            }
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
        chip.name(),
        health.samples
    );
}

fn poses(client: &mut Client) -> Vec<Pose> {
    let said = client.inbox.drain(..).map(|received| received.said);
    said.filter_map(|said| match said {
        Said::Pose(pose) => Some(pose),
        _ => None,
    })
    .collect()
}

fn faulty_lines(frames: u32) {
    let _alone = alone();
    faulty_line::<f32>(&F405, frames, 400);
    faulty_line::<Fixed>(&MICROBIT, frames, 400);
    faulty_line::<Fixed>(&PICO, frames, 400);
    faulty_line::<f32>(&AN505, frames, 400);
}

#[test]
fn no_wrong_pose_over_a_faulty_line() {
    faulty_lines(4_000);
}

#[test]
#[ignore = "takes minutes"]
fn no_wrong_pose_in_100_000_frames_over_faulty_lines() {
    faulty_lines(100_000);
}
