//! Scenes with obstacles on a board with room for some (FRAME 4.4, 5.2): bit for bit like a solver run in parallel; scenes that do not
//! fit are refused with the numbers.

use super::rig::{Nothing, Rig, S, V};
use crate::{SAME, with};
use stiction_core::{
    Description, Evolution, Hand, ObstacleDescription, Parameter, Real, Scene, StateKind, Touch,
};
use stiction_tests::station::BOX;
use stiction_tests::station::beside::{Beside, assert_same};
use stiction_tests::station::client::Said;
use stiction_wire::{
    Command, Reason, Reset, SceneCommand, Stepping, Subject, frame_bytes, scene_bytes,
};

const LONGEST: usize = frame_bytes(scene_bytes([V, S, 16, 16]));
/// The board's capacity of corners.
const CORNERS: usize = 16;
/// A board with room for obstacles.
type Among<R> = Rig<R, CORNERS, Nothing, LONGEST>;

const TABLE: ObstacleDescription<'static, f32> = ObstacleDescription {
    vertices: &[[-0.4, -0.04], [0.0, -0.04], [0.0, 0.0], [-0.4, 0.0]],
    friction_static: 0.5,
    friction_dynamic: 0.3,
    memory: None,
};
const PIN: ObstacleDescription<'static, f32> = ObstacleDescription {
    vertices: &[[0.08, 0.02]],
    ..TABLE
};
/// The box over the edge of a table, with a pin in front of it.
const EDGE: Description<'static, f32> = Description {
    start: [-0.02, 0.03, 0.0],
    weight: 2.0,
    surfaces: &[],
    ..BOX
};
const OBSTACLES: [ObstacleDescription<'static, f32>; 2] = [TABLE, PIN];

fn among<'a>(
    description: &'a Description<'a, f32>,
    obstacles: &'a [ObstacleDescription<'a, f32>],
) -> Command<'a> {
    Command::Scene(SceneCommand::from(&Description {
        obstacles,
        ..*description
    }))
}

fn edge() -> Command<'static> {
    among(&EDGE, &OBSTACLES)
}

/// Pressed, drawn over the edge until the box tips, against the pin, up and away, and released.
fn hands() -> impl Iterator<Item = Hand<f32>> {
    let legs: [[f32; 3]; 7] = [
        [-0.02, 0.05, 0.0],
        [-0.02, 0.045, 0.0],
        [0.02, 0.043, 0.0],
        [0.05, 0.02, -0.5],
        [0.07, 0.0, -0.9],
        [0.0, 0.08, 0.3],
        [-0.1, 0.04, 0.0],
    ];
    (0..1_200).map(move |i| {
        let (leg, part) = (i / 200, (i % 200) as f32 / 200.0);
        let at = |k: usize| legs[leg][k] + (legs[leg + 1][k] - legs[leg][k]) * part;
        let hand = Hand::new(at(0), at(1), at(2));
        with(hand, |hand| hand.held = !(900..905).contains(&i))
    })
}

/// Every pose and all forces have the bits of a solver run in parallel; records which states and kinds of contacts occurred.
fn every_sample_is_stepped<R: Real<Si = f32>>(evolution: Evolution) {
    let mut rig = Among::<R>::new();
    rig.done(edge());
    rig.mode(|mode| {
        (mode.evolution, mode.stepping) = (evolution, Stepping::PerSample);
        (mode.tick_rate, mode.forces_every, mode.health_every) = (500, 1, 0);
    });
    let there = Scene::<R, V, S, CORNERS>::new(&Description {
        obstacles: &OBSTACLES,
        ..EDGE
    });
    let there = there.expect("a scene");
    let mut beside = Beside::solving(there, evolution);
    let (mut states, mut kinds) = (Vec::new(), [false; 2]);
    for (i, hand) in hands().enumerate() {
        rig.client.inbox.clear();
        rig.hand(hand);
        let output = beside.step(hand);
        let (solver, state) = (&beside.solver, beside.state.as_ref().expect("it has begun"));
        let (mut poses, mut forces) = (0, 0);
        for said in rig.reports() {
            match said {
                Said::Pose(pose) => {
                    assert_same(&pose, &output, &format!("sample {i}"));
                    poses += 1;
                }
                Said::Forces {
                    wrench,
                    turns,
                    contacts: said,
                    ..
                } => {
                    assert_eq!((wrench, turns), (solver.wrench(state), output.angle.turns));
                    assert_eq!(said[..], solver.contacts(state)[..], "sample {i}");
                    let touches = |pick: fn(&Touch) -> bool| said.iter().any(|c| pick(&c.touch));
                    kinds[0] |= touches(|touch| matches!(touch, Touch::Side { .. }));
                    kinds[1] |= touches(|touch| matches!(touch, Touch::Corner { .. }));
                    forces += 1;
                }
                Said::Events { .. } => {}
                other => panic!("{other:?}"),
            }
        }
        assert_eq!((poses, forces), (1, 1), "sample {i}");
        if !states.contains(&output.state) {
            states.push(output.state);
        }
    }
    assert_eq!(kinds, [true; 2], "sides and corners are touched");
    use StateKind::{Edge, NonContact, SingleVertex};
    let visited = [NonContact, SingleVertex, Edge].map(|state| states.contains(&state));
    assert_eq!(visited, [true; 3], "{states:?}");
}

stiction_tests::test_on_boards!(every_sample_is_stepped_among_obstacles_bit_for_bit: every_sample_is_stepped);

#[test]
fn a_board_without_room_says_so_and_changes_nothing() {
    let mut rig = Rig::<f32>::new();
    rig.stay(Hand::new(0.02, 0.045, 0.1), 60);
    let before = rig.pose();
    let answer = rig.ask(edge());
    let said = (answer.reason, answer.subject, answer.value, answer.limit);
    let obstacles = Subject::Scene(Parameter::ObstacleCount);
    assert_eq!(said, (Reason::Unsupported, obstacles, 2.0, 0.0));
    rig.tick();
    let after = rig.pose();
    assert_eq!((before.position, before.rest), (after.position, after.rest));
}

#[test]
fn scenes_among_obstacles_that_cannot_be_used_are_refused_with_the_numbers() {
    use Parameter as P;
    let nan = f32::NAN;
    let round: [[f32; 2]; 16] = std::array::from_fn(|i| {
        let (sin, cos) = (std::f32::consts::TAU * i as f32 / 16.0).sin_cos();
        [1.0 + 0.2 * cos, 0.2 * sin]
    });
    let round = with(TABLE, |o| o.vertices = &round);
    let clockwise = with(TABLE, |o| {
        o.vertices = &[[0.2, 0.0], [0.2, 0.1], [0.3, 0.0]]
    });
    let slippery = with(PIN, |o| o.friction_static = 0.1);
    let empty = with(PIN, |o| o.vertices = &[]);
    let sunk = with(EDGE, |d| d.start = [-0.02, 0.02, 0.0]);
    let many = with(EDGE, |d| d.vertices = &[[0.0; 2]; 9]);
    let corner = P::Corner {
        obstacle: 1,
        corner: 2,
    };
    let mut rig = Among::<f32>::new();
    rig.done(edge());
    rig.stay(Hand::new(-0.02, 0.045, 0.1), 60);
    let before = rig.pose();
    for (description, obstacles, parameter, value, limit) in [
        (&EDGE, &[round, PIN][..], P::CornerCount, 17.0, 16.0),
        (&EDGE, &[TABLE, clockwise], corner, 0.3, nan),
        (&EDGE, &[PIN, empty], P::Corners(1), 0.0, nan),
        (&EDGE, &[slippery], P::ObstacleFrictionStatic(0), 0.1, nan),
        (&sunk, &[TABLE], P::Overlap(0), 0.01, nan),
        (&many, &[TABLE], P::VertexCount, 9.0, 8.0),
    ] {
        let answer = rig.ask(among(description, obstacles));
        // Only what is too large for the board has a limit.
        let reason = match limit.is_nan() {
            true => Reason::Number,
            false => Reason::Unsupported,
        };
        assert_eq!(answer.reason, reason, "{answer:?}");
        assert_eq!(answer.subject, Subject::Scene(parameter));
        assert!((answer.value - value).abs() < 1e-6, "{answer:?}");
        let limits = [answer.limit, limit];
        assert!(limits[0] == limits[1] || limits.iter().all(|limit| limit.is_nan()));
        assert!(answer.allowed != "");
    }
    rig.tick();
    let after = rig.pose();
    assert_eq!((before.position, before.rest), (after.position, after.rest));
    // An allowed scene is accepted: 16 corners.
    rig.done(among(&EDGE, &[round]));
}

#[test]
fn obstacles_stay_and_their_friction_follows_the_parameters() {
    let mut rig = Among::<f32>::new();
    rig.done(edge());
    let info = rig.info();
    assert_eq!(
        [info.vertices, info.surfaces, info.corners],
        [V as u8, S as u8, 16]
    );
    assert_eq!(usize::from(info.longest_frame), LONGEST);
    assert_eq!(info.friction_now, [0.5, 0.3], "of the first obstacle");
    // 10 mm down and 4 mm along: it sticks, and slips once mu_s is less than 0.4 of the load.
    rig.stay(Hand::new(-0.02, 0.04, 0.0), 60);
    rig.stay(Hand::new(-0.016, 0.04, 0.0), 60);
    let stuck = rig.pose();
    assert_eq!(stuck.state, StateKind::Edge);
    rig.done(Command::Parameters(with(SAME, |p| {
        (p.friction_static, p.friction_dynamic, p.memory) = (0.1, 0.1, Some(0.0));
    })));
    let info = rig.info();
    assert_eq!(
        (info.friction_now, info.memory_now),
        ([0.1, 0.1], Some(0.0))
    );
    rig.stay(Hand::new(-0.016, 0.04, 0.0), 2);
    let slid = rig.pose();
    // The weight of 2 N presses, too: 0.1 (5 + 2) N of friction are 1.4 mm.
    assert!(
        (slid.position[0] + 0.0174).abs() < 2e-5,
        "{slid:?} {stuck:?}"
    );
    assert!((stuck.position[0] + 0.02).abs() < 1e-5, "{stuck:?}");
    // The body goes back to its start, the obstacles stay; after a reset of everything there is the board's own scene.
    rig.done(Command::Reset(Reset::Body));
    rig.stay(Hand::new(-0.02, 0.045, 0.0), 2);
    assert_eq!(rig.pose().state, StateKind::Edge);
    rig.done(Command::Reset(Reset::Everything));
    assert_eq!(rig.info().friction_now, [0.5, 0.3]);
}
