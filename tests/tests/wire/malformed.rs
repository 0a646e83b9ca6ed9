//! An invalid message is reported by its kind, and changes nothing.

use crate::random::{Random, Store};
use crate::{Either, bare, decoded, encoded, first, sealed, times};
use stiction_core::Status;
use stiction_wire::{
    Command, Decoder, Fault, FaultKind, Faults, Frame, Reason, Reference, Reply, Report, VERSION,
    frame_bytes,
};

/// Of a frame with this header and payload.
fn fault(bytes: &[u8], to_board: bool) -> Option<Fault> {
    decoded(&sealed(bytes), to_board, |received| received.err())
}

/// A text may have any length.
fn ends_with_text(frame: &Either<'_>) -> bool {
    matches!(
        frame,
        Either::Report(Frame {
            message: Report::Reply(_) | Report::Info(_),
            ..
        })
    )
}

#[test]
fn truncated_and_extended_payloads_have_the_wrong_length() {
    let mut random = Random(6);
    for _ in 0..times(1200).max(10) {
        let store = Store::fill(&mut random, 3);
        let frame = store.frame(&mut random);
        let (bytes, to_board) = (bare(&frame.encoded()), frame.to_board());
        let fault = |bytes: &[u8]| fault(bytes, to_board);
        let length = |frame| {
            Some(Fault {
                kind: FaultKind::Length,
                frame,
            })
        };
        let reference = Some(Reference {
            code: bytes[1],
            sequence: bytes[2],
        });
        for end in 0..bytes.len() {
            let fault = fault(&bytes[..end]);
            let text = ends_with_text(&frame) && end >= 21;
            if !text || fault.is_some() {
                let expected = length(reference.filter(|_| end >= 3));
                assert_eq!(fault, expected, "{end} of {bytes:?}");
            }
        }
        for more in 1..=30 {
            let longer = [bytes.clone(), vec![b'x'; more]].concat();
            let expected = length(reference).filter(|_| !ends_with_text(&frame));
            assert_eq!(fault(&longer), expected);
        }
    }
}

#[test]
fn unknown_types_and_other_versions_are_faults() {
    for code in 0..=255_u8 {
        let is_command = (1..=10).contains(&code);
        let is_report = (0x80..=0x85).contains(&code) || (0x90..=0x96).contains(&code);
        for (to_board, known) in [(true, is_command), (false, is_report)] {
            let kind = fault(&[VERSION, code, 5, 0, 0, 0, 0], to_board).map(|f| f.kind);
            if known {
                assert!(matches!(kind, None | Some(FaultKind::Length)), "{code:#x}");
            } else {
                assert_eq!(kind, Some(FaultKind::UnknownType), "{code:#x}");
            }
        }
    }
    let frame = Some(Reference {
        code: 7,
        sequence: 5,
    });
    let expected = Some(Fault {
        kind: FaultKind::Version,
        frame,
    });
    for version in (0..=255).filter(|v| *v != VERSION) {
        // Whatever else is in its head.
        for bytes in [&[version, 7, 5, 0, 0, 0, 0][..], &[version, 7, 5]] {
            assert_eq!(fault(bytes, true), expected);
        }
    }
}

#[test]
fn codes_without_a_meaning_are_faults() {
    let with = |code: u8, payload: &[u8]| [&[VERSION, code, 0, 0, 0, 0, 0], payload].concat();
    let set = |mut payload: Vec<u8>, at: usize, byte: u8| {
        payload[at] = byte;
        payload
    };
    let mode = vec![0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0];
    let scene = [&[0, 1], [0; 64].as_slice()].concat();
    // The last contact is a vertex on a half-plane.
    let contact = [vec![0; 28], vec![1], vec![0; 28]].concat();
    let half_plane = set(contact.clone(), 30, 255);
    let info = [vec![0; 45], mode.clone(), b"name".to_vec()].concat();
    let subject = |code: u8| set(vec![0; 14], 3, code);
    // Two obstacles with one corner each.
    let mut pins = vec![0; 41 + 2 * 14 + 2 * 8];
    (pins[2], pins[3], pins[41], pins[55]) = (2, 2, 1, 1);
    for (to_board, bytes) in [
        (true, with(0x04, &pins)),
        (false, with(0x90, &contact)),
        (false, with(0x90, &half_plane)),
        (false, with(0x92, &subject(24))),
        (false, with(0x92, &subject(48))),
        (false, with(0x92, &subject(54))),
    ] {
        assert_eq!(fault(&bytes, to_board), None, "{bytes:?}");
    }
    let event = [0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 11];
    let cases = [
        (true, with(0x01, &set(vec![0; 21], 20, 2)), "held"),
        (true, with(0x02, &set(vec![0; 29], 28, 255)), "held"),
        (true, with(0x03, &set(vec![0; 21], 16, 2)), "has_memory"),
        (true, with(0x04, &set(vec![0; 41], 4, 2)), "has_point"),
        (true, with(0x04, &set(scene, 61, 2)), "has_memory"),
        (true, with(0x05, &set(mode.clone(), 0, 2)), "evolution"),
        (true, with(0x05, &set(mode.clone(), 1, 2)), "stepping"),
        (true, with(0x05, &set(mode.clone(), 2, 3)), "axis_x"),
        (true, with(0x05, &set(mode.clone(), 2, 8)), "axis_x"),
        (true, with(0x05, &set(mode.clone(), 3, 4)), "the same axis"),
        (true, with(0x05, &set(mode.clone(), 4, 2)), "events"),
        (true, with(0x08, &[2]), "what"),
        (true, with(0x09, &set(vec![0; 34], 16, 2)), "encoder"),
        (true, with(0x09, &set(vec![0; 34], 29, 2)), "motor"),
        (false, with(0x96, &set(vec![0; 35], 0, 3)), "source"),
        (false, with(0x80, &set(vec![0; 20], 16, 1 << 6)), "flags"),
        (false, with(0x80, &set(vec![0; 20], 18, 1 << 3)), "events"),
        (false, with(0x80, &set(vec![0; 20], 18, 1 << 4)), "events"),
        (false, with(0x90, &set(contact.clone(), 56, 2)), "sliding"),
        (false, with(0x90, &set(contact, 56, 0xfe)), "sliding"),
        (false, with(0x91, &event), "event"),
        (false, with(0x92, &set(vec![0; 14], 2, 9)), "reason"),
        (false, with(0x92, &subject(25)), "subject"),
        (false, with(0x92, &subject(47)), "subject"),
        (false, with(0x92, &subject(55)), "subject"),
        (false, with(0x92, &set(vec![0; 15], 14, 0x1f)), "allowed"),
        (false, with(0x93, &set(info.clone(), 3, 2)), "number"),
        (false, with(0x93, &set(info.clone(), 7, 2)), "actuators"),
        (false, with(0x93, &set(info.clone(), 40, 2)), "has_memory"),
        (false, with(0x93, &set(info.clone(), 45, 2)), "mode"),
        (false, with(0x93, &set(info, 58, 0x7f)), "name"),
        (false, with(0x94, &set(vec![0; 61], 0, 3)), "drive"),
        (true, with(0x04, &set(pins.clone(), 50, 2)), "has_memory"),
        (true, with(0x04, &set(pins.clone(), 64, 2)), "has_memory"),
        (true, with(0x04, &set(pins.clone(), 41, 2)), "3 of 2"),
        (true, with(0x04, &set(pins, 55, 0)), "1 of 2"),
        (false, with(0x90, &set(half_plane, 29, 0x80)), "its corner"),
    ];
    for (to_board, bytes, field) in cases {
        let kind = fault(&bytes, to_board).map(|f| f.kind);
        assert_eq!(kind, Some(FaultKind::Value), "{field}");
    }
}

#[test]
fn only_a_frame_that_came_undamaged_is_answered() {
    let frame = Some(Reference {
        code: 3,
        sequence: 9,
    });
    let answered = [
        (FaultKind::Version, Reason::Version),
        (FaultKind::UnknownType, Reason::UnknownType),
        (FaultKind::Length, Reason::Length),
        (FaultKind::Value, Reason::Code),
    ];
    for kind in FaultKind::ALL {
        let reply = Reply::to_fault(&Fault { kind, frame });
        let expected = answered
            .iter()
            .find(|(k, _)| *k == kind)
            .map(|(_, reason)| *reason);
        assert_eq!(reply.map(|r| r.reason), expected);
        assert!(Reply::to_fault(&Fault { kind, frame: None }).is_none());
    }
}

#[test]
fn frame_for_which_there_is_no_room_is_a_fault_and_the_next_one_found() {
    let ping = encoded(&first(Command::Ping));
    let mut board = Decoder::<{ frame_bytes(0) }>::new();
    let noise = [[0xff; 1000].as_slice(), &[0]].concat();
    let mut pings = 0;
    for &byte in noise
        .iter()
        .chain(&ping)
        .chain(&noise)
        .chain(&ping)
        .chain(&[0, 0, 0])
    {
        if let Some(received) = board.push::<Command>(byte) {
            pings += usize::from(received.is_ok());
        }
    }
    assert_eq!(pings, 2);
    assert_eq!(
        (
            board.faults().of(FaultKind::TooLong),
            board.faults().total()
        ),
        (2, 2)
    );
    // The longest frame that fits, and one with one more byte.
    for (n, kind) in [
        (frame_bytes(0) - 4, None),
        (frame_bytes(0) - 3, Some(FaultKind::TooLong)),
    ] {
        let bytes = [&[VERSION, 7, 0, 0, 0, 0, 0], vec![1; n - 7].as_slice()].concat();
        let mut board = Decoder::<{ frame_bytes(0) }>::new();
        let end = sealed(&bytes)
            .iter()
            .filter_map(|&b| board.push::<Command>(b).map(|r| r.err()))
            .last();
        assert_eq!(end.flatten().map(|f| f.kind), kind);
    }
}

#[test]
fn faults_are_counted_apart_and_stay_at_their_greatest() {
    let mut faults = Faults::new();
    for (i, kind) in FaultKind::ALL.into_iter().enumerate() {
        (0..=i).for_each(|_| faults.count(kind));
    }
    for (i, kind) in FaultKind::ALL.into_iter().enumerate() {
        assert_eq!(faults.of(kind) as usize, i + 1);
    }
    assert_eq!(faults.total(), 28);
}

/// What is sent on without its unused bits, which are ignored.
fn has_unused_bits(frame: &Either<'_>, bytes: &[u8]) -> bool {
    match frame {
        Either::Command(Frame { message, .. }) => match message {
            Command::Scene(scene) => {
                let without_memory = scene.surfaces.iter().any(|s| s.memory.is_none());
                let has_obstacles = !scene.obstacles.is_empty();
                scene.holding_point.is_none() || without_memory || has_obstacles
            }
            Command::Parameters(p) => p.memory.is_none(),
            _ => false,
        },
        Either::Report(Frame { message, .. }) => match message {
            Report::Info(info) => info.memory_now.is_none(),
            Report::Pose(pose) => pose.status == Status::Ambiguous,
            Report::Reply(_) => bytes[11..13] != [0, 0],
            _ => false,
        },
    }
}

#[test]
fn any_payload_under_a_right_checksum_is_a_message_or_a_fault() {
    let mut random = Random(15);
    let (mut messages, mut faults) = (0, Faults::new());
    for i in 0..times(300_000) {
        let code = match i % 2 {
            0 => 1 + random.byte() % 10,
            _ => 0x80 + random.byte() % 0x17,
        };
        // Mostly small bytes, so that counts and codes are often valid.
        let lengths = [
            0,
            1,
            2,
            5,
            14,
            20,
            21,
            29,
            34,
            35,
            41,
            48,
            49,
            54,
            55,
            58,
            61,
            63,
            85,
            random.below(90),
        ];
        let length = lengths[random.below(lengths.len())];
        let byte = |random: &mut Random| {
            if random.below(8) == 0 {
                random.byte()
            } else {
                random.byte() % 3
            }
        };
        let payload: Vec<u8> = (0..length).map(|_| byte(&mut random)).collect();
        let bytes = [&[VERSION, code, 0, 0, 0, 0, 0], payload.as_slice()].concat();
        let is_command = code < 0x80;
        decoded(&sealed(&bytes), is_command, |received| match received {
            Err(fault) => faults.count(fault.kind),
            Ok(frame) => {
                messages += 1;
                let again = frame.encoded();
                let same = bare(&again)[1..] == bytes[1..];
                assert!(same || has_unused_bits(&frame, &bytes), "{bytes:?}");
                decoded(&again, is_command, |received| {
                    assert_eq!(received.expect("a frame").encoded(), again);
                });
            }
        });
    }
    println!("{messages} messages, {faults:?}");
    assert!(messages > times(4000));
    let kinds = [FaultKind::UnknownType, FaultKind::Length, FaultKind::Value];
    assert!(kinds.iter().all(|kind| faults.of(*kind) > times(500)));
    let all = kinds.iter().map(|kind| faults.of(*kind)).sum::<u32>();
    assert_eq!(all, faults.total());
}
