//! Modes: what a board has the time and the line for, and that it works as its mode says (FRAME 4.5).

use crate::client::Said;
use crate::rig::{Rig, setup};
use stiction_core::Hand;
use stiction_core::frame::{Command, Mode, Reason, Stepping, Subject};
use stiction_firmware::station::Setup;

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

#[test]
fn event_limits_from_1_to_128() {
    let mut rig = Rig::<f32>::new();
    let mode = |event_limit| Mode {
        event_limit,
        ..Mode::DEFAULT
    };
    let subject = Subject::EventLimit;
    refused(&mut rig, mode(0), (Reason::Number, subject, 0.0, 1.0));
    refused(&mut rig, mode(129), (Reason::Number, subject, 129.0, 128.0));
    for event_limit in [1, 8, 128] {
        rig.mode(mode(event_limit));
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
    // 80 bytes the forces of two contacts.
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
    // At 115200 baud 300 poses fit, 1000 do not; with every sample as many as come, and these are longer.
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
    rig.heard();
    let mut times = Vec::new();
    for _ in 0..501 {
        rig.hand(Hand::new(0.0, 0.05, 0.0));
        let counted = rig.health();
        for heard in rig.heard() {
            if let Said::Health(health) = heard.said {
                times.push(heard.time);
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
