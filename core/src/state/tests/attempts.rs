//! Motions that are tried one after the other when contacts give way: none twice, until none is left.

extern crate std;

use super::*;
use crate::fixtures::{Random, sampled};
use crate::geometry::Vec2;
use crate::state::fixed_pose::FixedPose;

/// A block flat on a floor and against a wall, or on the floor below a ceiling, pushed and turned.
#[test]
fn every_motion_is_tried_once() {
    const MOTIONS: usize = 60;
    let quarter = core::f64::consts::FRAC_PI_2;
    let wall = scene(&[(quarter, [0.8, 0.0])]);
    let slot = scene(&[(2.0 * quarter, [0.0, 0.6 + 2e-6])]);
    let (mut most, mut pulled) = (0, [0; 2]);
    for seed in sampled(0..600, 29) {
        let mut random = Random(seed);
        let (room, contacts) = if seed % 2 == 0 {
            (&wall, [pair(0, 0), pair(1, 0), pair(1, 1), pair(2, 1)])
        } else {
            (&slot, [pair(0, 0), pair(1, 0), pair(2, 1), pair(3, 1)])
        };
        let count = 2 + usize::from(random.next() > 0.0) + usize::from(random.next() > 0.0);
        let contacts: Pairs = contacts.into_iter().take(count).collect();
        let pivot = pivot(0.0);
        let fixed_pose = FixedPose::new(room, &pivot, (&contacts, seed % 3 > 0));
        let middle = Vec2::new(0.4, 0.3);
        let grip = Grip {
            holding_point: middle,
            hand: middle + random.vector(),
            angle: Angle::from_radians(random.next()),
        };
        let test = |attempt: usize| fixed_pose.test(room, &grip, attempt).trigger;
        let first = test(0);
        if first == Trigger::Balanced {
            continue;
        }
        // The motion of the facet that yields comes first, and once more in its turn.
        let tried: std::vec::Vec<_> = (1..MOTIONS).map(test).collect();
        let motions = tried
            .iter()
            .take_while(|t| **t != Trigger::Undriven)
            .count();
        let (motions, rest) = tried.split_at(motions);
        for (i, motion) in motions.iter().enumerate() {
            let before = motions[..i].iter().filter(|m| *m == motion).count();
            // For two contacts that slide together there are two tests: whether they press as the slide begins, and at balance.
            let is_twice =
                matches!(motion, Trigger::Keep { contacts: [a, b], sliding: Some(_) } if a != b);
            assert!(before <= usize::from(is_twice), "{seed}: {motion:?}");
            assert_ne!(*motion, Trigger::Balanced);
        }
        assert!(
            !rest.is_empty() && rest.iter().all(|t| *t == Trigger::Undriven),
            "{seed}"
        );
        assert!(motions.is_empty() || first != Trigger::Undriven);
        // It leaves all of them if, and only if, all of them are pulled.
        let pull = grip.hand - middle;
        let mut normals = contacts.iter().map(|c| room.surface(c.surface).normal);
        let is_pulled = normals.all(|normal| normal.dot(pull) > 0.0);
        let leaves = motions.contains(&Trigger::Clear) || first == Trigger::Clear;
        assert_eq!(leaves, is_pulled, "{seed}");
        pulled[usize::from(is_pulled)] += 1;
        most = most.max(motions.len());
    }
    assert!(most > 1, "{most}");
    assert!(pulled.iter().all(|count| *count > 0), "{pulled:?}");
}
