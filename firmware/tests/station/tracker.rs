//! Six degrees of freedom: whatever the orientation of the tracker, the same motion in its plane gives the same trace.

use super::rig::Rig;
use crate::with;
use stiction_core::{Axis, Hand, TrackerSample};
use stiction_tests::station::client::hand_path;
use stiction_wire::{Command, Pose, Reset};

/// The sample of a tracker whose axes are those of the scene, shifted by this many: rotated by phi about the plane's normal.
fn sample(shift: usize, hand: &Hand<f32>, phi: f32) -> TrackerSample<f32> {
    let (sin, cos) = (phi / 2.0).sin_cos();
    let [x, y] = hand.position;
    let shifted = |vector| with(vector, |vector: &mut [f32; 3]| vector.rotate_right(shift));
    let [qx, qy, qz] = shifted([0.0, 0.0, sin]);
    TrackerSample {
        position: shifted([x, y, hand.depth]),
        orientation: [qx, qy, qz, cos],
        held: hand.held,
    }
}

/// The poses along a path that turns by two turns in all.
fn trace(shift: usize) -> Vec<Pose> {
    let mut rig = Rig::<f32>::new();
    let axis = |i| Axis {
        index: (i + shift) % 3,
        negative: false,
    };
    rig.mode(|mode| mode.plane = [axis(0), axis(1)]);
    rig.received();
    for hand in hand_path(500) {
        let phi = 2.0 * hand.angle.radians();
        rig.send(Command::Tracker(sample(shift, &hand, phi)));
        rig.tick();
    }
    rig.poses()
}

/// Of the planes of a mode, of which the solver's own tests try all.
#[test]
fn in_another_plane_the_same_motion_gives_the_same_trace() {
    let reference = trace(0);
    assert_eq!(reference.len(), 500);
    assert!(reference.iter().any(|pose| pose.turns == 1), "unwrapped");
    for shift in [1, 2] {
        assert_eq!(trace(shift), reference, "{shift}");
    }
}

#[test]
fn a_reset_of_the_body_counts_turns_from_none() {
    let mut rig = Rig::<f32>::new();
    let high = Hand::new(0.0, 0.2, 0.0);
    let turn = |rig: &mut Rig, from: i32, to: i32| {
        for i in from..=to {
            rig.send(Command::Tracker(sample(0, &high, i as f32 * 0.1)));
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
    let hand = Hand::new(0.0, 0.045, 0.0);
    rig.send(Command::Tracker(sample(0, &hand, 0.0)));
    rig.tick();
    let before = rig.pose();
    let lost = with(sample(0, &hand, 0.0), |lost| lost.orientation = [0.0; 4]);
    rig.send(Command::Tracker(lost));
    rig.tick();
    let pose = rig.pose();
    assert_eq!(pose.position, before.position);
    assert_eq!(pose.status, stiction_core::Status::HeldLast);
    assert!(pose.force_off);
}
