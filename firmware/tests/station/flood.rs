//! More than a tick can process: its work stays bounded, and the board keeps running.

use super::rig::Rig;
use stiction_core::{Hand, Wrench};
use stiction_tests::station::BOX;
use stiction_tests::station::client::{Client, Said, scene};
use stiction_wire::{Command, Stepping};

/// What 921600 baud transfer within 1 ms, twice, and one sample.
const BOUND: usize = 2 * 92 + 64;

fn still_there(rig: &mut Rig) {
    rig.line.to_board.clear();
    rig.line.to_board.extend([0]);
    rig.tick();
    assert_eq!(rig.info().name, "bench");
    rig.hand(Hand::new(0.0, 0.05, 0.0));
    assert!(!rig.pose().force_off);
}

#[test]
fn a_flood_of_anything_is_taken_in_bounded_parts() {
    let mut rig = Rig::<f32>::new();
    let mut client = Client::default();
    let mut many = |count: usize, command: Command<'static>| {
        let frames = (0..count).flat_map(|_| client.encode(command));
        frames.collect()
    };
    let flood = [
        vec![0; 50_000],
        vec![1; 50_000],
        vec![0xff; 50_000],
        (0..50_000_u32)
            .map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8)
            .collect(),
        many(2_000, Command::Ping),
        many(2_000, Command::Hello),
        many(2_000, Command::Hand(Hand::new(0.0, 0.05, 0.0))),
        many(500, scene(&BOX)),
    ];
    for bytes in flood {
        rig.line.to_board.extend(bytes);
        for _ in 0..200 {
            let force = rig.tick();
            assert!(rig.line.taken <= BOUND, "{}", rig.line.taken);
            assert!(force.force.iter().all(|f| f.is_finite()));
            // Poses continue.
            assert!(!rig.poses().is_empty());
        }
        still_there(&mut rig);
    }
    assert_eq!(rig.health().missed_ticks, 0);
}

#[test]
fn a_flood_that_carries_no_sample_is_silence() {
    let mut rig = Rig::<f32>::new();
    for _ in 0..50 {
        rig.hand(Hand::new(0.0, 0.045, 0.0));
    }
    assert_ne!(rig.force, Wrench::default());
    for _ in 0..21 {
        rig.line.to_board.extend([7; 300]);
        rig.tick();
    }
    assert_eq!(rig.force, Wrench::default());
    still_there(&mut rig);
}

#[test]
fn one_command_a_tick_and_samples_behind_it_wait() {
    let mut rig = Rig::<f32>::new();
    rig.mode(|mode| mode.stepping = Stepping::PerSample);
    rig.received();
    for i in 0..10 {
        rig.send(Command::Ping);
        rig.send(Command::Hand(Hand::new(0.001 * i as f32, 0.05, 0.0)));
    }
    for i in 0..20 {
        rig.tick();
        let received = rig.received();
        let pongs = received
            .iter()
            .filter(|h| matches!(h.said, Said::Pong { .. }));
        let poses = received.iter().filter(|h| matches!(h.said, Said::Pose(_)));
        let expected = if i % 2 == 0 { (1, 0) } else { (0, 1) };
        assert_eq!((pongs.count(), poses.count()), expected);
    }
    assert!(rig.line.to_board.is_empty());
}
