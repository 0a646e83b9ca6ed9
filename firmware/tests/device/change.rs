//! Changes in mid-contact: parameters, scene, mode. The body stays where it is.

use super::*;
use stiction_core::StateKind;
use stiction_firmware::device::Placement;
use stiction_tests::station::FLOOR;

/// The difference after a change that changes nothing: rounding.
fn near(a: f32, b: f32) -> bool {
    (a - b).abs() < 2e-6
}

fn same_parameters_change_nothing<R: Real<Si = f32>>(hands: &[Hand<f32>]) {
    let mut bench = Bench::<R>::new();
    for &hand in hands {
        bench.pressed(hand);
    }
    let before = bench.tick(None);
    let same = Parameters {
        stiffness_translation: 500.0,
        stiffness_rotation: 0.5,
        friction_static: 0.5,
        friction_dynamic: 0.3,
        memory: None,
    };
    let unchanged = bench.controller.clone();
    let changed = bench.controller.set_parameters(&same).unwrap().unwrap();
    let after = bench.tick(None);
    assert_eq!(after.pose.angle, changed.angle);
    assert_eq!(
        (before.pose.state, before.pose.held),
        (after.pose.state, after.pose.held)
    );
    for (a, b) in before.pose.position.into_iter().zip(after.pose.position) {
        assert!(near(a, b), "{before:?} {after:?}");
    }
    assert!(
        (before.pose.angle.minus(after.pose.angle)).abs() < 1e-5,
        "{before:?} {after:?}"
    );
    let size = size(&before.force);
    for (a, b) in before.force.force.into_iter().zip(after.force.force) {
        assert!((a - b).abs() < 2e-3 * (1.0 + size), "{before:?} {after:?}");
    }
    assert!((before.force.moment - after.force.moment).abs() < 1e-5);
    // And it continues as if nothing had happened: the hold is the same, and so is the position to which the hand moves
    // the body.
    for held in [true, false] {
        let next = Hand {
            held,
            ..Hand::new(0.03, 0.08, 18.9)
        };
        let sample = Sample {
            hand: next,
            number: bench.number.wrapping_add(1),
            received_us: bench.now_us,
        };
        let mut servo = bench.servo.clone();
        servo.tick(bench.now_us);
        let turn = |mut controller: Device<R>| controller.turn(Some(&sample), &mut servo.clone());
        let (there, here) = (turn(unchanged.clone()), turn(bench.controller.clone()));
        assert_eq!(
            (here.pose.state, here.pose.held),
            (there.pose.state, there.pose.held)
        );
        for (a, b) in here.pose.position.into_iter().zip(there.pose.position) {
            assert!((a - b).abs() < 1e-5, "{here:?} {there:?}");
        }
        assert!(
            here.pose.angle.minus(there.pose.angle).abs() < 1e-4,
            "{here:?} {there:?}"
        );
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
    for hands in [&flat[..], &turned, &wound, &taken, &released] {
        same_parameters_change_nothing::<f32>(hands);
        same_parameters_change_nothing::<Fixed>(hands);
    }
}

#[test]
fn less_friction_lets_a_body_slip_that_stuck() {
    let mut bench = Bench::<f32>::new();
    bench.pressed(deep());
    let before = bench.pressed(Hand::new(0.002, 0.045, 0.0));
    assert_eq!(before.pose.position[0], 0.0);
    // T / N = 0.4: within the old cone, beyond the new one.
    let ice = Parameters {
        stiffness_translation: 500.0,
        stiffness_rotation: 0.5,
        friction_static: 0.2,
        friction_dynamic: 0.1,
        memory: None,
    };
    let output = bench.controller.set_parameters(&ice).unwrap().unwrap();
    assert_eq!(output.slips, 1);
    // It slips until |T| = 0.1 N: 0.5 mm of spring are left.
    assert!((output.position[0] - 0.0015).abs() < 1e-6, "{output:?}");
    // The force moves there within its rate.
    let after = bench.tick(None);
    let change = before.force.force[0] - after.force.force[0];
    assert!(change.abs() <= 0.1 + 1e-5 && change != 0.0, "{change}");
    assert!(after.flags.rate_limited);
}

#[test]
fn a_softer_spring_keeps_the_contact() {
    let mut bench = Bench::<f32>::new();
    bench.pressed(deep());
    let soft = Parameters {
        stiffness_translation: 100.0,
        stiffness_rotation: 0.1,
        friction_static: 0.5,
        friction_dynamic: 0.3,
        memory: None,
    };
    let output = bench.controller.set_parameters(&soft).unwrap().unwrap();
    assert_eq!(output.state, StateKind::Edge);
    let tick = bench.pressed(deep());
    assert!((tick.force.force[1] - 0.5).abs() < 1e-4, "{tick:?}");
}

#[test]
fn a_scene_that_would_be_inside_the_body_is_refused() {
    let mut bench = Bench::<f32>::new();
    bench.pressed(deep());
    let before = bench.controller.clone();
    let raised = [SurfaceDescription {
        offset: 0.01,
        ..FLOOR
    }];
    let higher = Description {
        surfaces: &raised,
        start: [0.0, 0.05, 0.0],
        ..BOX
    };
    let refused = bench
        .controller
        .set_scene(&higher, Placement::Present)
        .unwrap_err();
    assert!(
        refused.to_string().starts_with("depth of vertex"),
        "{refused}"
    );
    let crowded = [FLOOR; 3];
    let crowded = Description {
        surfaces: &crowded,
        ..BOX
    };
    assert!(
        bench
            .controller
            .set_scene(&crowded, Placement::Start)
            .is_err()
    );
    assert_eq!(format!("{:?}", bench.controller), format!("{before:?}"));

    // A wall that touches it, or one lower down, is accepted.
    let wall = SurfaceDescription {
        normal: [-1.0, 0.0],
        offset: -0.05,
        ..FLOOR
    };
    let walled = [FLOOR, wall];
    let walled = Description {
        surfaces: &walled,
        ..BOX
    };
    let output = bench
        .controller
        .set_scene(&walled, Placement::Present)
        .unwrap()
        .unwrap();
    assert_eq!(output.state, StateKind::Locked);
    let lower = [SurfaceDescription {
        offset: -0.02,
        ..FLOOR
    }];
    let lower = Description {
        surfaces: &lower,
        ..BOX
    };
    let output = bench
        .controller
        .set_scene(&lower, Placement::Present)
        .unwrap()
        .unwrap();
    assert_eq!(output.state, StateKind::NonContact);

    // From its own start the higher floor is an ordinary one.
    assert_eq!(
        bench.controller.set_scene(&higher, Placement::Start),
        Ok(None)
    );
    let tick = bench.tick(None);
    assert_eq!(
        (tick.force, tick.pose.position),
        (Wrench::default(), [0.0, 0.05])
    );
    assert!(bench.sample(deep()).output.is_some());
}

fn set_mode(bench: &mut Bench<f32>, evolution: Evolution, budget: u32) -> Result<(), Refusal> {
    bench.controller.set_settings(&Settings {
        evolution,
        budget,
        ..Settings::default()
    })
}

#[test]
fn reset_begins_anew_and_the_mode_changes_in_the_middle() {
    let mut bench = Bench::<f32>::new();
    let first = bench.sample(deep());
    bench.pressed(Hand::new(0.05, 0.045, 0.2));
    assert_eq!(set_mode(&mut bench, Evolution::Frame, 0), Ok(()));
    let before = bench.tick(None);
    assert_eq!(bench.sample(Hand::new(0.05, 0.045, 0.2)).pose, before.pose);
    bench.controller.reset();
    let idle = bench.tick(None);
    assert_eq!(
        (idle.force, idle.pose.position, idle.pose.held),
        (Wrench::default(), [0.0, 0.03], false)
    );
    assert_eq!(set_mode(&mut bench, Evolution::Path, u32::MAX), Ok(()));
    let again = bench.sample(deep());
    assert_eq!(again.output, first.output);
    assert!(size(&again.force) <= 0.1 + 1e-5);
}
