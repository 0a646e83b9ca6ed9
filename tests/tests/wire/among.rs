//! Messages about obstacles, version 3: they arrive as they were sent, the messages for a scene without obstacles do not change, a
//! peer of version 2 gets a fault for each message that it must not miss, and an invalid message is a fault.

use crate::malformed::bare;
use crate::random::{Random, Store};
use crate::round_trip::scene;
use crate::said::Said;
use crate::{Either, decoded, decoded_among, encoded, sealed, times};
use stiction_core::{Description, ObstacleDescription, Scene, Touch, WithObstacles, Wrench};
use stiction_wire::{
    CommandAmong, ContactAmong, FaultKind, Faults, Forces, Frame, List, ObstacleList, Reference,
    Report, ReportAmong, SceneAmong, VERSION, VERSION_AMONG, obstacle_bytes, scene_bytes,
    wire_bytes,
};

const PIN: ObstacleDescription<'static, f32> = ObstacleDescription {
    vertices: &[[0.0, 0.1]],
    friction_static: 0.5,
    friction_dynamic: 0.3,
    memory: None,
};

fn to_board(obstacles: &[ObstacleDescription<'_, f32>]) -> Vec<u8> {
    let message = SceneAmong {
        scene: scene(&[[0.0; 2]]),
        obstacles: ObstacleList::from(obstacles),
    };
    let frame = Frame {
        sequence: 0,
        time: 0,
        message: CommandAmong::SceneAmong(message),
    };
    let mut wire = [0; crate::WIRE];
    frame.encode(&mut wire).map_or(Vec::new(), <[u8]>::to_vec)
}

fn forces(touch: Touch) -> Option<Vec<u8>> {
    let contact = [ContactAmong {
        touch,
        direction: [0.0, 1.0],
        point: [0.0; 2],
        normal: 1.0,
        friction: 0.5,
        sliding: 0,
    }];
    let message = ReportAmong::ForcesAmong(Forces {
        wrench: Wrench::default(),
        feedback: Wrench::default(),
        turns: 0,
        contacts: List::from(&contact),
    });
    let frame = Frame {
        sequence: 0,
        time: 0,
        message,
    };
    frame.encode(&mut [0; 100]).map(<[u8]>::to_vec)
}

#[test]
fn random_messages_about_obstacles_arrive_as_they_were_sent() {
    let mut random = Random(21);
    for i in 0..times(20_000) {
        let store = Store::fill(&mut random, if i % 50 == 0 { 255 } else { 12 });
        let sent = store.frame_among(&mut random);
        let wire = sent.encoded();
        decoded_among(&wire, sent.to_board(), |received| {
            let received = received.expect("an undamaged frame");
            assert_eq!(Said::of(&received), Said::of(&sent));
            assert_eq!(
                received.encoded(),
                wire,
                "a received message can be sent on"
            );
        });
    }
}

/// The messages for a scene without obstacles consist of the same bytes, whichever versions sender and receiver have.
#[test]
fn other_messages_are_those_of_peers_without_obstacles() {
    let mut random = Random(22);
    for _ in 0..times(5_000) {
        let store = Store::fill(&mut random, 12);
        let sent = store.frame(&mut random);
        let wire = sent.encoded();
        decoded_among(&wire, sent.to_board(), |received| {
            let received = received.expect("an undamaged frame");
            assert_eq!(Said::of(&received), Said::of(&sent));
            assert_eq!(received.encoded(), wire);
        });
    }
}

#[test]
fn peer_of_version_2_is_told_of_what_it_must_not_miss() {
    let mut random = Random(23);
    let mut told = 0;
    for _ in 0..times(2_000) {
        let store = Store::fill(&mut random, 5);
        let sent = store.frame_among(&mut random);
        let (bytes, to_board) = bare(&sent);
        let [version, code, sequence] = [bytes[0], bytes[1], bytes[2]];
        let fault = decoded(&sent.encoded(), to_board, |received| received.err());
        let expected = match &sent {
            Either::CommandAmong(Frame {
                message: CommandAmong::Common(_),
                ..
            }) => None,
            // A peer without obstacles continues without them.
            Either::ReportAmong(Frame {
                message: ReportAmong::Room(_),
                ..
            }) => Some(FaultKind::UnknownType),
            Either::ReportAmong(Frame {
                message: ReportAmong::Common(_),
                ..
            }) if version == VERSION => None,
            _ => Some(FaultKind::Version),
        };
        assert_eq!(fault.map(|f| f.kind), expected, "{code:#x}");
        let named = fault.map(|f| f.frame);
        assert!(named.is_none_or(|frame| frame == Some(Reference { code, sequence })));
        assert_eq!(
            version == VERSION_AMONG,
            expected == Some(FaultKind::Version)
        );
        told += u32::from(version == VERSION_AMONG);
    }
    assert!(told > times(500));
}

#[test]
fn scene_among_obstacles_goes_through_and_is_refused_where_it_does_not_fit() {
    let wood = ObstacleDescription {
        vertices: &[[-0.5, -0.1], [0.0, -0.1], [0.0, 0.0], [-0.5, 0.0]],
        memory: Some(1e-5),
        ..PIN
    };
    let wall = [[0.2, 0.0], [0.2, 0.3]];
    let obstacles = [
        wood,
        PIN,
        ObstacleDescription {
            vertices: &wall,
            ..PIN
        },
    ];
    let described = Description {
        vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
        start: [-0.1, 0.03, 0.0],
        weight: 2.0,
        holding_point: Some([0.0, 0.02]),
        reach: 0.0,
        stiffness_translation: 500.0,
        stiffness_rotation: 0.5,
        surfaces: &[],
    };
    let wire = encoded(&Frame {
        sequence: 0,
        time: 0,
        message: CommandAmong::SceneAmong(SceneAmong::new(&described, &obstacles)),
    });
    assert!(wire.len() <= wire_bytes(scene_bytes(4, 0) + obstacle_bytes(3, 7)));
    decoded_among(&wire, true, |received| {
        let Ok(Either::CommandAmong(Frame {
            message: CommandAmong::SceneAmong(received),
            ..
        })) = received
        else {
            panic!("no scene");
        };
        let (mut v, mut c) = ([[0.0; 2]; 4], [[0.0; 2]; 7]);
        let mut o = [PIN; 3];
        let scene = received.scene.description(&mut v, &mut []);
        let scene = scene.expect("it fits");
        let there = received.obstacles.descriptions(&mut c, &mut o);
        let there = there.expect("they fit");
        assert_eq!((scene, there), (described, &obstacles[..]));
        Scene::<f32, 4, 0, WithObstacles<3, 7>>::among(&scene, there).expect("a scene");
        let error = |corners: usize, obstacles: usize| {
            let (mut c, mut o) = ([[0.0; 2]; 7], [PIN; 3]);
            let there = received.obstacles;
            let error = there.descriptions(&mut c[..corners], &mut o[..obstacles]);
            error.expect_err("one too many").to_string()
        };
        assert!(error(7, 2).starts_with("number of obstacles is 3.0"));
        assert!(error(6, 3).starts_with("number of corners of all obstacles is 7.0"));
    });
}

#[test]
fn more_than_can_be_counted_is_not_written() {
    let many = vec![[0.0; 2]; 256];
    let pins = vec![PIN; 256];
    let round = |corners| ObstacleDescription {
        vertices: &many[..corners],
        ..PIN
    };
    for (obstacles, fits) in [
        (&pins[..255], true),
        (&pins[..], false),
        (&[round(255)], true),
        (&[round(256)], false),
        (&[round(200), round(56)], false),
        (&[], true),
    ] {
        assert_eq!(!to_board(obstacles).is_empty(), fits, "{}", obstacles.len());
    }
}

#[test]
fn touch_that_cannot_be_told_is_not_written() {
    let corner = |obstacle, corner, body_side| Touch::Corner {
        obstacle,
        corner,
        body_side,
    };
    let side = |vertex, obstacle, side| Touch::Side {
        vertex,
        obstacle,
        side,
    };
    let surface = |vertex, surface| Touch::Surface { vertex, surface };
    for (touch, fits) in [
        (corner(254, 255, 127), true),
        (corner(255, 0, 0), false),
        (corner(0, 256, 0), false),
        (corner(0, 0, 128), false),
        (side(127, 254, 255), true),
        (side(128, 0, 0), false),
        (side(0, 255, 0), false),
        (side(0, 0, 256), false),
        (surface(127, 255), true),
        (surface(128, 0), false),
        (surface(0, 256), false),
    ] {
        assert_eq!(forces(touch).is_some(), fits, "{touch:?}");
    }
}

fn fault(bytes: &[u8], to_board: bool) -> Option<FaultKind> {
    decoded_among(&sealed(bytes), to_board, |received| {
        received.err().map(|fault| fault.kind)
    })
}

#[test]
fn truncated_and_extended_messages_about_obstacles_have_the_wrong_length() {
    let mut random = Random(24);
    for _ in 0..times(600).max(10) {
        let store = Store::fill(&mut random, 3);
        let frame = store.frame_among(&mut random);
        let (bytes, to_board) = bare(&frame);
        if matches!(
            &frame,
            Either::ReportAmong(Frame {
                message: ReportAmong::Common(Report::Reply(_) | Report::Info(_)),
                ..
            })
        ) {
            // It ends with a text of any length.
            continue;
        }
        for end in 3..bytes.len() {
            assert_eq!(fault(&bytes[..end], to_board), Some(FaultKind::Length));
        }
        for more in 1..=30 {
            let longer = [bytes.clone(), vec![0; more]].concat();
            assert_eq!(fault(&longer, to_board), Some(FaultKind::Length));
        }
    }
}

#[test]
fn versions_and_types_that_are_unknown_with_obstacles_are_told() {
    let reports = [0x80..=0x85, 0x90..=0x97];
    for code in 0..=255_u8 {
        let is_command = (1..=9).contains(&code);
        let is_report = reports.iter().any(|range| range.contains(&code));
        for (to_board, known) in [(true, is_command), (false, is_report)] {
            for version in [VERSION, VERSION_AMONG] {
                let kind = fault(&[version, code, 5, 0, 0, 0, 0], to_board);
                let told = kind == Some(FaultKind::UnknownType);
                assert_eq!(told, !known, "{code:#x}: {kind:?}");
            }
        }
    }
    for version in (0..=255).filter(|v| ![VERSION, VERSION_AMONG].contains(v)) {
        let bytes = [version, 7, 5, 0, 0, 0, 0];
        assert_eq!(fault(&bytes, true), Some(FaultKind::Version));
    }
}

#[test]
fn codes_of_obstacles_without_a_meaning_are_told() {
    let head = |code: u8| vec![VERSION_AMONG, code, 0, 0, 0, 0, 0];
    let with = |code: u8, payload: &[u8]| [head(code), payload.to_vec()].concat();
    let set = |mut payload: Vec<u8>, at: usize, byte: u8| {
        payload[at] = byte;
        payload
    };
    // Two obstacles with one corner each.
    let mut scene = vec![0; 41 + 2 * 14 + 2 * 8];
    (scene[39], scene[40], scene[41], scene[55]) = (2, 2, 1, 1);
    assert_eq!(fault(&with(0x09, &scene), true), None);
    let contact = [vec![0; 28], vec![1], vec![0; 28]].concat();
    assert_eq!(fault(&with(0x97, &contact), false), None);
    let half_plane = set(contact.clone(), 30, 255);
    assert_eq!(fault(&with(0x97, &half_plane), false), None);
    let subject = |code: u8| set(vec![0; 14], 3, code);
    assert_eq!(fault(&with(0x92, &subject(24)), false), None);
    for (to_board, bytes, field) in [
        (true, with(0x09, &set(scene.clone(), 2, 2)), "has_point"),
        (true, with(0x09, &set(scene.clone(), 50, 2)), "has_memory"),
        (true, with(0x09, &set(scene.clone(), 64, 2)), "has_memory"),
        (
            true,
            with(0x09, &set(scene.clone(), 41, 2)),
            "3 of 2 corners",
        ),
        (true, with(0x09, &set(scene, 55, 0)), "1 of 2 corners"),
        (false, with(0x97, &set(contact, 56, 2)), "sliding"),
        (false, with(0x97, &set(half_plane, 29, 0x80)), "its corner"),
        (false, with(0x92, &subject(25)), "subject"),
    ] {
        assert_eq!(fault(&bytes, to_board), Some(FaultKind::Value), "{field}");
    }
}

#[test]
fn any_payload_about_obstacles_is_a_message_or_a_fault() {
    let mut random = Random(25);
    let (mut messages, mut faults) = (0, Faults::new());
    for i in 0..times(100_000) {
        let code = [0x09, 0x97, 0x92, 0x96][i as usize % 4];
        let length = [41, 49, 55, 63, 85, 14, 2, 29, 57, random.below(90)][random.below(10)];
        // Mostly small bytes, so that counts and codes are often valid.
        let byte = |random: &mut Random| {
            if random.below(16) == 0 {
                random.byte()
            } else {
                random.byte() % 2
            }
        };
        let payload: Vec<u8> = (0..length).map(|_| byte(&mut random)).collect();
        let bytes = [&[VERSION_AMONG, code, 0, 0, 0, 0, 0], payload.as_slice()].concat();
        decoded_among(&sealed(&bytes), code < 0x80, |received| match received {
            Err(fault) => faults.count(fault.kind),
            Ok(frame) => {
                messages += 1;
                let again = frame.encoded();
                decoded_among(&again, code < 0x80, |heard| {
                    assert_eq!(heard.expect("a frame").encoded(), again);
                });
            }
        });
    }
    println!("{messages} messages, {faults:?}");
    assert!(messages > times(1000));
    for kind in [FaultKind::Length, FaultKind::Value] {
        assert!(faults.of(kind) > times(1000), "{faults:?}");
    }
}
