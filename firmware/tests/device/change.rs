//! Changes in mid-contact: parameters, scene, mode. The body stays where it is.

use super::*;
use crate::change;
use stiction_core::StateKind;
use stiction_firmware::device::Placement;
use stiction_tests::station::FLOOR;

/// A point has no size of its own: the length unit of its scene depends on where it is held. A change while it is held must not change
/// the units of lengths and forces.
const POINT: Description<'static, f32> = Description {
    vertices: &[[0.0, 0.0]],
    start: [0.0, 0.0, 0.0],
    // A lever of 4 cm: r² = 0.0016 + 0.5 / 500 m².
    holding_point: Some([0.0, 0.04]),
    ..BOX
};

/// Asserts that the body is held as before, at most as far away (m).
fn stays(there: &Turn, here: &Turn, most: f32) {
    let (there, here) = (&there.pose, &here.pose);
    assert_eq!((here.state, here.held), (there.state, there.held));
    for (a, b) in here.position.into_iter().zip(there.position) {
        assert!((a - b).abs() < most, "{here:?} {there:?}");
    }
    assert!(
        here.angle.minus(there.angle).abs() < 1e-4,
        "{here:?} {there:?}"
    );
}

fn same_parameters_change_nothing<R: Real<Si = f32>>(
    scene: &Description<'_, f32>,
    hands: &[Hand<f32>],
) {
    let mut bench = Bench::<R>::with(scene, &Settings::default());
    for &hand in hands {
        bench.pressed(hand);
    }
    let before = bench.tick(None);
    let unchanged = bench.controller.clone();
    let changed = bench.controller.set_parameters(&SAME).unwrap().unwrap();
    let after = bench.tick(None);
    assert_eq!(after.pose.angle, changed.angle);
    // Up to rounding, and a point may slip by it.
    let is_point = scene.vertices.len() == 1;
    stays(&before, &after, if is_point { 1e-5 } else { 2e-6 });
    assert!(
        before.pose.angle.minus(after.pose.angle).abs() < 1e-5,
        "{before:?} {after:?}"
    );
    let most = 2e-3 * (1.0 + size(&before.force));
    assert!(
        change(&before.force, &after.force) < most,
        "{before:?} {after:?}"
    );
    assert!((before.force.moment - after.force.moment).abs() < 1e-5);
    // And it continues as if nothing had happened: the hold is the same, and so is the position to which the hand moves
    // the body.
    for held in [true, false] {
        let hand = with(Hand::new(0.03, 0.08, 18.9), |hand| hand.held = held);
        let sample = Sample {
            hand,
            number: bench.number.wrapping_add(1),
            received_us: bench.now_us,
        };
        let mut servo = bench.servo.clone();
        servo.tick(bench.now_us);
        let turn = |mut controller: Device<R>| controller.turn(Some(&sample), &mut servo.clone());
        let there = turn(unchanged.clone());
        stays(&there, &turn(bench.controller.clone()), 1e-5);
        // Setting the present mode again changes no bit.
        let mut same = unchanged.clone();
        assert_eq!(same.set_settings(&Settings::default()), Ok(()));
        assert_eq!(turn(same), there);
    }
}

#[test]
fn parameters_that_are_the_present_ones_change_nothing() {
    let flat = [deep()];
    let turned = [Hand::new(0.0, 0.06, 0.3), Hand::new(0.004, 0.05, 0.5)];
    // Three turns in the air, then down.
    let wound: Vec<_> = (0..=10)
        .map(|i| Hand::new(0.0, 0.2, 1.9 * i as f32))
        .chain([Hand::new(0.0, 0.045, 19.0)])
        .collect();
    // Released and grasped elsewhere, turned.
    let taken = [
        Hand::new(0.0, 0.06, 0.0),
        Hand::new(0.0, 0.06, 0.0).released(),
        Hand::new(0.02, 0.05, 0.4).released(),
        Hand::new(0.02, 0.05, 0.4),
        Hand::new(0.025, 0.03, 0.3),
    ];
    let released = [deep(), deep().released()];
    // The point is pulled along the floor.
    let pulled = [Hand::new(0.003, 0.03, 0.1)];
    for (scene, hands) in [
        (&BOX, &flat[..]),
        (&BOX, &turned),
        (&BOX, &wound),
        (&BOX, &taken),
        (&BOX, &released),
        (&POINT, &pulled),
    ] {
        same_parameters_change_nothing::<f32>(scene, hands);
        same_parameters_change_nothing::<Fixed>(scene, hands);
    }
}

#[test]
fn less_friction_lets_a_body_slip_that_stuck() {
    let mut bench = Bench::<f32>::new();
    bench.pressed(deep());
    let before = bench.pressed(Hand::new(0.002, 0.045, 0.0));
    assert_eq!(before.pose.position[0], 0.0);
    // T / N = 0.4: within the old cone, beyond the new one.
    let ice = with(SAME, |p| {
        (p.friction_static, p.friction_dynamic) = (0.2, 0.1)
    });
    let output = bench.controller.set_parameters(&ice).unwrap().unwrap();
    assert_eq!(output.slips, 1);
    // It slips until |T| = 0.1 N: 0.5 mm of spring are left.
    assert!((output.position[0] - 0.0015).abs() < 1e-6, "{output:?}");
    // The force falls there at once.
    let after = bench.tick(None);
    let [x, _] = after.force.force;
    assert!(
        before.force.force[0] < -0.99 && (x + 0.25).abs() < 1e-4,
        "{after:?}"
    );
    // Where more is wanted, it grows within its rate.
    let stiff = with(SAME, |p| p.stiffness_translation = 600.0);
    bench.controller.set_parameters(&stiff).unwrap();
    let mut last = after.force;
    for _ in 0..3 {
        let tick = bench.tick(None);
        let grown = size(&tick.force) - size(&last);
        assert!(grown > 0.05 && grown <= 0.1 + 1e-5, "{grown}");
        assert!(tick.flags.rate_limited);
        last = tick.force;
    }
}

#[test]
fn a_scene_that_would_be_inside_the_body_is_refused() {
    let floor = |offset| [with(FLOOR, |floor| floor.offset = offset)];
    let (raised, lowered) = (floor(0.01), floor(-0.02));
    let wall = with(FLOOR, |wall| {
        (wall.normal, wall.offset) = ([-1.0, 0.0], -0.05)
    });
    let higher = with(BOX, |d| (d.surfaces, d.start) = (&raised, [0.0, 0.05, 0.0]));
    let crowded = with(BOX, |d| d.surfaces = &[FLOOR; 3]);
    let walls = [FLOOR, wall];
    let walled = with(BOX, |d| d.surfaces = &walls);
    let lower = with(BOX, |d| d.surfaces = &lowered);

    let mut bench = Bench::<f32>::new();
    bench.pressed(deep());
    let before = bench.controller.clone();
    let controller = &mut bench.controller;
    let refused = controller
        .set_scene(&higher, Placement::Present)
        .unwrap_err();
    assert!(
        refused.to_string().starts_with("depth of vertex"),
        "{refused}"
    );
    assert!(controller.set_scene(&crowded, Placement::Start).is_err());
    assert_eq!(format!("{controller:?}"), format!("{before:?}"));

    // A wall that touches it, or a floor lower down, is accepted.
    for (scene, state) in [(walled, StateKind::Locked), (lower, StateKind::NonContact)] {
        let output = controller.set_scene(&scene, Placement::Present).unwrap();
        assert_eq!(output.unwrap().state, state);
    }
    // From its own start the higher floor is an ordinary one.
    assert_eq!(controller.set_scene(&higher, Placement::Start), Ok(None));
    let tick = bench.tick(None);
    assert_eq!(
        (tick.force, tick.pose.position),
        (Wrench::default(), [0.0, 0.05])
    );
    assert!(bench.sample(deep()).output.is_some());
}

#[test]
fn reset_begins_anew_and_the_mode_changes_in_the_middle() {
    let mut bench = Bench::<f32>::new();
    let first = bench.sample(deep());
    bench.pressed(Hand::new(0.05, 0.045, 0.2));
    let mode = with(Settings::default(), |s| {
        (s.evolution, s.budget) = (Evolution::Frame, 0)
    });
    assert_eq!(bench.controller.set_settings(&mode), Ok(()));
    let before = bench.tick(None);
    assert_eq!(bench.sample(Hand::new(0.05, 0.045, 0.2)).pose, before.pose);
    bench.controller.reset();
    let idle = bench.tick(None);
    assert_eq!(
        (idle.force, idle.pose.position, idle.pose.held),
        (Wrench::default(), [0.0, 0.03], false)
    );
    assert_eq!(bench.controller.set_settings(&Settings::default()), Ok(()));
    let again = bench.sample(deep());
    assert_eq!(again.output, first.output);
    assert!(size(&again.force) <= 0.1 + 1e-5);
}
