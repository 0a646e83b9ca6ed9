//! Every message arrives as it was sent, bit for bit, and takes as many bytes as FRAME.md states.

use crate::random::{Random, Store};
use crate::said::Said;
use crate::{Either, bare, decoded, encoded, first, sampled, times};
use stiction_core::{Angle, Hand};
use stiction_tests::station::BOX;
use stiction_wire::{
    Command, Frame, List, Pose, Reason, Reference, Reply, Report, SceneCommand, Text, VERSION,
    scene_bytes, wire_bytes,
};

#[test]
fn random_messages_arrive_as_they_were_sent() {
    let mut random = Random(1);
    for i in 0..times(40_000) {
        let store = Store::fill(&mut random, if i % 50 == 0 { 255 } else { 12 });
        let sent = store.frame(&mut random);
        let (wire, to_board) = (sent.encoded(), sent.to_board());
        assert_eq!(
            wire.iter().position(|b| *b == 0),
            Some(wire.len() - 1),
            "only the delimiter is 0"
        );
        decoded(&wire, to_board, |received| {
            let received = received.expect("an undamaged frame");
            assert_eq!(Said::of(&received), Said::of(&sent));
            let again = received.encoded();
            assert_eq!(again, wire, "a received message can be sent on");
        });
        assert_eq!(bare(&wire)[0], VERSION);
    }
}

#[test]
fn pose_takes_33_bytes_whatever_it_says() {
    let mut random = Random(2);
    for _ in 0..times(10_000) {
        let message = Report::Pose(crate::random::pose(&mut random));
        let frame = Frame {
            sequence: random.byte(),
            time: random.bits() as u32,
            message,
        };
        assert_eq!(encoded(&frame).len(), 33);
    }
}

#[test]
fn hand_takes_34_bytes_and_a_tracker_sample_42() {
    assert_eq!(
        encoded(&first(Command::Hand(Hand::new(0.1, 0.2, 0.3)))).len(),
        34
    );
    assert_eq!(wire_bytes(29), 42);
}

#[test]
fn frame_that_does_not_fit_is_not_written() {
    let frame = first(Command::Hand(Hand::new(0.1, 0.2, 0.3)));
    for room in 0..34 {
        assert!(frame.encode(&mut vec![0; room]).is_none(), "{room} bytes");
    }
    assert!(frame.encode(&mut [0; 34]).is_some());
    let many = vec![[0.0; 2]; 256];
    let scene = SceneCommand {
        vertices: List::from(many.as_slice()),
        ..scene(&[])
    };
    assert!(
        first(Command::Scene(scene))
            .encode(&mut [0; 9000])
            .is_none(),
        "256 vertices"
    );
}

#[test]
fn length_on_the_wire_has_its_bound() {
    let vertices: Vec<[f32; 2]> = (0..255)
        .map(|i| [f32::from_bits(0x0101_0101 + i); 2])
        .collect();
    for n in sampled(0..=255, 85) {
        let scene = SceneCommand {
            vertices: List::from(&vertices[..n]),
            ..scene(&[])
        };
        let wire = encoded(&first(Command::Scene(scene)));
        assert!(
            wire.len() <= wire_bytes(scene_bytes([n, 0, 0, 0])),
            "{n} vertices: {}",
            wire.len()
        );
    }
    // A payload without a 0 byte needs all of the capacity; FRAME 2.
    for n in sampled(0..2000, 253) {
        let longest = wire_bytes(n);
        assert_eq!(longest, n + 13 + (n + 11) / 254);
        let wire = crate::sealed(&vec![1; n + 7]);
        assert!(
            wire.len() <= longest && wire.len() + 2 > longest,
            "{n}: {} of {longest}",
            wire.len()
        );
    }
}

#[test]
fn turns_are_followed_from_pose_to_pose() {
    let mut random = Random(3);
    let (mut turns, mut known) = (
        0_i32,
        Angle {
            turns: 0,
            rest: 0.0,
        },
    );
    for _ in 0..times(100_000) {
        turns += random.below(8) as i32 - 4;
        let pose = Pose {
            turns: turns.rem_euclid(8) as u8,
            rest: 1.5,
            ..Pose::default()
        };
        known = pose.angle(known);
        assert_eq!(known, Angle { turns, rest: 1.5 });
    }
}

#[test]
fn reply_says_whether_the_command_was_carried_out() {
    let command = Reference {
        code: 3,
        sequence: 9,
    };
    assert!(Reply::done(command).is_done());
    for reason in Reason::ALL.into_iter().filter(|r| *r != Reason::Done) {
        assert!(!Reply::refused(command, reason).is_done(), "{reason:?}");
    }
}

#[test]
fn frame_is_referred_to_by_its_type_and_number() {
    let mut random = Random(5);
    for _ in 0..200 {
        let store = Store::fill(&mut random, 3);
        let frame = store.frame(&mut random);
        let reference = match &frame {
            Either::Command(frame) => frame.reference(),
            Either::Report(frame) => frame.reference(),
        };
        let bytes = bare(&frame.encoded());
        assert_eq!([reference.code, reference.sequence], bytes[1..3]);
    }
}

#[test]
fn list_knows_how_long_it_is() {
    let items = [[0.5_f32, 1.5], [2.5, 3.5]];
    for n in 0..=2 {
        let list = List::from(&items[..n]);
        assert_eq!((list.len(), list.is_empty()), (n, n == 0));
        assert!(list.iter().eq(items[..n].iter().copied()));
        assert_eq!(format!("{list:?}"), format!("{:?}", &items[..n]));
        assert_eq!(list == List::from(&items[..]), n == 2);
        assert_eq!(list == List::from(&[[0.5, 1.5]][..]), n == 1);
    }
}

#[test]
fn text_is_compared_by_its_characters() {
    assert!(Text::new("more than 0") == "more than 0");
    assert!(Text::new("") == "");
    assert_eq!(format!("{:?}", Text::new("more\n")), "\"more?\"");
    for other in ["", "more than", "more than 1", "more than 0 "] {
        assert!(Text::new("more than 0") != other, "{other}");
    }
}

pub(crate) fn scene(vertices: &[[f32; 2]]) -> SceneCommand<'_> {
    SceneCommand {
        vertices: List::from(vertices),
        surfaces: List::from(&[]),
        ..SceneCommand::from(&BOX)
    }
}
