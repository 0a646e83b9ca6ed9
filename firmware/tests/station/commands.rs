//! Every command except scenes, and every refusal: its reason and its subject, and that a refusal changes nothing (FRAME 4 and 5.4).

use super::rig::{Rig, driven, setup};
use super::scenes::TRIANGLE;
use crate::with;
use stiction_core::{Evolution, Hand, Parameter, StateKind, Status};
use stiction_tests::station::beside::{Beside, assert_same};
use stiction_tests::station::client::{Said, scene};
use stiction_wire::{
    Command, Drive, Info, Mode, NumberType, Parameters, Pose, Reason, Reset, Stepping, Subject,
    Text,
};

pub(crate) const PARAMETERS: Parameters = Parameters {
    stiffness_translation: 400.0,
    stiffness_rotation: 0.3,
    friction_static: 0.8,
    friction_dynamic: 0.2,
    memory: None,
};

pub(crate) fn deep() -> Hand<f32> {
    Hand::new(0.001, 0.045, 0.0)
}

/// The part of the board's state that a client can see: its description, and its pose.
pub(crate) fn seen(rig: &mut Rig) -> (Info<'static>, Pose) {
    let info = rig.info();
    rig.hand(deep());
    let pose = rig.pose();
    (info, Pose { sample: 0, ..pose })
}

/// A reason with its subject, and the value and the limit, which may be NaN.
pub(crate) type Expected = (Reason, Subject, f32, f32);

/// Asserts that the command is refused, with the subject, value and limit.
pub(crate) fn answered(rig: &mut Rig, command: Command<'_>, expected: Expected) {
    let answer = rig.ask(command);
    let (reason, subject, value, limit) = expected;
    assert_eq!(
        (answer.reason, answer.subject),
        (reason, subject),
        "{answer:?}"
    );
    let same = |a: f32, b: f32| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
    assert!(
        same(answer.value, value) && same(answer.limit, limit),
        "{answer:?}"
    );
    assert!(answer.allowed != "");
}

/// Asserts in addition that nothing changes.
pub(crate) fn refused(rig: &mut Rig, command: Command<'_>, expected: Expected) {
    let before = seen(rig);
    answered(rig, command, expected);
    assert_eq!(seen(rig), before);
}

/// The parameters, some of them changed.
fn parameters(change: impl FnOnce(&mut Parameters)) -> Command<'static> {
    Command::Parameters(with(PARAMETERS, change))
}

#[test]
fn hello_is_answered_by_info() {
    let mut rig = Rig::<f32>::new();
    let expected = Info {
        version: [0, 1, 0],
        number: NumberType::F32,
        vertices: 8,
        surfaces: 4,
        corners: 0,
        actuators: false,
        // 11 + 39 + 8·8 + 25·4.
        longest_frame: 216,
        fastest_tick: 5_000,
        // Three quarters of 4_000_000_000 / 1_000.
        budget: 3_500_000,
        stiffest: [f32::INFINITY; 2],
        stiffness: [500.0, 0.5],
        friction_now: [0.5, 0.3],
        memory_now: None,
        mode: Mode::DEFAULT,
        name: Text::new("bench"),
    };
    assert_eq!(rig.info(), expected);
    let mut rig = Rig::<f32>::of(driven());
    let info = rig.info();
    assert!(info.actuators);
    // 2 b / T
    assert_eq!(info.stiffest, [4_000.0, 1.953_125]);
}

/// Info is the longest frame that a board sends: it arrives with any name, which is cut to 200 characters.
#[test]
fn hello_is_answered_whatever_the_name() {
    for length in [0, 1, 161, 162, 199, 200, 201, 300] {
        let name: &str = Box::leak("n".repeat(length).into_boxed_str());
        let mut rig = Rig::<f32>::of(with(setup(), |setup| setup.name = name));
        let said = rig.info().name;
        assert_eq!(said, &name[..length.min(200)], "{length} characters");
        assert_eq!(rig.health().unsent, 0);
    }
}

#[test]
fn hello_begins_the_count_of_lost_frames_anew() {
    let mut rig = Rig::<f32>::new();
    rig.send(Command::Ping);
    rig.client.sequence += 3;
    rig.send(Command::Ping);
    rig.tick();
    rig.tick();
    assert_eq!(rig.health().lost_frames, 3);
    rig.client.sequence += 100;
    rig.send(Command::Hello);
    rig.send(Command::Ping);
    rig.tick();
    rig.tick();
    assert_eq!(rig.health().lost_frames, 3);
}

#[test]
fn ping_is_answered_by_pong() {
    let mut rig = Rig::<f32>::new();
    let sequence = rig.send(Command::Ping);
    let now_us = rig.now_us;
    rig.tick();
    let received = rig.received();
    assert_eq!(received[0].said, Said::Pong { sequence, time: 7 });
    assert_eq!(received[0].time, now_us);
}

#[test]
fn parameters_in_mid_contact_leave_the_body_where_it_is() {
    let mut rig = Rig::<f32>::new();
    rig.stay(deep(), 10);
    rig.stay(Hand::new(0.03, 0.045, 0.3), 100);
    let before = rig.pose();
    assert_ne!(before.state, StateKind::NonContact);
    rig.done(Command::Parameters(PARAMETERS));
    let info = rig.info();
    assert_eq!(
        (info.stiffness, info.friction_now),
        ([400.0, 0.3], [0.8, 0.2])
    );
    assert_eq!(info.memory_now, None);
    rig.tick();
    let after = rig.pose();
    assert!(after.held && after.status == Status::Ok);
    let [dx, dy] = std::array::from_fn(|i| after.position[i] - before.position[i]);
    // Sticking feet: it turns a little about them, as the balance of the springs is a different one.
    assert!(
        dx.hypot(dy) < 2e-3 && (after.rest - before.rest).abs() < 0.03,
        "{before:?} {after:?}"
    );
    // The force moves to that of the new springs.
    let force = rig.stay(Hand::new(0.03, 0.045, 0.3), 200);
    let normal = force.force[1];
    assert!(normal > 0.5 && normal < 0.9 * 500.0 * 5e-3, "{force:?}");
}

#[test]
fn parameters_before_the_first_sample_are_those_of_the_start() {
    let mut rig = Rig::<f32>::new();
    rig.done(parameters(|p| p.stiffness_translation = 1_000.0));
    let force = rig.stay(Hand::new(0.0, 0.046, 0.0), 200);
    assert!(
        (force.force[1] - 4.0).abs() < 1e-3,
        "4 mm of 1000 N/m: {force:?}"
    );
}

#[test]
fn a_memory_length_is_reported_and_taken_back() {
    let mut rig = Rig::<f32>::new();
    rig.stay(deep(), 30);
    for memory in [Some(1e-3), Some(0.0), None] {
        rig.done(parameters(|p| p.memory = memory));
        assert_eq!(rig.info().memory_now, memory);
    }
    for wrong in [-1e-6, f32::NAN, f32::INFINITY] {
        let command = parameters(|p| p.memory = Some(wrong));
        let subject = Subject::Scene(Parameter::Memory(0));
        let expected = (Reason::Number, subject, wrong, f32::NAN);
        refused(&mut rig, command, expected);
        assert_eq!(rig.info().memory_now, None);
    }
}

#[test]
fn parameters_that_are_no_numbers_for_them_are_refused() {
    use Parameter::{FrictionDynamic, FrictionStatic, StiffnessRotation, StiffnessTranslation};
    let (nan, infinity) = (f32::NAN, f32::INFINITY);
    let mut rig = Rig::<f32>::new();
    rig.stay(deep(), 30);
    type Place = fn(&mut Parameters) -> &mut f32;
    let cases: [(Parameter, f32, Place); 8] = [
        (StiffnessTranslation, 0.0, |p| &mut p.stiffness_translation),
        (StiffnessTranslation, -1.0, |p| &mut p.stiffness_translation),
        (StiffnessTranslation, nan, |p| &mut p.stiffness_translation),
        (StiffnessRotation, -0.1, |p| &mut p.stiffness_rotation),
        (StiffnessRotation, infinity, |p| &mut p.stiffness_rotation),
        (FrictionStatic(0), 0.1, |p| &mut p.friction_static),
        (FrictionDynamic(0), -0.2, |p| &mut p.friction_dynamic),
        (FrictionDynamic(0), nan, |p| &mut p.friction_dynamic),
    ];
    for (parameter, value, place) in cases {
        let expected = (Reason::Number, Subject::Scene(parameter), value, nan);
        refused(&mut rig, parameters(|p| *place(p) = value), expected);
    }
}

#[test]
fn a_stiffness_that_is_not_passive_is_refused_with_the_bound() {
    let nan = f32::NAN;
    let mut rig = Rig::<f32>::of(driven());
    rig.stay(deep(), 30);
    let along = Subject::Scene(Parameter::StiffnessTranslation);
    let round = Subject::Scene(Parameter::StiffnessRotation);
    let stiff = parameters(|p| p.stiffness_translation = 4_000.0);
    refused(
        &mut rig,
        stiff,
        (Reason::NotPassive, along, 4_000.0, 4_000.0),
    );
    let twisting = parameters(|p| p.stiffness_rotation = 3.0);
    refused(
        &mut rig,
        twisting,
        (Reason::NotPassive, round, 3.0, 1.953_125),
    );
    // NaN is not too stiff.
    let unknown = parameters(|p| p.stiffness_translation = nan);
    refused(&mut rig, unknown, (Reason::Number, along, nan, nan));
    // A slower tick holds the force longer: a stiffness that is passive now would not be. 2 b / T = 400 N/m at 100 Hz.
    let slow = Command::Mode(with(Mode::DEFAULT, |mode| mode.tick_rate = 100));
    refused(&mut rig, slow, (Reason::NotPassive, along, 500.0, 400.0));
    rig.done(parameters(|p| {
        (p.stiffness_translation, p.stiffness_rotation) = (300.0, 0.1)
    }));
    rig.done(slow);
    assert_eq!(rig.info().stiffest, [400.0, 0.195_312_5]);
}

#[test]
fn reset_of_the_body_keeps_scene_parameters_and_mode() {
    let mut rig = Rig::<f32>::new();
    let mode = with(Mode::DEFAULT, |mode| mode.evolution = Evolution::Frame);
    rig.done(Command::Mode(mode));
    rig.done(Command::Parameters(PARAMETERS));
    rig.stay(Hand::new(0.08, 0.045, 0.5), 60);
    let samples = rig.health().samples;
    rig.done(Command::Reset(Reset::Body));
    assert_eq!(rig.force.force, [0.0, 0.0]);
    let pose = rig.pose();
    assert!(!pose.held && (pose.position[1] - 0.03).abs() < 1e-7);
    let info = rig.info();
    assert_eq!((info.mode, info.stiffness), (mode, [400.0, 0.3]));
    assert_eq!(rig.health().samples, samples, "counts go on");
    // Grasped at the scene's holding point again.
    rig.hand(deep());
    assert!(rig.pose().held);
}

#[test]
fn reset_of_everything_is_power_up() {
    let mut rig = Rig::<f32>::new();
    rig.mode(|mode| (mode.stepping, mode.tick_rate) = (Stepping::PerSample, 500));
    rig.done(scene(&TRIANGLE));
    rig.line.to_board.extend([3, 1, 1, 1, 0]);
    rig.stay(Hand::new(0.0, 0.05, 0.0), 60);
    rig.client.sequence += 9;
    let before = rig.health();
    assert!(before.faults.total() == 1 && before.samples == 60);
    rig.client.inbox.clear();
    rig.done(Command::Reset(Reset::Everything));
    let replied = rig.received()[0].sequence;
    let health = rig.health();
    assert_eq!(
        (health.samples, health.ticks, health.lost_frames),
        (0, 1, 0)
    );
    assert_eq!((health.faults.total(), health.drive), (0, Drive::Silent));
    assert!(health.worst_step < 10_000);
    let info = rig.info();
    assert_eq!((info.mode, info.friction_now), (Mode::DEFAULT, [0.5, 0.3]));
    // Sequence numbers continue: for the client nothing is lost.
    rig.tick();
    let next = rig.received();
    assert_ne!(replied, 0);
    assert!(!next.is_empty());
    let mut beside = Beside::<f32>::new(&Mode::DEFAULT);
    rig.hand(deep());
    assert_same(&rig.pose(), &beside.step(deep()), "power-up");
}
