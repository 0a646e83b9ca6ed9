//! Obstacles: a scene goes through, and what cannot be counted is not written.

use crate::round_trip::scene;
use crate::{Either, decoded, encoded, first};
use stiction_core::{
    Contact, Description, ObstacleDescription, Scene, SurfaceDescription, Touch, WithObstacles,
    Wrench,
};
use stiction_tests::station::{BOX, FLOOR};
use stiction_wire::{
    Command, Forces, Frame, List, ObstacleList, Report, SceneCommand, scene_bytes, wire_bytes,
};

const PIN: ObstacleDescription<'static, f32> = ObstacleDescription {
    vertices: &[[0.0, 0.1]],
    friction_static: 0.5,
    friction_dynamic: 0.3,
    memory: None,
};

fn is_sent(touch: Touch) -> bool {
    let contact = [Contact {
        touch,
        direction: [0.0, 1.0],
        point: [0.0; 2],
        normal: 1.0,
        friction: 0.5,
        sliding: 0,
    }];
    let message = Report::Forces(Forces {
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
        obstacles: &obstacles,
        ..BOX
    };
    let sent = SceneCommand::from(&described);
    let wire = encoded(&first(Command::Scene(sent)));
    assert!(wire.len() <= wire_bytes(scene_bytes([64, 16, 3, 7])));
    decoded(&wire, true, |received| {
        let Ok(Either::Command(Frame {
            message: Command::Scene(received),
            ..
        })) = received
        else {
            panic!("no scene");
        };
        // With room for so many vertices, surfaces, obstacles and corners.
        let made = |[vertices, surfaces, obstacles, corners]: [usize; 4]| {
            let (mut v, mut c) = (vec![[0.0; 2]; vertices], vec![[0.0; 2]; corners]);
            let (mut s, mut o) = (vec![FLOOR; surfaces], vec![PIN; obstacles]);
            let made = received.description([&mut v, &mut c], &mut s, &mut o)?;
            assert_eq!(made, described);
            Scene::<f32, 64, 16, WithObstacles<3, 7>>::new(&made)
        };
        assert!(made([64, 16, 3, 7]).is_ok());
        for (room, error) in [
            ([63, 16, 3, 7], "number of vertices is 64.0"),
            ([64, 1, 3, 7], "number of surfaces is 16.0"),
            ([64, 16, 2, 7], "number of obstacles is 3.0"),
            ([64, 16, 3, 6], "number of corners of all obstacles is 7.0"),
        ] {
            let refused = made(room).expect_err("one too many").to_string();
            assert!(refused.starts_with(error), "{refused}");
        }
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
        let message = Command::Scene(SceneCommand {
            obstacles: ObstacleList::from(obstacles),
            ..scene(&[[0.0; 2]])
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
