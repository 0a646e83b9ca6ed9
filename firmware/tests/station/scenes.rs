//! Scenes that a client sends: a good one begins at its start, an unusable one is refused and changes nothing (FRAME 4
//! and 5.4).

use super::commands::{deep, refused, seen};
use super::rig::{Rig, setup};
use crate::with;
use stiction_core::{Description, Hand, Parameter, Status, SurfaceDescription};
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
    let mut other = Rig::<f32>::of(with(setup(), |setup| setup.scene = TRIANGLE));
    other.hand(Hand::new(0.0, 0.05, 0.0));
    let expected = other.pose();
    assert_eq!(
        (pose.position, pose.rest),
        (expected.position, expected.rest)
    );
}

#[test]
fn scenes_that_cannot_be_used_are_refused() {
    use Parameter::{HoldingPoint, Normal, Reach, Start, StiffnessRotation, StiffnessTranslation};
    use Parameter::{SurfaceCount, Vertex, VertexCount, Weight};
    type Change = fn(&mut Description<'static, f32>);
    const NAN: f32 = f32::NAN;
    const MANY: [[f32; 2]; 9] = [[0.0; 2]; 9];
    const LOST: [[f32; 2]; 2] = [[0.0, 0.0], [0.05, NAN]];
    const WRONG: SurfaceDescription<f32> = SurfaceDescription {
        normal: [0.0, 0.0],
        ..FLOOR
    };
    let mut rig = Rig::<f32>::new();
    rig.stay(deep(), 30);
    // Those with more than there is room for, and those that no board can use.
    let larger: [(Change, Parameter, f32, f32); 2] = [
        (|d| d.vertices = &MANY, VertexCount, 9.0, 8.0),
        (|d| d.surfaces = &[FLOOR; 5], SurfaceCount, 5.0, 4.0),
    ];
    let wrong: [(Change, Parameter, f32); 9] = [
        (|d| d.vertices = &[], VertexCount, 0.0),
        (|d| d.vertices = &LOST, Vertex(1), NAN),
        (|d| d.start[1] = NAN, Start, NAN),
        (|d| d.weight = -1.0, Weight, -1.0),
        (|d| d.holding_point = Some([NAN, 0.0]), HoldingPoint, NAN),
        (|d| d.reach = -0.5, Reach, -0.5),
        (|d| d.stiffness_translation = 0.0, StiffnessTranslation, 0.0),
        (|d| d.stiffness_rotation = -1.0, StiffnessRotation, -1.0),
        (|d| d.surfaces = &[FLOOR, WRONG], Normal(1), 0.0),
    ];
    let mut refused = |change: Change, reason, parameter, value, limit| {
        let description = with(BOX, change);
        let command = Command::Scene(SceneCommand::from(&description));
        let expected = (reason, Subject::Scene(parameter), value, limit);
        refused(&mut rig, command, expected);
    };
    for (change, parameter, value, limit) in larger {
        refused(change, Reason::Unsupported, parameter, value, limit);
    }
    for (change, parameter, value) in wrong {
        refused(change, Reason::Number, parameter, value, NAN);
    }
    let inside = with(BOX, |d| d.start = [0.0, 0.02, 0.0]);
    let before = seen(&mut rig);
    let answer = rig.ask(Command::Scene(SceneCommand::from(&inside)));
    assert_eq!(answer.reason, Reason::Number);
    let surface = 0;
    let vertex = |vertex| Subject::Scene(Parameter::Penetration { surface, vertex });
    assert!((0..2).any(|v| answer.subject == vertex(v)), "{answer:?}");
    assert_eq!(seen(&mut rig), before);
}
