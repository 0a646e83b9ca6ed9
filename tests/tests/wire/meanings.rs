//! The meaning of single fields: the bits of events, a status of a later version.

use crate::random::Random;
use crate::{Either, bare, decoded, encoded, first};
use stiction_core::{Event, Status};
use stiction_wire::{EventSet, Frame, Pose, Report, VERSION};

/// FRAME.md 5.1.
#[test]
fn every_event_has_a_bit_of_its_own() {
    const EVENTS: usize = 7 + 17;
    for (bit, event) in Event::ALL.into_iter().enumerate() {
        let events = EventSet::of(&[event]);
        let message = Report::Pose(Pose {
            events,
            ..Pose::default()
        });
        let bytes = bare(&encoded(&first(message)));
        let bits = u16::from_le_bytes([bytes[EVENTS], bytes[EVENTS + 1]]);
        assert_eq!(bits, 1 << bit, "{event:?}");
        for other in Event::ALL {
            assert_eq!(
                events.contains(other),
                other == event,
                "{event:?} {other:?}"
            );
        }
    }
}

#[test]
fn union_of_events_has_those_of_both() {
    let all = &Event::ALL;
    for split in 0..=all.len() {
        for overlap in 0..=split {
            let (some, rest) = (EventSet::of(&all[..split]), EventSet::of(&all[overlap..]));
            assert_eq!(some.union(rest), EventSet::of(all));
            assert_eq!(some.union(EventSet::default()), some);
            assert_eq!(rest.union(rest), rest);
        }
    }
}

#[test]
fn grasp_and_release_are_two_events() {
    let both = EventSet::of(&[Event::Release, Event::Grasp]);
    assert!(both.contains(Event::Grasp) && both.contains(Event::Release));
    let one = EventSet::of(&[Event::Touch, Event::Release]);
    assert!(one.contains(Event::Touch) && one.contains(Event::Release));
    assert!(!one.contains(Event::Grasp) && !one.contains(Event::Slip));
}

/// A client that does not know a status treats the pose as one that may be out of balance, FRAME 5.1.
#[test]
fn status_to_come_is_taken_for_ambiguous() {
    let known = Status::ALL.len() as u8;
    let mut random = Random(7);
    for code in 0..16 {
        let mut raw = vec![VERSION, 0x81, 3, 0, 0, 0, 0];
        raw.extend((0..16).map(|_| random.byte()));
        raw.extend([code | 1 << 4, 5, 0xe0, 8]);
        decoded(&crate::sealed(&raw), false, |received| {
            let Ok(Either::Report(Frame {
                message: Report::Pose(pose),
                ..
            })) = received
            else {
                panic!("no pose");
            };
            assert_eq!(pose.status == Status::Ambiguous, code == 3 || code >= known);
            assert!(pose.held && !pose.force_off && pose.turns == 7);
            assert_eq!(pose.events, EventSet::of(&[Event::Touch, Event::Slip]));
        });
    }
}
