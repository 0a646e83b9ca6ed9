//! The knob: from counts to the hand, from the force to the motor; and with a scene, a rough plate under a point.

use crate::bench::Bench;
use core::f64::consts::TAU;
use std::cell::Cell;
use std::rc::Rc;
use stiction_core::{Event, Real, Wrench};
use stiction_firmware::device::{Actuators, Controller, FromLine, Servo, Settings, Source};
use stiction_firmware::devices::knob as example;
use stiction_firmware::knob::{Counter, Knob};
use stiction_firmware::pantograph::{Encoder, KnobGeometry, Motor, MotorConstants};
use stiction_scene::WrittenScene;

const GEOMETRY: KnobGeometry = KnobGeometry {
    origin: [0.01, 0.036],
    radius: 0.015,
    encoder: Encoder {
        counts_per_turn: 2_400,
        reversed: false,
        offset: 0.0,
    },
};
const MOTOR: MotorConstants = MotorConstants {
    torque_constant: 0.05,
    full_current: 2.0,
    torque_limit: 0.08,
    reversed: false,
};

/// A counter that shows the value given by a test; `None` if it is broken.
#[derive(Clone, Default)]
struct Shown(Rc<Cell<Option<u16>>>);

impl Counter for Shown {
    fn count(&mut self) -> Option<u16> {
        self.0.get()
    }
}

/// A knob, what its counter shows, and its motor.
fn knob(geometry: KnobGeometry) -> (Knob<Shown, Motor<Bench, Bench>>, Shown, Bench) {
    let (shown, bench) = (Shown::default(), Bench::default());
    let motor = Motor::new(bench.clone(), bench.clone(), MOTOR).unwrap();
    let knob = Knob::new(&geometry, shown.clone(), motor).unwrap();
    (knob, shown, bench)
}

#[test]
fn the_hand_goes_by_the_radius_from_wherever_the_knob_was_at_power_up() {
    for reversed in [false, true] {
        let mut geometry = GEOMETRY;
        geometry.encoder.reversed = reversed;
        let (mut knob, shown, _) = knob(geometry);
        // The counter wraps on the path to more than ten turns and back.
        let begun = 65_000u16;
        for i in (0..30_000).step_by(97).chain((0..30_000).rev().step_by(97)) {
            shown.0.set(Some(begun.wrapping_add(i)));
            let [x, y] = knob.sample(0).unwrap().hand.position;
            let turned = f64::from(i) / 2_400.0 * TAU * if reversed { -1.0 } else { 1.0 };
            let wanted = 0.01 + 0.015 * turned;
            // The part of a turn, its angle, the sum with whole turns, and the path are rounded; a part may be nearly a turn.
            let rounded = 4.0 * f64::from(f32::EPSILON / 2.0) * (0.015 * TAU + wanted.abs());
            assert!(
                (f64::from(x) - wanted).abs() < rounded,
                "{i}: {x}, not {wanted}"
            );
            assert_eq!(y, 0.036);
        }
    }
}

#[test]
fn a_counter_that_cannot_be_read_gives_no_sample() {
    let (mut knob, shown, _) = knob(GEOMETRY);
    assert!(knob.sample(0).is_none());
    shown.0.set(Some(7));
    assert_eq!(knob.sample(0).unwrap().hand.position, [0.01, 0.036]);
    shown.0.set(None);
    assert!(knob.sample(0).is_none());
}

#[test]
fn the_power_of_the_torque_is_that_of_the_force_along_x() {
    let (mut knob, _, bench) = knob(GEOMETRY);
    for along in [-3.0f32, -0.5, 0.25, 4.0] {
        let wrench = Wrench {
            force: [along, 17.0],
            moment: 5.0,
        };
        knob.give(&wrench).unwrap();
        // 0.1 N·m at full duty.
        let part = f32::from(*bench.duty.borrow()) / 8_400.0;
        assert!((part * 0.1 - 0.015 * along.abs()).abs() < 0.1 / 8_400.0);
        assert_eq!(*bench.high.borrow(), along < 0.0);
    }
    knob.off();
    assert_eq!(*bench.duty.borrow(), 0);
}

#[test]
fn what_cannot_be_is_refused_by_its_name() {
    let with = |change: fn(&mut KnobGeometry)| {
        let mut geometry = GEOMETRY;
        change(&mut geometry);
        geometry.check().unwrap_err().to_string()
    };
    assert_eq!(
        with(|g| g.radius = 0.0),
        "radius (m) is 0, allowed: 0.001 to 10"
    );
    let counts = with(|g| g.encoder.counts_per_turn = 3);
    assert_eq!(
        counts,
        "counts per turn of encoder 0 is 3, allowed: 4 to 4194304"
    );
    assert!(with(|g| g.origin[1] = f32::NAN).starts_with("origin (m) is NaN"));
}

/// The example at a board that is as slow as it may be, with its scene.
fn example() -> Controller<f32, 8, 4> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/knob.toml");
    let scene = WrittenScene::read(file.as_ref(), f64::from(f32::MAX)).unwrap();
    example::LIMITS.check().unwrap();
    example::PASSIVITY.check().unwrap();
    let settings = Settings {
        limits: example::LIMITS,
        passivity: Some(example::PASSIVITY.at_period(example::LIMITS.period_us)),
        ..Settings::default()
    };
    let (controller, _) = scene.described::<f32, _>(|scene| Controller::new(scene, &settings));
    controller.unwrap()
}

/// The knob of the example turns on its rough plate: the force rises as it sticks, falls as it slips, never exceeds the cone of static
/// friction, and takes work from the hand. What a slip takes from the force it takes from the motor in the same tick.
#[test]
fn a_turned_knob_sticks_and_slips_at_its_motor() {
    let mut controller = example();
    let bench = Bench::default();
    let motor = Motor::new(bench.clone(), bench.clone(), example::MOTOR).unwrap();
    let moved = Knob::new(&example::GEOMETRY, Shown::default(), motor).unwrap();
    let mut servo = Servo::new((FromLine, moved));
    let (mut knob, shown, _) = knob(example::GEOMETRY);
    let (mut slips, mut work, mut last, mut sharpest) = (0, 0.0, None, 0.0_f32);
    // At first the force grows, while the knob stands: 2 N in 20 ms.
    let stands = std::iter::repeat_n(0u16, 40);
    let there_and_back = (0..2_400).chain((0..2_400).rev());
    for (i, count) in (0u32..).zip(stands.chain(there_and_back)) {
        shown.0.set(Some(count));
        let now_us = i * 1_000;
        let sample = knob.sample(now_us).unwrap();
        let [x, _] = sample.hand.position;
        servo.tick(now_us);
        let tick = controller.turn(Some(&sample), &mut servo);
        let [along, up] = tick.force.force;
        assert!(up > 0.0, "the plate presses on the hand: {tick:?}");
        // mu_s = 0.8 at the only contact, and no weight; plus a rounding of f32.
        assert!(Real::abs(along) <= 0.8 * up * (1.0 + 1e-5), "{i}: {tick:?}");
        if i >= 40 {
            let statics = controller.solver().wrench(controller.state().unwrap());
            assert_eq!(tick.force.force, statics.feedback().force, "{i}");
        }
        // Half a step of the PWM.
        let duty = f32::from(*bench.duty.borrow()) / 8_400.0;
        let full = example::MOTOR.full_torque() / example::GEOMETRY.radius;
        assert!((duty * full - along.abs()).abs() < 0.51 * full / 8_400.0);
        let events = tick.output.iter().flat_map(|output| output.events());
        let slipped = events.filter(|event| **event == Event::Slip).count();
        if let Some((from, force)) = last.replace((x, along)) {
            work -= f64::from(force) * f64::from(x - from);
            if slipped > 0 {
                sharpest = sharpest.max((along - force).abs());
            }
        }
        slips += slipped;
    }
    assert!(slips > 4, "{slips}");
    assert!(work > 0.0, "{work} J");
    println!("a slip of {sharpest} N in one tick");
    assert!(sharpest > 0.5, "{sharpest} N");
}
