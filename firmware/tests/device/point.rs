//! A point has no size of its own: the length unit of its scene depends on where it is held. A change while it is held must not change the
//! units of lengths and forces.

use super::*;

const POINT: Description<'static, f32> = Description {
    vertices: &[[0.0, 0.0]],
    start: [0.0, 0.0, 0.0],
    // A lever of 4 cm: r² = 0.0016 + 0.4 / 500 m².
    holding_point: Some([0.0, 0.04]),
    stiffness_rotation: 0.4,
    ..BOX
};

const SAME: Parameters = Parameters {
    stiffness_translation: 500.0,
    stiffness_rotation: 0.4,
    friction_static: 0.5,
    friction_dynamic: 0.3,
    memory: None,
};

/// No device.
type Nothing = Servo<(FromLine, NoActuators)>;

/// Pressed onto the floor and pulled along it, and the resulting state of the device.
fn pulled<R: Real<Si = f32>>() -> (Controller<R, 1, 1>, Nothing, Sample) {
    let mut controller = Controller::new(&POINT, &Settings::default()).expect("a sound scene");
    let mut servo = Servo::new((FromLine, NoActuators));
    let mut sample = Sample {
        hand: Hand::new(0.003, 0.03, 0.1),
        number: 0,
        received_us: 0,
    };
    for number in 1..100 {
        sample.number = number;
        sample.received_us = 1_000 * u32::from(number);
        servo.tick(sample.received_us);
        controller.turn(Some(&sample), &mut servo);
    }
    (controller, servo, sample)
}

fn changes_keep_the_pose<R: Real<Si = f32>>() {
    let (controller, servo, mut sample) = pulled::<R>();
    sample.number += 1;
    sample.received_us += 1_000;
    let next = |controller: &Controller<R, 1, 1>| {
        let (mut controller, mut servo) = (controller.clone(), servo.clone());
        servo.tick(sample.received_us);
        controller.turn(Some(&sample), &mut servo)
    };
    let there = next(&controller);
    assert!(there.pose.held && size(&there.force) > 4.0, "{there:?}");

    // Setting the present mode again changes no bit.
    let mut same = controller.clone();
    same.set_settings(&Settings::default())
        .expect("sound settings");
    assert_eq!(next(&same), there);

    let mut same = controller;
    same.set_parameters(&SAME).expect("sound parameters");
    let here = next(&same);
    for (a, b) in [
        (here.pose.position[0], there.pose.position[0]),
        (here.pose.position[1], there.pose.position[1]),
        (here.pose.angle.rest, there.pose.angle.rest),
    ] {
        assert!((a - b).abs() < 1e-5, "{here:?} {there:?}");
    }
    let [a, b] = [here, there].map(|tick| size(&tick.force));
    assert!((a - b).abs() < 2e-3 * b, "{a} {b}");
}

#[test]
fn changes_keep_the_pose_of_a_point() {
    changes_keep_the_pose::<f32>();
    changes_keep_the_pose::<Fixed>();
}
