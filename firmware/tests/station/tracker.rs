//! Six degrees of freedom: whatever the orientation of the tracker, the same motion in its plane gives the same trace.

use super::rig::Rig;
use stiction_core::{Axis, Hand, TrackerSample};
use stiction_tests::station::client::hand_path;
use stiction_wire::{Command, Mode, Pose, Reset};

type Vector = [f32; 3];

fn along(axis: Axis) -> Vector {
    let mut vector = [0.0; 3];
    vector[axis.index] = if axis.negative { -1.0 } else { 1.0 };
    vector
}

fn cross([a, b, c]: Vector, [x, y, z]: Vector) -> Vector {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// The sample of a tracker in whose space x and y of the scene are these axes: rotated by phi about their normal.
fn sample([x, y]: [Axis; 2], hand: &Hand<f32>, phi: f32) -> TrackerSample<f32> {
    let (x, y) = (along(x), along(y));
    let normal = cross(x, y);
    let [px, py] = hand.position;
    let (sin, cos) = (phi / 2.0).sin_cos();
    let [qx, qy, qz] = normal.map(|n| n * sin);
    TrackerSample {
        position: std::array::from_fn(|i| px * x[i] + py * y[i] + hand.depth * normal[i]),
        orientation: [qx, qy, qz, cos],
        held: hand.held,
    }
}

fn axis(code: usize) -> Axis {
    Axis {
        index: code % 3,
        negative: code >= 3,
    }
}

/// The poses along a path that turns by two turns in all.
fn trace(plane: [Axis; 2]) -> Vec<Pose> {
    let mut rig = Rig::<f32>::new();
    rig.mode(Mode {
        plane,
        ..Mode::DEFAULT
    });
    rig.received();
    for hand in hand_path(500) {
        let phi = 2.0 * hand.angle.radians();
        rig.send(Command::Tracker(sample(plane, &hand, phi)));
        rig.tick();
    }
    rig.poses()
}

#[test]
fn in_every_plane_the_same_motion_gives_the_same_trace() {
    let reference = trace([axis(0), axis(1)]);
    assert_eq!(reference.len(), 500);
    assert!(
        reference.iter().any(|pose| pose.turns == 1),
        "it is unwrapped"
    );
    let mut planes = 0;
    for (a, b) in (0..36).map(|i| (i / 6, i % 6)) {
        if a % 3 == b % 3 {
            continue;
        }
        planes += 1;
        let poses = trace([axis(a), axis(b)]);
        // Zeros have a sign.
        let key = |pose: &Pose| Pose { sample: 0, ..*pose };
        for (i, (pose, expected)) in poses.iter().zip(&reference).enumerate() {
            assert_eq!(key(pose), key(expected), "plane {a} {b}, sample {i}");
        }
    }
    assert_eq!(planes, 24);
}

#[test]
fn a_reset_of_the_body_counts_turns_from_none() {
    let mut rig = Rig::<f32>::new();
    let plane = [axis(0), axis(1)];
    let high = Hand::new(0.0, 0.2, 0.0);
    let turn = |rig: &mut Rig, from: i32, to: i32| {
        for i in from..=to {
            rig.send(Command::Tracker(sample(plane, &high, i as f32 * 0.1)));
            rig.tick();
        }
        let pose = rig.pose();
        f32::from(pose.turns) * std::f32::consts::TAU + pose.rest
    };
    assert!((turn(&mut rig, 0, 100) - 10.0).abs() < 1e-4);
    rig.done(Command::Reset(Reset::Body));
    let rest = 10.0 - 2.0 * std::f32::consts::TAU;
    assert!((turn(&mut rig, 100, 100) - rest).abs() < 1e-4);
}

#[test]
fn a_sample_without_an_orientation_is_lost() {
    let mut rig = Rig::<f32>::new();
    let plane = [axis(0), axis(1)];
    let hand = Hand::new(0.0, 0.045, 0.0);
    rig.send(Command::Tracker(sample(plane, &hand, 0.0)));
    rig.tick();
    let before = rig.pose();
    rig.send(Command::Tracker(TrackerSample {
        orientation: [0.0; 4],
        ..sample(plane, &hand, 0.0)
    }));
    rig.tick();
    let pose = rig.pose();
    assert_eq!(pose.position, before.position);
    assert_eq!(pose.status, stiction_core::Status::HeldLast);
}
