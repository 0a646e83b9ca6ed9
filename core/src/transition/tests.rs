//! The table arm by arm: each leads from the state that it is taken in to the one that it is taken to.

use super::*;
use crate::contact::Pair;
use crate::geometry::{Angle, Orientation, Pose, Vec2};
use crate::pivot::Pivot;
use crate::state::{Corner, Edge, Free, Locked, SingleVertex, TwoVertex};

use StateKind as Kind;

#[track_caller]
fn leads(arm: Transition, before: Kind, after: Kind) {
    assert_eq!((arm.before(), arm.after()), (Some(before), Some(after)));
}

#[test]
fn arm_of_a_touch_leads_from_state_to_state() {
    let lasts = |kind: Kind| match kind {
        Kind::NonContact => 0,
        Kind::SingleVertex => 1,
        Kind::Edge | Kind::TwoVertex | Kind::Corner => 2,
        Kind::Locked => 3,
    };
    for before in Kind::ALL {
        for after in Kind::ALL {
            if lasts(after) <= lasts(before) || before == Kind::Locked {
                continue;
            }
            let (arm, event) = touch_arm(before, after);
            leads(arm, before, after);
            let should = match after {
                Kind::Edge => Event::Land,
                Kind::Locked => Event::Jam,
                _ => Event::Touch,
            };
            assert_eq!(event, should, "{arm:?}");
        }
    }
}

#[test]
fn arm_of_what_lasts_leads_from_state_to_state() {
    for sliding in [true, false] {
        for before in [Kind::Edge, Kind::TwoVertex, Kind::Corner] {
            let (arm, event) = keep_arm(before, Kind::SingleVertex, sliding);
            leads(arm, before, Kind::SingleVertex);
            assert_eq!(event == Event::Tip, before == Kind::Edge);
        }
        for after in [
            Kind::SingleVertex,
            Kind::Edge,
            Kind::TwoVertex,
            Kind::Corner,
        ] {
            let (arm, event) = keep_arm(Kind::Locked, after, sliding);
            leads(arm, Kind::Locked, after);
            assert_eq!(event == Event::Tip, after == Kind::SingleVertex);
        }
    }
    for before in [Kind::Edge, Kind::TwoVertex] {
        let [slides, stays] = [true, false].map(|s| keep_arm(before, Kind::SingleVertex, s).0);
        assert!(slides.describe().contains("slides on") && !stays.describe().contains("slides on"));
    }
}

/// The arms of verbs within a state: it rests, slips, lifts off or turns over.
#[test]
fn arm_of_a_verb_leads_from_the_state() {
    let orientation = Orientation::new(Angle::<f64>::default());
    let pose = Pose {
        position: Vec2::ZERO,
        orientation,
    };
    let pivot = Pivot {
        contact: Pair::default(),
        foot: 0.0,
        orientation,
    };
    let other = Pair {
        vertex: 1,
        surface: 1,
    };
    let states = [
        ContactState::Free(Free::new(pose)),
        ContactState::SingleVertex(SingleVertex::new(pivot)),
        ContactState::Edge(Edge::new(
            pivot,
            Pair {
                vertex: 1,
                ..pivot.contact
            },
        )),
        ContactState::TwoVertex(TwoVertex::new(pivot, other)),
        ContactState::Corner(Corner {
            pivot,
            surface: 1,
            stiction: false,
        }),
        ContactState::Locked(Locked::new(pivot, &[other])),
    ];
    for (state, kind) in states.iter().zip(Kind::ALL) {
        assert_eq!(state.kind(), kind);
        leads(rest_arm(state), kind, kind);
        if kind != Kind::NonContact {
            leads(clear_arm(state), kind, Kind::NonContact);
        }
        if matches!(kind, Kind::SingleVertex | Kind::Edge | Kind::TwoVertex) {
            leads(slip_arm(state), kind, kind);
        }
        if matches!(kind, Kind::NonContact | Kind::SingleVertex | Kind::Corner) {
            leads(fold_arm(state), kind, kind);
        }
    }
}

#[test]
fn set_of_arms_has_what_was_added() {
    let mut all = Transitions::default();
    for (i, &arm) in Transition::ALL.iter().enumerate() {
        let mut one = Transitions::default();
        one.add(arm);
        assert!(one.iter().eq([arm]));
        assert!(!all.contains(arm));
        all.add(arm);
        all.add(arm);
        assert!(all.iter().eq(Transition::ALL.iter().copied().take(i + 1)));
        assert_eq!(all.union(one), all);
        assert_eq!(one.union(all), all);
    }
}
