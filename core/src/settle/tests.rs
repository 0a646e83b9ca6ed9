//! The consequences of a trigger, and the counts of motions that were tried.

use super::*;
use crate::fixtures;
use crate::grip::Grip;
use crate::state::{Edge, SingleVertex};

use StateKind as Kind;

/// A point has one contact, which is not let go.
#[test]
fn point_keeps_its_contact() {
    let scene = fixtures::scene::<1, 1>(&[[0.0, 0.0]], &[0.0]);
    let mut state = ContactState::SingleVertex(SingleVertex::new(fixtures::pivot(0.3)));
    let begin = state.clone();
    let trigger = Trigger::Keep {
        contacts: [0, 0],
        sliding: None,
    };
    let mut log = Log::default();
    let next = apply(
        (&scene, &Grip::default()),
        &mut state,
        &Moved::by(trigger),
        0.0,
        &mut log,
    );
    assert_eq!((next, &state), (Next::Rest, &begin));
    assert!(log.ambiguous && log.transitions.iter().eq([Transition::Stays]));
    assert!(log.events.is_empty());
}

/// If no motion of its contact is consistent, a vertex next to it that was let go is taken back; if there is none, the body stays.
#[test]
fn contact_that_was_let_go_is_taken_back() {
    let scene = fixtures::scene::<2, 1>(&[[0.0, 0.0], [1.0, 0.0]], &[0.0]);
    for (angle, next, event) in [
        (0.0, Next::Relax(None), Some(Event::Land)),
        (0.3, Next::Rest, None),
    ] {
        let mut state = ContactState::SingleVertex(SingleVertex::new(fixtures::pivot(angle)));
        let mut log = Log::default();
        let moved = Moved::by(Trigger::Undriven);
        assert_eq!(
            apply(
                (&scene, &Grip::default()),
                &mut state,
                &moved,
                0.0,
                &mut log
            ),
            next
        );
        assert_eq!(log.events.first().copied(), event);
        assert_eq!(log.ambiguous, event.is_none());
        assert_eq!(state.contacts().len(), 1 + usize::from(event.is_some()));
    }
}

/// Neither a touch nor a lift happens if the search for it gave up earlier: the state continues.
#[test]
fn nothing_happens_where_a_search_gave_up() {
    let scene = fixtures::scene::<2, 1>(&[[0.0, 0.0], [1.0, 0.0]], &[0.0]);
    let begin = ContactState::SingleVertex(SingleVertex::new(fixtures::pivot(0.3)));
    let other = Pair {
        vertex: 1,
        surface: 0,
    };
    for trigger in [Trigger::Clear, Trigger::Touch(other)] {
        for (sliding, on) in [(0.0, None), (1.0, Some(1.0)), (-1.0, Some(-1.0))] {
            let moved = Moved {
                unsure: true,
                ..Moved::by(trigger)
            };
            let (mut state, mut log) = (begin.clone(), Log::default());
            let next = apply(
                (&scene, &Grip::default()),
                &mut state,
                &moved,
                sliding,
                &mut log,
            );
            assert_eq!((next, &state), (Next::Relax(on), &begin));
            assert!(log.events.is_empty());
        }
        let (mut state, mut log) = (begin.clone(), Log::default());
        apply(
            (&scene, &Grip::default()),
            &mut state,
            &Moved::by(trigger),
            0.0,
            &mut log,
        );
        assert!(state != begin && log.events.len() == 1);
    }
}

/// A contact that lasts keeps its position to the bit; another contact gets its position from the pose.
#[test]
fn pivot_that_lasts_stays_to_the_bit() {
    for i in 0..100 {
        let angle = 0.01 * f64::from(i);
        let scene = fixtures::scene::<2, 1>(&[[0.0, 0.0], [1.0, 0.0]], &[angle]);
        let pivot = Pivot {
            foot: 0.1 + angle,
            ..fixtures::pivot(angle)
        };
        let state = ContactState::Edge(Edge::new(
            pivot,
            Pair {
                vertex: 1,
                ..pivot.contact
            },
        ));
        let [first, second] = [0, 1].map(|vertex| Pair { vertex, surface: 0 });
        assert_eq!(pivot_of(&scene, &state, first), pivot);
        let other = pivot_of(&scene, &state, second);
        assert_eq!(other.contact, second);
        assert!((other.foot - pivot.foot - 1.0).abs() < 1e-12);
    }
}

/// Counted separately for contacts of two surfaces and of more.
#[test]
fn motions_that_were_tried_are_counted_for_each_kind_of_state() {
    for (kind, other) in [
        (Kind::TwoVertex, Kind::Locked),
        (Kind::Locked, Kind::TwoVertex),
    ] {
        let mut tried = Tried::default();
        assert!(!tried.any());
        for count in 0..5 {
            assert_eq!(tried.next(kind), count);
            assert!(tried.any());
        }
        assert_eq!([other, other, kind].map(|k| tried.next(k)), [0, 1, 5]);
        for single in [
            Kind::NonContact,
            Kind::SingleVertex,
            Kind::Edge,
            Kind::Corner,
        ] {
            assert_eq!([0; 3].map(|_| tried.next(single)), [0; 3]);
        }
    }
}
