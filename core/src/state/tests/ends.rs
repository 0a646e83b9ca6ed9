//! The end of a motion: in balance to the digits; and bodies without a spring or without pressure.

use super::*;
use crate::fixtures::{Random, sampled};
use crate::geometry::Vec2;
use crate::model::{Frictionless, Full};

/// The end of a path is in balance to the digits of its angle.
#[test]
fn end_of_a_way_is_in_balance() {
    let point = on_floor::<1, Full>(&[[0.0, 0.0]], (0.3, 2.0), 0.9);
    let mut count = [0; 2];
    for seed in sampled(0..300, 29) {
        let mut random = Random(seed);
        let mut grip = |y: f64| Grip {
            holding_point: Vec2::new(0.5, 0.0),
            hand: Vec2::new(0.2 * random.next(), y),
            angle: Angle::from_radians(2.0 * random.next()),
        };
        let free = ContactState::Free(Free::new(Pose {
            position: Vec2::new(0.0, 3.0),
            orientation: Orientation::new(Angle::default()),
        }));
        let mut vertex = ContactState::SingleVertex(SingleVertex::new(pivot(0.3)));
        vertex.set_regime(Regime::Stick { stiction: true });
        for (i, (begin, y)) in [(free, 3.0), (vertex, -1.2)].into_iter().enumerate() {
            let (from, to) = (grip(y), grip(y));
            let mut state = begin;
            if state.relax(&point, &from, Relax::default()).trigger != Trigger::Balanced {
                continue;
            }
            let moved = state.advance(&point, &from, &to);
            if moved.trigger != Trigger::Balanced || moved.unsure {
                continue;
            }
            let placed = match state.anchor() {
                Ok(pivot) => pivot.placed(&point),
                Err(pose) => Placed {
                    point: pose.position + pose.orientation.rotation().apply(to.holding_point),
                    body_point: to.holding_point,
                    orientation: pose.orientation,
                    on: None,
                },
            };
            let moment = Load::new(&point, placed, &to).moment();
            assert!(moment.abs() < 1e-14, "{seed}: {moment}");
            count[i] += 1;
        }
    }
    assert!(
        cfg!(miri) || count.iter().all(|count| *count > 30),
        "{count:?}"
    );
}

/// A body that nothing turns keeps its angle, to the bit.
#[test]
fn body_without_weight_and_spring_keeps_its_angle() {
    let rod = fixtures::sprung::<2, 1>(&[[0.0, 0.0], [1.0, 0.0]], &[0.0], 0.0);
    let orientation = Orientation::new(Angle::from_radians(0.3));
    let mut state = ContactState::Free(Free::new(Pose {
        position: Vec2::new(0.0, 3.0),
        orientation,
    }));
    let grip = Grip {
        holding_point: Vec2::new(0.5, 0.0),
        hand: Vec2::new(0.5, 4.0),
        angle: Angle::from_radians(1.0),
    };
    let moved = state.relax(&rod, &grip, Relax::default());
    assert_eq!(moved.trigger, Trigger::Balanced);
    assert_eq!(state.pose(&rod).orientation, orientation);
}

/// A gliding tip of a tool is certified if it presses, not if it just touches.
#[test]
fn tip_that_does_not_press_is_not_certified() {
    let point = on_floor::<1, Frictionless>(&[[0.0, 0.0]], (0.0, 1.0), 0.0);
    for (press, turn, follows) in [
        (0.0, 0.0, false),
        (0.0, 0.01, false),
        (-0.5, 0.0, false),
        (0.5, 0.0, true),
        (0.5, 0.01, true),
    ] {
        let grip = Grip {
            holding_point: Vec2::ZERO,
            hand: Vec2::new(0.0, -press),
            angle: Angle::from_radians(turn),
        };
        let mut state = ContactState::SingleVertex(SingleVertex::new(pivot(0.0)));
        assert_eq!(
            state.follow(&point, (&grip, &grip), &mut Work::within(0)),
            follows,
            "{press}"
        );
    }
}
