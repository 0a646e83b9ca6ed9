//! States that a scene cannot have do not move and bear nothing, even if their numbers are sound: the verbs of such a state are not
//! compiled.

use super::*;
use crate::geometry::Vec2;
use crate::model::{Frictionless, Full};

/// States of a vertex of the floor and others, at the foot 0 of a body along the floor.
fn states() -> [ContactState<f64>; 4] {
    let pivot = pivot(0.0);
    [
        ContactState::Edge(Edge::new(pivot, pair(1, 0))),
        ContactState::TwoVertex(TwoVertex::new(pivot, pair(1, 0))),
        ContactState::Corner(Corner {
            pivot,
            surface: 1,
            stiction: false,
        }),
        ContactState::Locked(Locked::new(pivot, &[pair(1, 0), pair(1, 1)])),
    ]
}

/// Held in the middle, pulled by a force.
fn grip(force: (f64, f64)) -> Grip<f64> {
    Grip {
        holding_point: Vec2::new(0.5, 0.0),
        hand: Vec2::new(force.0 - 0.5, force.1),
        angle: Angle::default(),
    }
}

/// A point that touches off the origin of its body, where a second vertex would lie.
#[test]
fn point_on_one_surface_has_one_contact() {
    let scene = on_floor::<1, Full>(&[[1.0, 0.0]], (0.0, 1.0), 0.5);
    for force in [(0.0, -1.0), (2.0, -1.0), (-2.0, -1.0), (0.1, 0.3)] {
        let (grip, before) = (grip(force), grip((0.0, -1.1)));
        for begin in states() {
            let mut state = begin.clone();
            assert!(!state.follow(&scene, (&before, &grip), &mut Work::within(0)));
            let moved = [
                state.advance(&scene, &before, &grip),
                state.relax(&scene, &grip, Relax::default()),
                state.snap(&scene, &grip, (1.0, &mut None)),
                state.slip(&scene, &grip, (1.0, &mut None)),
                state.slip(&scene, &grip, (-1.0, &mut None)),
            ];
            for moved in moved {
                assert_eq!(moved.trigger, Trigger::Undriven, "{begin:?}");
            }
            let load = pivot(0.0).load(&scene, &grip);
            assert!(state.reactions(&scene, &grip, &load).0.is_empty());
            assert_eq!(state, begin);
        }
    }
    let seated = ContactState::seated(&scene, pivot(0.0), &[pair(1, 0)]);
    assert_eq!(seated.kind(), StateKind::SingleVertex);
}

/// A gliding contact is in balance along the floor: it does not slip.
#[test]
fn what_glides_does_not_slip() {
    let rod = on_floor::<2, Frictionless>(&[[0.0, 0.0], [1.0, 0.0]], (0.0, 1.0), 0.0);
    let pivot = pivot(0.0);
    let begin = [
        ContactState::SingleVertex(SingleVertex::new(pivot)),
        ContactState::Edge(Edge::new(pivot, pair(1, 0))),
    ];
    for mut state in begin {
        let before = state.clone();
        let moved = state.slip(&rod, &grip((2.0, -1.0)), (1.0, &mut None));
        assert_eq!(moved.trigger, Trigger::Undriven);
        assert_eq!(state, before);
    }
}

/// On one surface a body is never seated on two.
#[test]
fn rod_on_one_surface_is_seated_on_that() {
    let rod = on_floor::<2, Full>(&[[0.0, 0.0], [1.0, 0.0]], (0.0, 1.0), 0.5);
    let kind = |others: &[Pair]| ContactState::seated(&rod, pivot(0.0), others).kind();
    assert_eq!(kind(&[]), StateKind::SingleVertex);
    assert_eq!(kind(&[pair(1, 0)]), StateKind::Edge);
    assert_eq!(kind(&[pair(1, 1)]), StateKind::SingleVertex);
    assert_eq!(kind(&[pair(1, 0), pair(1, 1)]), StateKind::SingleVertex);
}
