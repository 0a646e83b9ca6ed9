//! Scenes that a client sends: a good one begins at its start, an unusable one is refused and changes nothing (FRAME 4
//! and 5.4).

use super::commands::{PARAMETERS, deep, refused, seen};
use super::rig::{Rig, setup};
use stiction_core::{Bare, Description, Hand, Parameter, Status, SurfaceDescription};
use stiction_firmware::station::Setup;
use stiction_tests::station::client::scene;
use stiction_tests::station::{BOX, FLOOR};
use stiction_wire::{Command, Reason, SceneCommand, Subject};

const WALL: SurfaceDescription<f32> = SurfaceDescription {
    normal: [1.0, 0.0],
    offset: -0.2,
    ..FLOOR
};

pub(crate) const TRIANGLE: Description<'static, f32> = Description {
    vertices: &[[-0.04, -0.02], [0.04, -0.02], [0.0, 0.03]],
    start: [0.0, 0.05, 0.0],
    weight: 1.0,
    holding_point: None,
    surfaces: &[FLOOR, WALL],
    ..BOX
};

#[test]
fn a_scene_in_mid_contact_begins_at_its_start() {
    let mut rig = Rig::<f32>::new();
    rig.stay(Hand::new(0.05, 0.045, 0.2), 60);
    rig.done(scene(&TRIANGLE));
    let pose = rig.pose();
    assert!(!pose.held && pose.status == Status::HeldLast);
    assert!((pose.position[1] - 0.05).abs() < 1e-6);
    assert_eq!(rig.force.force, [0.0, 0.0], "what the hand felt is gone");
    rig.hand(Hand::new(0.0, 0.05, 0.0));
    let pose = rig.pose();
    assert!(pose.held && pose.status == Status::Ok && !pose.force_off);
    // The same as power-up with that scene.
    let mut other = Rig::<f32>::of(Setup {
        scene: TRIANGLE,
        ..setup()
    });
    other.hand(Hand::new(0.0, 0.05, 0.0));
    let expected = other.pose();
    assert_eq!(
        (pose.position, pose.rest),
        (expected.position, expected.rest)
    );
}

#[test]
fn scenes_that_cannot_be_used_are_refused() {
    use Parameter as P;
    let nan = f32::NAN;
    let mut rig = Rig::<f32>::new();
    rig.stay(deep(), 30);
    let many: Vec<[f32; 2]> = (0..9)
        .map(|i| {
            let (sin, cos) = (std::f32::consts::TAU * i as f32 / 9.0).sin_cos();
            [cos * 0.05, sin * 0.05]
        })
        .collect();
    let wrong = SurfaceDescription {
        normal: [0.0, 0.0],
        ..FLOOR
    };
    let number = Reason::Number;
    let cases = [
        (
            Description {
                vertices: &many,
                ..BOX
            },
            Reason::Unsupported,
            P::VertexCount,
            9.0,
            8.0,
        ),
        (
            Description {
                vertices: &[],
                ..BOX
            },
            number,
            P::VertexCount,
            0.0,
            nan,
        ),
        (
            Description {
                surfaces: &[FLOOR; 5],
                ..BOX
            },
            Reason::Unsupported,
            P::SurfaceCount,
            5.0,
            4.0,
        ),
        (
            Description {
                vertices: &[[0.0, 0.0], [0.05, nan]],
                ..BOX
            },
            number,
            P::Vertex(1),
            nan,
            nan,
        ),
        (
            Description {
                start: [0.0, nan, 0.0],
                ..BOX
            },
            number,
            P::Start,
            nan,
            nan,
        ),
        (
            Description {
                weight: -1.0,
                ..BOX
            },
            number,
            P::Weight,
            -1.0,
            nan,
        ),
        (
            Description {
                holding_point: Some([nan, 0.0]),
                ..BOX
            },
            number,
            P::HoldingPoint,
            nan,
            nan,
        ),
        (
            Description { reach: -0.5, ..BOX },
            number,
            P::Reach,
            -0.5,
            nan,
        ),
        (
            Description {
                stiffness_translation: 0.0,
                ..BOX
            },
            number,
            P::StiffnessTranslation,
            0.0,
            nan,
        ),
        (
            Description {
                stiffness_rotation: -1.0,
                ..BOX
            },
            number,
            P::StiffnessRotation,
            -1.0,
            nan,
        ),
        (
            Description {
                surfaces: &[FLOOR, wrong],
                ..BOX
            },
            number,
            P::Normal(1),
            0.0,
            nan,
        ),
    ];
    for (description, reason, parameter, value, limit) in cases {
        let command = Command::Scene(SceneCommand::from(&description));
        refused(
            &mut rig,
            command,
            (reason, Subject::Scene(parameter), value, limit),
        );
    }
    let inside = Description {
        start: [0.0, 0.02, 0.0],
        ..BOX
    };
    let before = seen(&mut rig);
    let answer = rig.ask(Command::Scene(SceneCommand::from(&inside)));
    assert_eq!(answer.reason, Reason::Number);
    let vertex = |vertex| Subject::Scene(P::Penetration { surface: 0, vertex });
    assert!((0..2).any(|v| answer.subject == vertex(v)), "{answer:?}");
    assert_eq!(seen(&mut rig), before);
}

#[test]
fn what_the_solver_lacks_is_not_supported() {
    let smooth = SurfaceDescription {
        friction_static: 0.0,
        friction_dynamic: 0.0,
        ..FLOOR
    };
    let mut rig = Rig::<f32, Bare>::of(Setup {
        scene: Description {
            surfaces: Box::leak(Box::new([smooth])),
            ..BOX
        },
        ..setup()
    });
    assert_eq!(rig.info().has, [false; 3]);
    let answer = rig.ask(Command::Parameters(PARAMETERS));
    assert_eq!(answer.reason, Reason::Unsupported);
    assert_eq!(answer.subject, Subject::Scene(Parameter::FrictionStatic(0)));
    assert_eq!((answer.value, answer.limit), (0.8, 0.0));
    let answer = rig.ask(scene(&TRIANGLE));
    assert_eq!(answer.subject, Subject::Scene(Parameter::Weight));
    assert_eq!((answer.reason, answer.limit), (Reason::Unsupported, 0.0));
}
