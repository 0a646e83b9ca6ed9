//! The board's own device from end to end: a hand moves the mechanism of the example device, and its motors push back.

use super::bed::{Bed, Shown};
use crate::size;
use std::f64::consts::TAU;
use stiction_core::{Hand, Status, Wrench};
use stiction_firmware::devices::pantograph::{GEOMETRY, MOTORS};
use stiction_tests::pantograph::{reference, transposed};
use stiction_tests::station::client::Said;
use stiction_wire::{Command, Drive, Mode, Reason, Reset, Subject};

/// 5 mm below where the held box would be on the floor: 2.5 N.
const DEEP: [f64; 3] = [0.0, 0.045, 0.0];

#[test]
fn a_hand_in_the_floor_feels_the_spring_in_its_joints() {
    for [x, y, phi] in [
        DEEP,
        [0.05, 0.046, 0.0],
        [-0.06, 0.044, 0.05],
        [0.02, 0.047, -0.06],
    ] {
        let mut bed = Bed::new();
        bed.stay([x, 0.06, phi], 30);
        let force = bed.stay([x, y, phi], 150);
        let torques = bed.torques();
        let wanted = transposed(&GEOMETRY, bed.angles(), &force);
        for (joint, motor) in MOTORS.iter().enumerate() {
            // Half a step of the PWM.
            let most = 0.51 * f64::from(motor.full_torque()) / 8_400.0 + 1e-5;
            let difference = torques[joint] - wanted[joint];
            assert!(difference.abs() <= most, "{joint}: {torques:?} {wanted:?}");
        }
    }
    let mut bed = Bed::new();
    let force = bed.stay(DEEP, 150);
    // A count is 0.3 mrad of 0.1 m: 30 µm of 500 N/m.
    assert!(force.force[0].abs() < 0.03 && (force.force[1] - 2.5).abs() < 0.03);
    // Up: the left joint clockwise, the right one counter-clockwise, the handle idle.
    let [left, right, handle] = bed.torques();
    assert!(left < -0.05 && (left + right).abs() < 0.01 && handle.abs() < 1e-3);
}

#[test]
fn the_motors_do_the_work_that_the_hand_is_reported() {
    let mut bed = Bed::new();
    bed.stay([0.0, 0.05, 0.0], 50);
    let (mut motors, mut hand) = (0.0, 0.0);
    let mut deepest = 0.0;
    let way = |i: u32| {
        // 5 mm down and 0.08 rad round, and back, each in a quarter of a second, with a continuous speed.
        let part = 0.5 - 0.5 * (f64::from(i) / 500.0 * TAU).cos();
        [0.0, 0.05 - 0.005 * part, 0.08 * part]
    };
    let mut before = (bed.angles(), reference(&GEOMETRY, bed.angles()));
    for i in 0..=500 {
        let force = bed.rig.force;
        let torques = bed.torques();
        bed.place(way(i));
        let now = (bed.angles(), reference(&GEOMETRY, bed.angles()));
        for (torque, (to, from)) in torques.iter().zip(now.0.iter().zip(before.0)) {
            motors += torque * (to - from);
        }
        let [dx, dy, dphi] = std::array::from_fn(|k| now.1[k] - before.1[k]);
        let [fx, fy] = force.force.map(f64::from);
        hand += fx * dx + fy * dy + f64::from(force.moment) * dphi;
        before = now;
        bed.rig.tick();
        if i == 250 {
            deepest = motors;
        }
    }
    // The springs store 1/2 k_h d^2 + 1/2 k_theta phi^2 = 6.25 mJ + 1.6 mJ, and return it except for the displacement of half a tick.
    assert!((motors - hand).abs() < 2e-5, "{motors} {hand}");
    assert!((deepest + 7.85e-3).abs() < 4e-4, "{deepest}");
    assert!(motors.abs() < 4e-4, "{motors}");
}

#[test]
fn a_force_is_never_larger_than_its_limit_nor_grows_faster_after_power_up() {
    let mut bed = Bed::new();
    let mut before = bed.rig.force;
    for _ in 0..150 {
        // 40 mm deep: 20 N.
        let force = bed.at([0.0, 0.01, 0.0]);
        assert!(size(&force) <= 5.0);
        assert!(size(&force) <= size(&before) + 0.1 + 1e-5);
        before = force;
    }
    // The springs hold no more than 0.1 N·m do at 0.5 N·m/rad: 10 mJ, at 500 N/m 3.16 N.
    assert!((size(&before) - 10.0_f32.sqrt()).abs() < 1e-3, "{before:?}");
    // Then it follows at once.
    let force = bed.at(DEEP);
    assert!((size(&force) - 2.5).abs() < 0.03, "{force:?}");
}

#[test]
fn an_encoder_that_fails_is_zero_force_at_once_and_the_way_back_is_slow() {
    let unreadable = |shown: &mut Shown| shown.counts = None;
    // Counts were lost: both proximal links lean inwards by 15 degrees, and the elbows coincide.
    let folded = |shown: &mut Shown| shown.counts = Some([61_527, 3_473, 7]);
    let failures: [&dyn Fn(&mut Shown); 2] = [&unreadable, &folded];
    for fail in failures {
        let mut bed = Bed::new();
        bed.stay(DEEP, 100);
        let pose = bed.rig.pose();
        assert!(!bed.is_off());
        for tick in 0..40 {
            fail(&mut bed.shown.borrow_mut());
            assert_eq!(bed.rig.tick(), Wrench::default());
            assert!(bed.is_off());
            let held = bed.rig.pose();
            assert!(held.force_off && held.position == pose.position);
            assert_eq!(held.sample, pose.sample);
            assert_eq!(bed.rig.health().drive, Drive::Silent);
            // Silence is reported before 20 ms have passed, with the tick after which the next, if late, would be too late; the force was
            // gone before.
            assert_eq!(held.status == Status::HeldLast, tick >= 18, "{tick}");
        }
        let mut before = 0.0;
        for _ in 0..100 {
            let now = size(&bed.at(DEEP));
            assert!((now - before).abs() <= 0.1 + 1e-5);
            before = now;
        }
        assert!((before - 2.5).abs() < 0.03);
        let back = bed.rig.pose();
        assert!(!back.force_off && back.position == pose.position);
        assert_eq!(bed.rig.health().drive, Drive::On);
    }
}

#[test]
fn the_switch_lets_go_and_there_is_no_force() {
    let mut bed = Bed::new();
    bed.stay(DEEP, 100);
    bed.shown.borrow_mut().held = false;
    bed.stay(DEEP, 40);
    assert!(bed.is_off() && !bed.rig.pose().held);
}

#[test]
fn samples_of_the_line_are_refused_once_and_change_nothing() {
    let (mut bed, mut alone) = (Bed::new(), Bed::new());
    let mut refused = 0;
    for i in 0..300u32 {
        let way = [0.03 * f64::from(i) / 300.0, 0.046, 0.0];
        bed.rig.send(Command::Hand(Hand::new(0.01, 0.03, 0.5)));
        if i == 200 {
            bed.rig.send(Command::Hello);
        }
        assert_eq!(bed.at(way), alone.at(way));
        let mut poses = Vec::new();
        for said in bed.rig.reports() {
            let Said::Reply(answer) = said else {
                if let Said::Pose(pose) = said {
                    poses.push(pose);
                }
                continue;
            };
            refused += 1;
            assert!(i == 0 || i == 201, "{i}");
            let said = (answer.command.code, answer.reason, answer.subject);
            assert_eq!(said, (1, Reason::Unsupported, Subject::Command));
            assert!(
                answer
                    .allowed
                    .to_string()
                    .contains("measures the hand itself")
            );
        }
        assert_eq!(poses, alone.rig.poses());
    }
    assert_eq!(refused, 2);
    let health = bed.rig.health();
    let counts = [health.samples, health.late_samples, health.lost_frames];
    assert_eq!(counts, [300, 0, 0]);
}

#[test]
fn a_pose_names_the_boards_own_sample() {
    let mut bed = Bed::new();
    for i in 1..=600u32 {
        bed.at(DEEP);
        assert_eq!(u32::from(bed.rig.pose().sample), i % 256);
    }
}

#[test]
fn a_motor_that_fails_is_off_until_everything_is_reset() {
    let mut bed = Bed::new();
    bed.stay(DEEP, 100);
    *bed.motors[1].broken.borrow_mut() = true;
    bed.at(DEEP);
    assert!(bed.is_off());
    *bed.motors[1].broken.borrow_mut() = false;
    for _ in 0..50 {
        assert_eq!(bed.at(DEEP), Wrench::default());
        let pose = bed.rig.pose();
        assert!(bed.is_off() && pose.force_off);
        assert_eq!(pose.status, Status::Ok, "the pose goes on");
    }
    assert_eq!(bed.rig.health().drive, Drive::Latched);
    for refused in [Command::Reset(Reset::Body), Command::Mode(Mode::DEFAULT)] {
        assert_eq!(bed.rig.ask(refused).reason, Reason::NotNow);
    }
    bed.rig.send(Command::Ping);
    bed.rig.tick();
    assert!(
        bed.rig
            .reports()
            .any(|said| matches!(said, Said::Pong { .. }))
    );
    assert_eq!(bed.rig.info().name, "bench");
    bed.rig.done(Command::Reset(Reset::Everything));
    assert!(size(&bed.rig.force) <= 0.1 + 1e-5);
    bed.stay(DEEP, 100);
    assert!(size(&bed.rig.force) > 2.4 && !bed.is_off());
    assert_eq!(bed.rig.health().drive, Drive::On);
}

#[test]
fn a_handle_that_turns_on_and_on_keeps_its_turns() {
    let mut bed = Bed::new();
    for i in 0..3_000 {
        bed.at([0.0, 0.09, f64::from(i) / 500.0 * TAU]);
    }
    let pose = bed.rig.pose();
    let turned = f64::from(pose.turns) + f64::from(pose.rest) / TAU;
    assert!((turned - 2_999.0 / 500.0).abs() * TAU < 0.1, "{turned}");
}
