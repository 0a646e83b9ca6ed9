//! What is about obstacles, version 3: a scene goes through, and what cannot be counted is not written.

use crate::round_trip::scene;
use crate::{Either, decoded, encoded, first};
use stiction_core::{
    Description, ObstacleDescription, Scene, SurfaceDescription, Touch, WithObstacles, Wrench,
};
use stiction_tests::station::{BOX, FLOOR};
use stiction_wire::{
    CommandAmong, ContactAmong, Forces, Frame, List, ObstacleList, ReportAmong, SceneAmong,
    obstacle_bytes, scene_bytes, wire_bytes,
};

const PIN: ObstacleDescription<'static, f32> = ObstacleDescription {
    vertices: &[[0.0, 0.1]],
    friction_static: 0.5,
    friction_dynamic: 0.3,
    memory: None,
};

fn is_sent(touch: Touch) -> bool {
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
    first(message).encode(&mut [0; 100]).is_some()
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
    let corner = |i: u8| {
        let angle = std::f32::consts::TAU * f32::from(i) / 64.0;
        [0.05 * angle.cos(), 0.05 * angle.sin()]
    };
    let vertices: Vec<_> = (0..64).map(corner).collect();
    let surfaces = [SurfaceDescription {
        offset: -0.5,
        ..FLOOR
    }; 16];
    let described = Description {
        vertices: &vertices,
        start: [-0.1, 0.06, 0.0],
        weight: 2.0,
        surfaces: &surfaces,
        ..BOX
    };
    let sent = SceneAmong::new(&described, &obstacles);
    let wire = encoded(&first(CommandAmong::SceneAmong(sent)));
    assert!(wire.len() <= wire_bytes(scene_bytes(64, 16) + obstacle_bytes(3, 7)));
    decoded(&wire, true, |received| {
        let Ok(Either::Command(Frame {
            message: CommandAmong::SceneAmong(received),
            ..
        })) = received
        else {
            panic!("no scene");
        };
        let (mut v, mut s) = ([[0.0; 2]; 64], [FLOOR; 16]);
        let (mut c, mut o) = ([[0.0; 2]; 7], [PIN; 3]);
        let scene = received.scene.description(&mut v, &mut s);
        let scene = scene.expect("it fits");
        let there = received.obstacles.descriptions(&mut c, &mut o);
        let there = there.expect("they fit");
        assert_eq!((scene, there), (described, &obstacles[..]));
        Scene::<f32, 64, 16, WithObstacles<3, 7>>::among(&scene, there).expect("a scene");
        let error = |corners: usize, obstacles: usize| {
            let (mut c, mut o) = ([[0.0; 2]; 7], [PIN; 3]);
            let there = received.obstacles;
            let error = there.descriptions(&mut c[..corners], &mut o[..obstacles]);
            error.expect_err("one too many").to_string()
        };
        assert!(error(7, 2).starts_with("number of obstacles is 3.0"));
        assert!(error(6, 3).starts_with("number of corners of all obstacles is 7.0"));
        let refused = |vertices: usize, surfaces: usize| {
            let (mut v, mut s) = ([[0.0; 2]; 64], [FLOOR; 16]);
            let scene = received.scene;
            let error = scene.description(&mut v[..vertices], &mut s[..surfaces]);
            error.expect_err("too many").value
        };
        assert_eq!([refused(63, 16), refused(64, 1)], [64.0, 16.0]);
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
        let message = CommandAmong::SceneAmong(SceneAmong {
            scene: scene(&[[0.0; 2]]),
            obstacles: ObstacleList::from(obstacles),
        });
        let sent = first(message).encode(&mut [0; crate::WIRE]).is_some();
        assert_eq!(sent, fits, "{}", obstacles.len());
    }
}

#[test]
fn touch_that_cannot_be_counted_is_not_written() {
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
        assert_eq!(is_sent(touch), fits, "{touch:?}");
    }
}
