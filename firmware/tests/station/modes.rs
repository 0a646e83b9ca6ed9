//! Modes: what a board has the time and the line for, and that it behaves according to its mode (FRAME 4.5).

use super::rig::{Rig, setup};
use stiction_core::{Hand, Status};
use stiction_firmware::station::Setup;
use stiction_tests::station::beside::{Beside, assert_same};
use stiction_tests::station::client::Said;
use stiction_wire::{Command, Mode, Reason, Reset, Stepping, Subject};

fn refused(rig: &mut Rig, mode: Mode, expected: (Reason, Subject, f32, f32)) {
    let before = rig.info().mode;
    let answer = rig.ask(Command::Mode(mode));
    let (reason, subject, value, limit) = expected;
    assert_eq!(
        (answer.reason, answer.subject),
        (reason, subject),
        "{answer:?}"
    );
    assert_eq!(answer.limit, limit, "{answer:?}");
    assert!(
        answer.value == value || answer.value.is_nan() && value.is_nan(),
        "{answer:?}"
    );
    assert_eq!(rig.info().mode, before);
}

#[test]
fn tick_rates_from_100_hz_to_what_the_board_can() {
    let mut rig = Rig::<f32>::new();
    let mode = |tick_rate| Mode {
        tick_rate,
        pose_every: 10,
        ..Mode::DEFAULT
    };
    refused(
        &mut rig,
        mode(99),
        (Reason::Number, Subject::TickRate, 99.0, 100.0),
    );
    refused(
        &mut rig,
        mode(0),
        (Reason::Number, Subject::TickRate, 0.0, 100.0),
    );
    refused(
        &mut rig,
        mode(5_001),
        (Reason::Unsupported, Subject::TickRate, 5_001.0, 5_000.0),
    );
    for rate in [100, 997, 3_000, 5_000] {
        rig.mode(mode(rate));
        assert_eq!(rig.station.mode().tick_rate, rate);
        for _ in 0..500 {
            rig.tick();
        }
    }
    assert_eq!(rig.health().missed_ticks, 0);
}

/// A board that does this many units of work per second.
fn working(work_rate: u32) -> Rig {
    Rig::of(Setup {
        work_rate,
        ..setup()
    })
}

#[test]
fn the_budget_of_a_step_follows_from_the_tick() {
    let mut rig = working(10_000_000);
    for (tick_rate, budget) in [(1_000, 8_750), (100, 87_500), (2_500, 3_500)] {
        rig.mode(Mode {
            tick_rate,
            pose_every: 10,
            ..Mode::DEFAULT
        });
        assert_eq!(rig.info().budget, budget);
    }
    rig.done(Command::Reset(Reset::Everything));
    assert_eq!(rig.info().budget, 8_750);
    assert_eq!(working(0).info().budget, 0);
}

/// A box pressed down is dragged far in one sample.
fn jump() -> [Hand<f32>; 2] {
    [0.0, 0.1].map(|x| Hand::new(x, 0.045, 0.0))
}

fn without_a_budget() -> Beside<f32> {
    Beside::new(&Mode::DEFAULT)
}

#[test]
fn in_time_with_ticks_a_body_behind_the_hand_comes_to_it_without_samples() {
    let mut rig = working(300_000);
    let mut beside = without_a_budget();
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
        assert!(ticks < 19 && pose.position[0] < there.position[0]);
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
fn with_every_sample_a_body_behind_the_hand_waits_for_the_next_one() {
    let mut rig = working(0);
    rig.mode(Mode {
        stepping: Stepping::PerSample,
        ..Mode::DEFAULT
    });
    let mut beside = without_a_budget();
    beside.solver = beside.solver.with_budget(0);
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
    let mut rig = Rig::<f32>::new();
    let health = 74.0;
    // 33 bytes a pose: 5000 of them are 165 kB.
    let mode = Mode {
        tick_rate: 5_000,
        ..Mode::DEFAULT
    };
    let line = Subject::LineRate;
    refused(
        &mut rig,
        mode,
        (Reason::Unsupported, line, 165_000.0 + health, 92_160.0),
    );
    rig.mode(Mode {
        pose_every: 2,
        ..mode
    });
    // The forces of two contacts are 80 bytes.
    let forces = Mode {
        forces_every: 1,
        ..Mode::DEFAULT
    };
    refused(
        &mut rig,
        forces,
        (Reason::Unsupported, line, 113_000.0 + health, 92_160.0),
    );
    rig.mode(Mode {
        forces_every: 2,
        ..forces
    });
    // At 115200 baud 300 poses fit, 1000 do not; with every sample there are as many as samples arrive, and these are
    // longer.
    let mut slow = Rig::<f32>::of(Setup {
        line_rate: 11_520,
        mode: Mode {
            pose_every: 4,
            ..Mode::DEFAULT
        },
        ..setup()
    });
    refused(
        &mut slow,
        Mode::DEFAULT,
        (Reason::Unsupported, line, 33_000.0 + health, 11_520.0),
    );
    slow.mode(Mode {
        tick_rate: 300,
        ..Mode::DEFAULT
    });
    slow.mode(Mode {
        stepping: Stepping::PerSample,
        ..Mode::DEFAULT
    });
}

#[test]
fn health_comes_as_often_as_asked_and_tells_the_counts() {
    let mut rig = Rig::<f32>::new();
    rig.mode(Mode {
        health_every: 50,
        ..Mode::DEFAULT
    });
    rig.received();
    let mut times = Vec::new();
    for _ in 0..501 {
        rig.hand(Hand::new(0.0, 0.05, 0.0));
        let counted = rig.health();
        for received in rig.received() {
            if let Said::Health(health) = received.said {
                times.push(received.time);
                assert_eq!(health.samples, counted.samples);
                assert_eq!(health.ticks, counted.ticks);
            }
        }
    }
    assert_eq!(times.len(), 10);
    assert!(
        times
            .windows(2)
            .all(|pair| pair[1].wrapping_sub(pair[0]) == 50_000)
    );
}

#[test]
fn a_mode_in_mid_contact_leaves_body_and_force_as_they_are() {
    let mut rig = Rig::<f32>::new();
    let deep = Hand::new(0.0, 0.045, 0.0);
    let before = rig.stay(deep, 60);
    let pose = rig.pose();
    rig.send(Command::Hand(deep));
    rig.mode(Mode {
        tick_rate: 2_000,
        pose_every: 1,
        ..Mode::DEFAULT
    });
    assert_eq!(rig.force, before);
    assert_eq!(rig.pose().position, pose.position);
    rig.tick();
    assert_eq!(rig.force, before);
    assert_eq!(rig.health().missed_ticks, 0);
}
