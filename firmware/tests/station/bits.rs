//! The result of a step: the bits of a solver run in parallel, whatever the pace of the samples.

use super::rig::Rig;
use crate::with;
use stiction_core::{Event, Evolution, Hand, Real};
use stiction_tests::station::beside::{Beside, assert_same};
use stiction_tests::station::client::{Said, hand_path};
use stiction_wire::{Command, Mode, Stepping};

fn every_sample_is_stepped<R: Real<Si = f32>>(evolution: Evolution) {
    const SAMPLES: u32 = 3_000;
    let mut rig = Rig::<R>::new();
    rig.mode(|mode| (mode.evolution, mode.stepping) = (evolution, Stepping::PerSample));
    rig.client.inbox.clear();
    let hands = hand_path(SAMPLES);
    let first = rig.client.sequence;
    for hand in &hands {
        rig.send(Command::Hand(*hand));
    }
    // They all wait: one step per tick.
    for _ in 0..SAMPLES {
        rig.tick();
    }
    assert!(rig.line.to_board.is_empty());
    let poses = rig.poses();
    assert_eq!(poses.len(), hands.len());
    let mut beside = Beside::<R>::new(rig.station.mode());
    for (i, (pose, hand)) in poses.iter().zip(&hands).enumerate() {
        assert_same(pose, &beside.step(*hand), &format!("sample {i}"));
        assert_eq!(pose.sample, first.wrapping_add(i as u8));
        assert!(!pose.force_off);
    }
    let health = rig.health();
    assert_eq!((health.samples, health.late_samples), (SAMPLES, 0));
    let lost = [health.lost_frames, health.missed_ticks, health.unsent];
    assert_eq!(lost, [0; 3]);
    assert!((1..50_000).contains(&health.worst_step) && health.worst_tick > health.worst_step);
    // Nothing more arrives: nothing is reported.
    rig.tick();
    assert!(rig.poses().is_empty());
}

stiction_tests::test_on_boards!(every_sample_is_stepped_bit_for_bit: every_sample_is_stepped);

#[test]
fn with_ticks_the_newest_sample_counts_and_the_others_are_late() {
    let mut rig = Rig::<f32>::new();
    let mut beside = Beside::<f32>::new(&Mode::DEFAULT);
    let hands = hand_path(1_200);
    let (mut late, mut last) = (0, None);
    for (i, group) in hands.chunks(3).enumerate() {
        // 3, 2, 1 or no samples within a tick.
        let group = &group[..group.len().min(i % 4)];
        for hand in group {
            rig.send(Command::Hand(*hand));
        }
        rig.tick();
        let pose = rig.pose();
        late += group.len().saturating_sub(1) as u32;
        match group.last() {
            Some(hand) => {
                let output = beside.step(*hand);
                assert_same(&pose, &output, &format!("tick {i}"));
                last = Some(pose);
            }
            None => {
                // The body stays, and nothing happens to it.
                let Some(last) = last else { continue };
                assert_eq!(with(pose, |pose| pose.events = last.events), last);
                assert!(Event::ALL.iter().all(|event| !pose.events.contains(*event)));
            }
        }
    }
    assert_eq!(rig.health().late_samples, late);
    assert!(late > 100);
}

#[test]
fn forces_and_events_are_those_of_the_step() {
    let mut rig = Rig::<f32>::new();
    rig.mode(|mode| (mode.pose_every, mode.forces_every) = (2, 3));
    rig.client.inbox.clear();
    let mut beside = Beside::<f32>::new(&Mode::DEFAULT);
    let (mut poses, mut forces, mut events) = (0, 0, 0);
    // The tick of the command was the first step in the mode.
    for (i, hand) in (2_u32..).zip(hand_path(900)) {
        let now_us = rig.now_us;
        rig.hand(hand);
        let given = rig.force;
        let output = beside.step(hand);
        let state = beside.state.as_ref().unwrap();
        for received in rig.received() {
            assert_eq!(received.time, now_us, "the tick of the step");
            match received.said {
                Said::Pose(pose) => {
                    poses += 1;
                    assert_eq!(i % 2, 0);
                    assert_eq!(pose.position, output.position);
                }
                Said::Forces {
                    wrench,
                    feedback,
                    turns,
                    contacts,
                } => {
                    forces += 1;
                    assert_eq!(i % 3, 0);
                    assert_eq!(wrench, beside.solver.wrench(state));
                    assert_eq!(feedback, given);
                    assert_eq!(turns, output.angle.turns);
                    assert_eq!(contacts, beside.solver.contacts(state).to_vec());
                }
                Said::Events {
                    slips,
                    longest_slip,
                    list,
                } => {
                    events += 1;
                    assert_eq!((slips, longest_slip), (output.slips, output.longest_slip));
                    assert_eq!(list, output.events());
                }
                other => panic!("{other:?}"),
            }
        }
        if !output.events().is_empty() {
            events -= 1;
        }
    }
    assert_eq!((poses, forces, events), (450, 300, 0));
}

#[test]
fn what_happened_between_two_poses_is_reported_with_the_next() {
    let mut rig = Rig::<f32>::new();
    rig.mode(|mode| (mode.pose_every, mode.events, mode.health_every) = (50, false, 0));
    let mut beside = Beside::<f32>::new(&Mode::DEFAULT);
    let mut happened = Vec::new();
    for hand in hand_path(1_000) {
        rig.hand(hand);
        happened.extend_from_slice(beside.step(hand).events());
        for received in rig.received() {
            let Said::Pose(pose) = received.said else {
                assert!(matches!(received.said, Said::Reply(_)), "{received:?}");
                continue;
            };
            for event in [Event::Touch, Event::Lift, Event::Slip, Event::Land] {
                assert_eq!(pose.events.contains(event), happened.contains(&event));
            }
            happened.clear();
        }
    }
}

#[test]
fn a_pose_for_which_there_is_no_room_keeps_its_events_for_the_next() {
    let mut rig = Rig::<f32, 0>::new();
    rig.stay(Hand::new(0.0, 0.055, 0.0), 3);
    rig.line.room = 0;
    // It lands.
    rig.hand(Hand::new(0.0, 0.045, 0.0));
    assert_eq!(rig.health().unsent, 2, "its pose and its events");
    let last = rig.received().pop().unwrap();
    rig.line.room = usize::MAX;
    rig.hand(Hand::new(0.0, 0.045, 0.0));
    let received = rig.received();
    let next = last.sequence.wrapping_add(1);
    assert_eq!(received[0].sequence, next, "only what was sent is counted");
    let Said::Pose(pose) = &received[0].said else {
        panic!("{received:?}")
    };
    assert!(pose.events.contains(Event::Land), "{pose:?}");
}
