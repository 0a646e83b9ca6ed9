//! A line in both directions that flips bits, and drops, duplicates and inserts bytes: no wrong sample is stepped, no wrong pose is
//! accepted, every loss shows in the counts, and the board never stops.

use super::rig::Rig;
use std::collections::HashMap;
use stiction_core::Hand;
use stiction_tests::station::beside::{Beside, assert_same};
use stiction_tests::station::client::{Client, Said, hand_path};
use stiction_tests::station::noise::{Random, garbled};
use stiction_wire::{Command, Mode, Stepping};

fn run(seed: u64, per_byte: u64, frames: u32) {
    let mut rig = Rig::<f32>::new();
    rig.mode(|mode| {
        (mode.stepping, mode.events, mode.health_every) = (Stepping::PerSample, false, 0);
    });
    rig.received();
    let mut random = Random(seed);
    let path = hand_path(5_000);
    // The number of a sample returns as the depth of its pose: so every accepted pose can be identified.
    let hand = |number: u32| Hand {
        depth: number as f32,
        ..path[number as usize % path.len()]
    };
    let mut beside = Beside::<f32>::new(&Mode::DEFAULT);
    // The board's reports, before the line to the client.
    let mut at_board = Client::default();
    let (mut stepped, mut reported) = (0_u32, HashMap::new());
    let mut accepted = 0_u32;
    for number in 0..frames {
        let wire = rig.client.encode(Command::Hand(hand(number)));
        let arrived = garbled(&mut random, &wire, per_byte);
        rig.line.to_board.extend(arrived);
        rig.station.tick(rig.now_us, &mut rig.line, &mut rig.servo);
        rig.now_us = rig.now_us.wrapping_add(1_000);
        let answers = std::mem::take(&mut rig.line.from_board);
        at_board.listen(&answers);
        rig.client.listen(&garbled(&mut random, &answers, per_byte));
        for received in at_board.inbox.drain(..) {
            let Said::Pose(pose) = received.said else {
                panic!("{received:?}")
            };
            // The sample of this tick, or one that waited for its end.
            let stepped_number = pose.depth as u32;
            assert!(stepped_number <= number && !reported.contains_key(&stepped_number));
            let output = beside.step(hand(stepped_number));
            assert_same(&pose, &output, &format!("frame {number}"));
            reported.insert(stepped_number, pose);
            stepped += 1;
        }
        for received in rig.received() {
            let Said::Pose(pose) = received.said else {
                panic!("{received:?}")
            };
            accepted += 1;
            assert_eq!(reported.get(&(pose.depth as u32)), Some(&pose));
        }
    }
    let health = rig.health();
    assert_eq!(stepped, health.samples);
    assert!(accepted <= stepped);
    assert!(health.faults.total() > 0 && rig.client.faults().total() > 0);
    // The next frame reveals what was lost at the end.
    rig.line.to_board.push_back(0);
    rig.send(Command::Ping);
    rig.tick();
    rig.tick();
    assert_eq!(rig.health().samples + rig.health().lost_frames, frames);
    println!(
        "a byte in {}: {stepped} of {frames} stepped, {accepted} poses accepted",
        per_byte / 4
    );
}

#[test]
fn no_wrong_pose_in_hundred_thousand_frames() {
    run(1, 4_000, 50_000);
    run(2, 400, 30_000);
    run(3, 200, 20_000);
}
