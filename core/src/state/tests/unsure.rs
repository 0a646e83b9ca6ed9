//! If its search gives up, a verb reports it, or has done what it should all the same.

use super::*;
use crate::fixtures::{sampled, searches};
use crate::geometry::Vec2;
use crate::model::{Frictionless, Full};

/// A hand above the foot 0, turned.
fn hand(x: f64, y: f64, turn: f64) -> Grip<f64> {
    Grip {
        holding_point: Vec2::new(0.5, 0.0),
        hand: Vec2::new(x, y),
        angle: Angle::from_radians(turn),
    }
}

fn vertex(turn: f64) -> ContactState<f64> {
    ContactState::SingleVertex(SingleVertex::new(pivot(turn)))
}

/// With searches that give up after one step, two steps and so on: how many were uncertain, and how many gave up but were certain of the
/// same end.
#[track_caller]
fn honest(
    scene: &impl World<f64>,
    begin: &ContactState<f64>,
    verb: impl Fn(&mut ContactState<f64>) -> Moved<f64>,
) -> [usize; 2] {
    let mut whole = begin.clone();
    let end = verb(&mut whole);
    let mut seen = [0; 2];
    for most in sampled(1..200, 17) {
        let mut state = begin.clone();
        let (moved, counts) = searches::giving_up(most, || verb(&mut state));
        let (is, should) = (state.pose(scene), whole.pose(scene));
        if moved.unsure {
            assert!(counts.unsure > 0, "{most}");
            seen[0] += 1;
            continue;
        }
        seen[1] += usize::from(counts.unsure > 0);
        assert_eq!(moved.trigger, end.trigger, "{most}");
        let off = (is.position - should.position).length_bound();
        let turned = is.orientation.angle().minus(should.orientation.angle());
        assert!(off + turned.abs() < 1e-9, "{most}: {is:?} {should:?}");
    }
    seen
}

const TURNS: [f64; 3] = [-30.0, 8.0, 30.0];

#[test]
fn free_body_says_so() {
    let point = on_floor::<1, Full>(&[[0.0, 0.0]], (0.4, 1.0), 0.5);
    for turn in TURNS {
        let (from, to) = (hand(0.0, 4.0, 0.0), hand(1.0, 4.0, turn));
        let mut begin = ContactState::Free(Free::new(Pose {
            position: Vec2::new(-0.5, 3.6),
            orientation: Orientation::new(Angle::default()),
        }));
        begin.relax(&point, &from, Relax::default());
        let unsure = honest(&point, &begin, |s| s.advance(&point, &from, &to));
        assert!(unsure[0] > 0);
        let unsure = honest(&point, &begin, |s| s.relax(&point, &to, Relax::default()));
        assert!(unsure[0] > 0);
        // It hangs at the hand wherever that is.
        for most in 1..20 {
            let mut state = begin.clone();
            let (moved, _) = searches::giving_up(most, || state.advance(&point, &from, &to));
            let held = from.lerp(&to, moved.part).hand + point.weight();
            let pose = state.pose(&point);
            let holds = pose.position + pose.orientation.rotation().apply(to.holding_point);
            assert!((held - holds).length_bound() < 1e-12, "{turn} {most}");
        }
    }
}

#[test]
fn single_vertex_says_so() {
    let point = on_floor::<1, Full>(&[[0.0, 0.0]], (0.0, 1.0), 0.5);
    let rod = on_floor::<2, Full>(&[[0.0, 0.0], [1.0, 0.0]], (0.0, 1.0), 0.5);
    let from = hand(0.0, -0.5, 1.5);
    for turn in TURNS {
        let to = hand(0.1, -0.5, turn);
        let mut begin = vertex(1.5);
        begin.relax(&point, &from, Relax::default());
        let unsure = honest(&point, &begin, |s| s.advance(&point, &from, &to));
        assert!(unsure[0] > 0);
        let unsure = honest(&point, &begin, |s| s.relax(&point, &to, Relax::default()));
        assert!(unsure[0] > 0);
        // The other end of a rod reaches the floor.
        honest(&rod, &begin, |s| s.advance(&rod, &from, &to));
        let unsure = honest(&rod, &begin, |s| s.relax(&rod, &to, Relax::default()));
        assert!(unsure[0] > 0);
    }
}

#[test]
fn gliding_vertex_says_so() {
    let point = on_floor::<1, Frictionless>(&[[0.0, 0.0]], (0.0, 8.0), 0.0);
    let rod = on_floor::<2, Frictionless>(&[[0.0, 0.0], [1.0, 0.0]], (0.0, 8.0), 0.0);
    let from = hand(0.0, -2.5, 1.5);
    for turn in TURNS {
        let to = hand(0.1, -2.5, turn);
        let mut begin = vertex(1.5);
        let rests = begin.relax(&point, &from, Relax::default());
        assert_eq!(rests.trigger, Trigger::Balanced);
        let unsure = honest(&point, &begin, |s| s.relax(&point, &to, Relax::default()));
        assert!(unsure[0] > 0);
        let unsure = honest(&point, &begin, |s| s.advance(&point, &from, &to));
        assert!(unsure[0] > 0, "{unsure:?}");
        let unsure = honest(&rod, &begin, |s| s.relax(&rod, &to, Relax::default()));
        assert!(unsure[0] > 0);
    }
    // The foot is in balance with the hand at the reported position, whether the other end of a rod blocks it or not.
    for turn in [-4.0, -1.0, 4.0] {
        let to = hand(0.5, -2.5, turn);
        let mut begin = vertex(1.5);
        begin.relax(&rod, &from, Relax::default());
        for most in 1..20 {
            let mut state = begin.clone();
            let advance = || state.advance(&rod, &from, &to);
            let (moved, _) = searches::giving_up(most, advance);
            let ContactState::SingleVertex(SingleVertex { pivot, .. }) = state else {
                panic!("{state:?}");
            };
            let mut balanced = pivot;
            let edge = pivot.surface(&rod).sliding(1.0);
            balanced.slide(&rod, &from.lerp(&to, moved.part), &edge);
            assert!((balanced.foot - pivot.foot).abs() < 1e-12, "{turn} {most}");
        }
    }
}
