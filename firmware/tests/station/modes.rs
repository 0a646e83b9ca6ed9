//! Modes: what a board has the time and the line for, and that it behaves according to its mode (FRAME 4.5).

use super::commands::{Expected, answered};
use super::rig::{Rig, setup};
use crate::with;
use stiction_core::{Fixed, Hand, Real, Status};
use stiction_tests::station::beside::{Beside, assert_same};
use stiction_tests::station::client::Said;
use stiction_wire::{Command, Mode, Reason, Reset, Stepping, Subject};

/// Refused: the mode stays.
fn refused(rig: &mut Rig, change: impl FnOnce(&mut Mode), expected: Expected) {
    let before = rig.info().mode;
    answered(rig, Command::Mode(with(Mode::DEFAULT, change)), expected);
    assert_eq!(rig.info().mode, before);
}

#[test]
fn tick_rates_from_100_hz_to_what_the_board_can() {
    let mut rig = Rig::<f32>::new();
    for (rate, reason, limit) in [
        (99, Reason::Number, 100.0),
        (0, Reason::Number, 100.0),
        (5_001, Reason::Unsupported, 5_000.0),
    ] {
        let expected = (reason, Subject::TickRate, f32::from(rate), limit);
        refused(
            &mut rig,
            |m| (m.tick_rate, m.pose_every) = (rate, 10),
            expected,
        );
    }
    for rate in [100, 997, 3_000, 5_000] {
        rig.mode(|mode| (mode.tick_rate, mode.pose_every) = (rate, 10));
        assert_eq!(rig.station.mode().tick_rate, rate);
        for _ in 0..500 {
            rig.tick();
        }
    }
    assert_eq!(rig.health().missed_ticks, 0);
}

/// A board that does this many pieces of work per second.
fn working<R: Real<Si = f32>>(work_rate: u32) -> Rig<R> {
    Rig::of(with(setup(), |setup| setup.work_rate = work_rate))
}

#[test]
fn the_budget_of_a_step_follows_from_the_tick() {
    let mut rig = working::<f32>(10_000_000);
    for (tick_rate, budget) in [(1_000, 8_750), (100, 87_500), (2_500, 3_500)] {
        rig.mode(|mode| (mode.tick_rate, mode.pose_every) = (tick_rate, 10));
        assert_eq!(rig.info().budget, budget);
    }
    rig.done(Command::Reset(Reset::Everything));
    assert_eq!(rig.info().budget, 8_750);
    // A step takes at least one piece.
    assert_eq!(working::<f32>(0).info().budget, 1);
}

/// A box pressed down is dragged far in one sample.
fn jump() -> [Hand<f32>; 2] {
    [0.0, 0.1].map(|x| Hand::new(x, 0.045, 0.0))
}

fn comes_to_the_hand<R: Real<Si = f32>>() {
    let mut rig = working::<R>(64_000);
    let mut beside = Beside::<R>::new(&Mode::DEFAULT);
    let [near, far] = jump();
    for hand in [near, far] {
        rig.hand(hand);
        beside.step(hand);
    }
    let there = beside.step(far);
    let mut pose = rig.pose();
    assert_eq!(pose.status, Status::Behind);
    let mut ticks = 0;
    while pose.status == Status::Behind {
        assert!(ticks < 19 && pose.position[0] <= there.position[0]);
        assert!(!pose.force_off && rig.force.force[0].is_finite());
        rig.tick();
        pose = rig.pose();
        ticks += 1;
    }
    rig.tick();
    assert_same(&rig.pose(), &there, "caught up");
    assert!(ticks > 3, "{ticks} ticks");
}

#[test]
fn in_time_with_ticks_a_body_behind_the_hand_comes_to_it_without_samples() {
    comes_to_the_hand::<f32>();
    comes_to_the_hand::<Fixed>();
}

#[test]
fn with_every_sample_a_body_behind_the_hand_waits_for_the_next_one() {
    let mut rig = working::<f32>(0);
    rig.mode(|mode| mode.stepping = Stepping::PerSample);
    let mut beside = Beside::<f32>::new(&Mode::DEFAULT);
    beside.solver = beside.solver.with_budget(1);
    let [near, far] = jump();
    let back = Hand::new(0.1, 0.05, 0.1);
    for (i, hand) in [near, far, far, back, back].into_iter().enumerate() {
        rig.hand(hand);
        assert_same(&rig.pose(), &beside.step(hand), &format!("sample {i}"));
        rig.tick();
        assert!(rig.poses().is_empty());
    }
}

#[test]
fn poses_forces_and_health_must_fit_the_line() {
    let too_much = |bytes: f32, line| (Reason::Unsupported, Subject::LineRate, bytes + 74.0, line);
    let mut rig = Rig::<f32>::new();
    // 33 bytes a pose: 5000 of them are 165 kB.
    let expected = too_much(165_000.0, 92_160.0);
    refused(&mut rig, |mode| mode.tick_rate = 5_000, expected);
    rig.mode(|mode| (mode.tick_rate, mode.pose_every) = (5_000, 2));
    // The forces of two contacts are 98 bytes.
    let expected = too_much(131_000.0, 92_160.0);
    refused(&mut rig, |mode| mode.forces_every = 1, expected);
    rig.mode(|mode| mode.forces_every = 2);
    // At 115200 baud 300 poses fit, 1000 do not; with every sample there are as many as samples arrive, and these are
    // longer.
    let mut slow = Rig::<f32>::of(with(setup(), |setup| {
        (setup.line_rate, setup.mode.pose_every) = (11_520, 4);
    }));
    refused(&mut slow, |_| {}, too_much(33_000.0, 11_520.0));
    slow.mode(|mode| mode.tick_rate = 300);
    slow.mode(|mode| mode.stepping = Stepping::PerSample);
}

#[test]
fn health_comes_as_often_as_asked_and_tells_the_counts() {
    let mut rig = Rig::<f32>::new();
    rig.mode(|mode| mode.health_every = 50);
    rig.received();
    let mut times = Vec::new();
    for _ in 0..501 {
        rig.hand(Hand::new(0.0, 0.05, 0.0));
        let counted = rig.health();
        for received in rig.received() {
            if let Said::Health(health) = received.said {
                times.push(received.time);
                assert_eq!(
                    (health.samples, health.ticks),
                    (counted.samples, counted.ticks)
                );
            }
        }
    }
    assert_eq!(times.len(), 10);
    let mut pairs = times.windows(2);
    assert!(pairs.all(|pair| pair[1].wrapping_sub(pair[0]) == 50_000));
}

#[test]
fn a_mode_in_mid_contact_leaves_body_and_force_as_they_are() {
    let mut rig = Rig::<f32>::new();
    let deep = Hand::new(0.0, 0.045, 0.0);
    let before = rig.stay(deep, 60);
    let pose = rig.pose();
    rig.send(Command::Hand(deep));
    rig.mode(|mode| mode.tick_rate = 2_000);
    assert_eq!(rig.force, before);
    assert_eq!(rig.pose().position, pose.position);
    rig.tick();
    assert_eq!(rig.force, before);
    assert_eq!(rig.health().missed_ticks, 0);
}
