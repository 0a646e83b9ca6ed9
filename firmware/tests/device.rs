//! The loops of a device: drop-outs, recovery, counters, refusals. Their bits and silence are those of a station.

use crate::{SAME, size, with};
use stiction_core::{Description, Evolution, Fixed, Hand, Real, Status, Wrench};
use stiction_firmware::device::{
    Controller, FromLine, NoActuators, Refusal, Sample, Servo, Settings, Turn,
};
use stiction_firmware::safety::{LimitParameter, Passivity};

mod budget;
mod change;

use stiction_tests::station::BOX;

type Device<R = f32> = Controller<R, 4, 2>;

/// A device with a sender at 1 kHz.
struct Bench<R: Real> {
    controller: Device<R>,
    servo: Servo<(FromLine, NoActuators)>,
    now_us: u32,
    number: u16,
}

impl<R: Real<Si = f32>> Bench<R> {
    fn new() -> Self {
        Self::with(&BOX, &Settings::default())
    }
    fn with(description: &Description<'_, f32>, settings: &Settings) -> Self {
        Self {
            controller: Controller::new(description, settings).unwrap(),
            servo: Servo::new((FromLine, NoActuators)),
            // The clock wraps during the test.
            now_us: u32::MAX - 50_000,
            number: 65_500,
        }
    }
    /// The next tick and its turn, with a sample.
    fn sample(&mut self, hand: Hand<f32>) -> Turn {
        self.number = self.number.wrapping_add(1);
        let sample = Sample {
            hand,
            number: self.number,
            received_us: self.now_us,
        };
        self.tick(Some(&sample))
    }
    /// The next tick and its turn.
    fn tick(&mut self, sample: Option<&Sample>) -> Turn {
        self.servo.tick(self.now_us);
        self.now_us = self.now_us.wrapping_add(1_000);
        self.controller.turn(sample, &mut self.servo)
    }
    /// The hand presses and stays until the force has settled.
    fn pressed(&mut self, hand: Hand<f32>) -> Turn {
        for _ in 0..100 {
            self.sample(hand);
        }
        self.sample(hand)
    }
}

fn deep() -> Hand<f32> {
    Hand::new(0.001, 0.045, 0.0)
}

#[test]
fn a_sample_that_cannot_be_used_gives_zero_force_and_the_last_pose() {
    let usable = deep();
    let changes: [fn(&mut Hand<f32>, f32); 3] = [
        |hand, bad| hand.position = [bad, 0.0],
        |hand, bad| hand.angle.rest = bad,
        |hand, bad| hand.depth = bad,
    ];
    let bad = [f32::NAN, f32::INFINITY].into_iter();
    let lost = bad.flat_map(|bad| changes.map(|change| with(usable, |hand| change(hand, bad))));
    let far = with(usable, |hand| hand.position = [1e30, 0.0]);
    for hand in lost.chain([far]) {
        let mut bench = Bench::<f32>::new();
        // The first of all samples may be one, too.
        let first = bench.sample(hand);
        assert!(first.flags.silent && first.flags.held_last && size(&first.force) == 0.0);
        let before = bench.pressed(usable);
        assert!(size(&before.force) > 2.0);
        let tick = bench.sample(hand);
        let stays = (before.pose, Wrench::default());
        assert_eq!((tick.pose, tick.force), stays, "{hand:?}");
        assert!(tick.flags.held_last);
        // It stays so until a usable one arrives, and becomes silence if none does.
        assert!(bench.tick(None).flags.held_last);
        let tried = (1..=20).find(|_| bench.sample(hand).flags.silent).unwrap();
        let tick = bench.sample(usable);
        assert!(!tick.flags.is_safe_state());
        assert!(size(&tick.force) <= 0.1 + 1e-5 && size(&tick.force) > 0.0);
        // Those, the first of all and the one after the press.
        let health = bench.controller.health();
        assert_eq!((health.unusable_samples, health.silences), (tried + 2, 1));
    }
}

#[test]
fn an_overrun_gives_zero_force_if_it_is_longer_than_permitted_and_is_counted() {
    for missed_ticks in [0, 2] {
        let settings = with(Settings::default(), |s| {
            s.limits.missed_ticks = missed_ticks
        });
        let mut bench = Bench::<f32>::with(&BOX, &settings);
        let before = bench.pressed(deep());
        bench.now_us = bench.now_us.wrapping_add(2_000);
        let tick = bench.sample(deep());
        assert_eq!(bench.controller.health().missed_ticks, 2);
        assert_eq!(
            (tick.pose, tick.flags.overrun),
            (before.pose, missed_ticks < 2)
        );
        if missed_ticks < 2 {
            assert_eq!(tick.force, Wrench::default());
            assert!(size(&bench.sample(deep()).force) <= 0.1 + 1e-5);
        } else {
            assert_eq!(tick.force, before.force);
        }
    }
}

#[test]
fn late_samples_are_not_used_and_lost_ones_counted() {
    let mut bench = Bench::<f32>::new();
    let before = bench.pressed(deep());
    bench.number = bench.number.wrapping_sub(1);
    let tick = bench.sample(Hand::new(0.01, 0.04, 0.1));
    assert!(tick.output.is_none() && tick.pose == before.pose);
    bench.number = bench.number.wrapping_add(7);
    assert!(bench.sample(deep()).output.is_some());
    let health = bench.controller.health();
    assert_eq!((health.late_samples, health.lost_samples), (1, 7));
}

#[test]
fn limits_and_stiffness_beyond_the_device_are_refused() {
    let passivity = Passivity {
        damping_translation: 0.5,
        damping_rotation: 0.001,
        hold_us: 1_000,
        delay_us: 0,
        turn_us: 0,
    };
    let settings = with(Settings::default(), |s| s.passivity = Some(passivity));
    let unlimited = with(settings, |settings| settings.limits.force = f32::NAN);
    let too_stiff = with(BOX, |description| description.stiffness_rotation = 2.01);
    for (description, settings, parameter) in [
        (BOX, unlimited, LimitParameter::Force),
        (too_stiff, settings, LimitParameter::StiffnessRotation),
    ] {
        let Err(Refusal::Limit(error)) = Device::<f32>::new(&description, &settings) else {
            panic!("{parameter:?}")
        };
        assert_eq!(error.parameter, parameter);
    }
}

#[test]
fn a_released_body_gives_no_force_and_keeps_its_pose() {
    let mut bench = Bench::<f32>::new();
    let before = bench.pressed(deep());
    let after = bench.pressed(deep().released());
    assert_eq!(after.force, Wrench::default());
    assert_eq!(after.pose.position, before.pose.position);
    assert!(!after.pose.held && !after.flags.is_safe_state());
    // Grasped again off its holding point, in a scene changed meanwhile: where the hand is.
    let softer = with(SAME, |parameters| parameters.stiffness_translation = 400.0);
    bench.controller.set_parameters(&softer).unwrap();
    let taken = bench.sample(Hand::new(0.03, 0.04, 1.0));
    assert!(taken.pose.held);
    assert_eq!(taken.pose.position, before.pose.position);
    assert_eq!(taken.output.unwrap().status, Status::Ok);
    assert_eq!(bench.tick(None).force, Wrench::default());
}
