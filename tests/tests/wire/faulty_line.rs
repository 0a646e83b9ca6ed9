//! A line that flips bits and drops, doubles and inserts bytes: no wrong message is accepted, every loss shows in the
//! sequence numbers, and the next undamaged frame is found.

use crate::random::{Random, pose};
use crate::{encoded, times};
use std::collections::HashSet;
use stiction_tests::station::noise::{self, garbled};
use stiction_wire::{Command, Decoder, Faults, Frame, Pose, Report, Sequence};

const FRAMES: u32 = times(100_000);

/// A frame with a pose that can be identified by its number.
fn numbered(random: &mut Random, number: u32) -> Frame<Report<'static>> {
    let message = Report::Pose(Pose {
        depth: number as f32,
        ..pose(random)
    });
    Frame {
        sequence: number as u8,
        time: number.wrapping_mul(1000),
        message,
    }
}

/// The results of a run over the line.
#[derive(Debug, Default)]
struct Tally {
    sent: u32,
    undamaged: u32,
    accepted: u32,
    wrong: u32,
    lost_by_sequence: u32,
    faults: Faults,
}

/// Sends numbered poses. Every accepted one must equal, bit for bit, the next one of those that were sent.
fn run(seed: u64, per_byte: u64) -> Tally {
    let (mut random, mut noise) = (Random(seed), noise::Random(seed));
    let mut tally = Tally {
        sent: FRAMES,
        ..Tally::default()
    };
    let (mut decoder, mut sequence) = (Decoder::<512>::new(), Sequence::new());
    let mut last = None::<u32>;
    let mut clean = HashSet::new();
    let mut sent = Vec::new();
    let mut accepted = HashSet::new();
    let mut delimited = true;
    for number in 0..FRAMES {
        let wire = encoded(&numbered(&mut random, number));
        let line = garbled(&mut noise, &wire, per_byte);
        if line == wire && delimited {
            clean.insert(number);
        }
        delimited = line.last() == Some(&0) || (line.is_empty() && delimited);
        sent.push(wire);
        for &byte in &line {
            let Some(Ok(frame)) = decoder.push::<Report>(byte) else {
                continue;
            };
            let number = frame.time / 1000;
            let right = sent
                .get(number as usize)
                .is_some_and(|wire| *wire == encoded(&frame))
                && last.is_none_or(|last| number > last);
            tally.wrong += u32::from(!right);
            tally.accepted += 1;
            accepted.insert(number);
            let first = last.is_none();
            tally.lost_by_sequence +=
                u32::from(sequence.lost_before(frame.sequence)) + if first { number } else { 0 };
            last = Some(number);
        }
    }
    tally.lost_by_sequence += FRAMES - 1 - last.unwrap_or(0);
    tally.undamaged = clean.len() as u32;
    assert!(
        clean.is_subset(&accepted),
        "an undamaged frame after a delimiter is found"
    );
    tally.faults = *decoder.faults();
    tally
}

#[test]
fn no_wrong_pose_is_accepted_and_every_loss_shows() {
    for (seed, per_byte) in [(7, 4000), (8, 400), (9, 100)] {
        let tally = run(seed, per_byte);
        println!("a byte in {}: {tally:?}", per_byte / 4);
        assert_eq!(tally.wrong, 0);
        assert_eq!(tally.accepted + tally.lost_by_sequence, tally.sent);
        assert!(tally.accepted >= tally.undamaged && tally.accepted < tally.sent);
    }
}

#[test]
fn million_random_bytes_are_no_message() {
    for seed in [10, 11] {
        let (mut random, mut board, mut client) =
            (Random(seed), Decoder::<64>::new(), Decoder::<512>::new());
        let mut frames = 0;
        for _ in 0..times(1_000_000) {
            let byte = if seed == 11 && random.below(16) == 0 {
                0
            } else {
                random.byte()
            };
            let command = board.push::<Command>(byte);
            frames += u32::from(command.is_some());
            assert!(!matches!(command, Some(Ok(_))));
            assert!(!matches!(client.push::<Report>(byte), Some(Ok(_))));
        }
        assert_eq!(board.faults().total(), frames, "every one is counted");
        let ping = encoded(&Frame {
            sequence: 0,
            time: 0,
            message: Command::Ping,
        });
        let found = [0]
            .iter()
            .chain(&ping)
            .filter(|&&b| matches!(board.push::<Command>(b), Some(Ok(_))))
            .count();
        assert_eq!(found, 1);
    }
}

#[test]
#[cfg_attr(miri, ignore = "three million frames")]
fn one_to_three_flipped_bits_of_a_pose_are_always_found() {
    let mut wire = encoded(&numbered(&mut Random(12), 4711));
    let bits = wire.len() * 8;
    let flip = |wire: &mut [u8], bit: usize| wire[bit / 8] ^= 1 << (bit % 8);
    let mut accepted = 0_u32;
    let mut look = |wire: &[u8]| {
        let mut decoder = Decoder::<64>::new();
        let good = |byte: &&u8| matches!(decoder.push::<Report>(**byte), Some(Ok(_)));
        accepted += wire.iter().filter(good).count() as u32;
    };
    for a in 0..bits {
        flip(&mut wire, a);
        look(&wire);
        for b in a + 1..bits {
            flip(&mut wire, b);
            look(&wire);
            for c in b + 1..bits {
                flip(&mut wire, c);
                look(&wire);
                flip(&mut wire, c);
            }
            flip(&mut wire, b);
        }
        flip(&mut wire, a);
    }
    assert_eq!(accepted, 0);
}
