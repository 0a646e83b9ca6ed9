//! The loops of a device: silence, drop-outs, recovery, counters, refusals.

use stiction_core::{
    Angle, Description, Evolution, Fixed, Hand, Real, Scene, Solver, Status, SurfaceDescription,
    Wrench,
};
use stiction_firmware::device::{
    Controller, FromLine, NoActuators, Parameters, Refusal, Sample, Servo, Settings, Turn,
};
use stiction_firmware::safety::{LimitParameter, Limits, Passivity};

mod budget;
mod change;
mod point;

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

fn size(wrench: &Wrench<f32>) -> f32 {
    let [x, y] = wrench.force;
    x.hypot(y)
}

fn follows_the_solver<R: Real<Si = f32>>() {
    let mut bench = Bench::<R>::new();
    let scene: Scene<R, 4, 2> = Scene::new(&BOX).unwrap();
    let solver = Solver::new(scene, Evolution::Path);
    let mut state = None;
    for i in 0..2_000 {
        let t = i as f32 * 1e-3;
        let hand = Hand::new(0.02 * t, 0.05 - 0.01 * (7.0 * t).sin(), 12.0 * t);
        let tick = bench.sample(hand);
        // Ticks without a sample change nothing.
        let between = bench.tick(None);
        let expected = match &mut state {
            None => {
                let (first, output) = solver.start(hand);
                state = Some(first);
                output
            }
            Some(state) => solver.step(state, hand),
        };
        assert_eq!(tick.output.as_ref(), Some(&expected));
        assert_eq!(between.output, None);
        assert_eq!(between.pose, tick.pose);
        assert_eq!(
            (tick.pose.position, tick.pose.angle),
            (expected.position, expected.angle)
        );
    }
    let health = bench.controller.health();
    assert_eq!((health.ticks, health.samples), (4_000, 2_000));
    assert_eq!(
        (
            health.missed_ticks,
            health.lost_samples,
            health.late_samples
        ),
        (0, 0, 0)
    );
}

#[test]
fn the_pose_is_the_solvers_bit_for_bit() {
    follows_the_solver::<f32>();
    follows_the_solver::<Fixed>();
}

#[test]
fn the_force_is_the_opposite_of_the_springs() {
    let tick = Bench::<f32>::new().pressed(deep());
    let [x, y] = tick.force.force;
    // 1 mm aside, 5 mm deep, 500 N/m.
    assert!((x + 0.5).abs() < 1e-4 && (y - 2.5).abs() < 1e-4, "{tick:?}");
    assert_eq!(tick.flags, Default::default());
}

#[test]
fn silence_gives_zero_force_within_20_ms_and_recovery_no_jump() {
    let mut bench = Bench::<f32>::new();
    let before = bench.pressed(deep());
    let last_received = bench.now_us.wrapping_sub(1_000);
    loop {
        let now = bench.now_us;
        let tick = bench.tick(None);
        assert_eq!(tick.pose, before.pose);
        let age = now.wrapping_sub(last_received);
        if tick.flags.silent {
            assert_eq!(tick.force, Wrench::default());
            assert!(age <= 20_000, "{age}");
            break;
        }
        assert_eq!(tick.force, before.force);
        assert!(age < 20_000);
    }
    for _ in 0..5_000 {
        let tick = bench.tick(None);
        assert!(tick.flags.silent && tick.force == Wrench::default() && tick.pose == before.pose);
    }
    assert_eq!(bench.controller.health().silences, 1);
    // Samples return from elsewhere: the pose follows immediately, the force within its rate.
    let away = Hand::new(0.01, 0.045, 0.0);
    let mut last = Wrench::default();
    for i in 0..100 {
        let tick = bench.sample(away);
        assert!(!tick.flags.silent);
        let change = Wrench {
            force: [
                tick.force.force[0] - last.force[0],
                tick.force.force[1] - last.force[1],
            ],
            moment: 0.0,
        };
        assert!(size(&change) <= 0.1 + 1e-5, "tick {i}: {change:?}");
        last = tick.force;
    }
    assert!((last.force[1] - 2.5).abs() < 1e-3);
}

#[test]
fn a_sample_that_cannot_be_used_gives_zero_force_and_the_last_pose() {
    let usable = deep();
    let lost = [f32::NAN, f32::INFINITY].into_iter().flat_map(|bad| {
        let position = Hand {
            position: [bad, 0.0],
            ..usable
        };
        let angle = Angle {
            turns: 0,
            rest: bad,
        };
        [
            position,
            Hand { angle, ..usable },
            Hand {
                depth: bad,
                ..usable
            },
        ]
    });
    for hand in lost.chain([Hand {
        position: [1e30, 0.0],
        ..usable
    }]) {
        let mut bench = Bench::<f32>::new();
        // The first of all samples may be one, too.
        let first = bench.sample(hand);
        assert!(first.flags.silent && first.flags.held_last && size(&first.force) == 0.0);
        let before = bench.pressed(usable);
        assert!(size(&before.force) > 2.0);
        let tick = bench.sample(hand);
        assert_eq!(
            (tick.pose, tick.force),
            (before.pose, Wrench::default()),
            "{hand:?}"
        );
        assert!(tick.flags.held_last);
        // It stays so until a usable one arrives, and becomes silence if none does.
        assert!(bench.tick(None).flags.held_last);
        let tried = (1..=20).find(|_| bench.sample(hand).flags.silent).unwrap();
        let tick = bench.sample(usable);
        assert!(!tick.flags.is_safe_state());
        assert!(size(&tick.force) <= 0.1 + 1e-5 && size(&tick.force) > 0.0);
        // Those, the first of all and the one after the press.
        assert_eq!(bench.controller.health().unusable_samples, tried + 2);
    }
}

#[test]
fn an_overrun_gives_zero_force_and_is_counted() {
    let mut bench = Bench::<f32>::new();
    let before = bench.pressed(deep());
    bench.now_us = bench.now_us.wrapping_add(2_000);
    let tick = bench.sample(deep());
    assert!(tick.flags.overrun);
    assert_eq!((tick.force, tick.pose), (Wrench::default(), before.pose));
    assert_eq!(bench.controller.health().missed_ticks, 2);
    assert!(size(&bench.sample(deep()).force) <= 0.1 + 1e-5);

    let limits = Limits {
        missed_ticks: 2,
        ..Limits::default()
    };
    let settings = Settings {
        limits,
        ..Settings::default()
    };
    let mut bench = Bench::<f32>::with(&BOX, &settings);
    let before = bench.pressed(deep());
    bench.now_us = bench.now_us.wrapping_add(2_000);
    let tick = bench.sample(deep());
    assert!(!tick.flags.overrun && tick.force == before.force);
    assert_eq!(bench.controller.health().missed_ticks, 2);
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
    };
    let settings = Settings {
        passivity: Some(passivity),
        ..Settings::default()
    };
    let mut bench = Bench::<f32>::with(&BOX, &settings);
    bench.pressed(deep());
    let before = bench.controller.clone();
    let stiff = Parameters {
        stiffness_translation: 1_000.0,
        stiffness_rotation: 0.5,
        friction_static: 0.5,
        friction_dynamic: 0.3,
        memory: None,
    };
    let refused = bench.controller.set_parameters(&stiff).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "translational stiffness k_h (N/m) is 1000, allowed: less than 1000, where the device is passive"
    );
    let wrong = [
        Parameters {
            stiffness_translation: f32::NAN,
            ..stiff
        },
        Parameters {
            stiffness_translation: 100.0,
            stiffness_rotation: -1.0,
            ..stiff
        },
        Parameters {
            stiffness_translation: 100.0,
            friction_static: 0.2,
            ..stiff
        },
        Parameters {
            stiffness_translation: 100.0,
            friction_dynamic: f32::NAN,
            ..stiff
        },
    ];
    for parameters in wrong {
        assert!(
            bench.controller.set_parameters(&parameters).is_err(),
            "{parameters:?}"
        );
    }
    assert_eq!(format!("{:?}", bench.controller), format!("{before:?}"));
    let settings = Settings {
        limits: Limits {
            force: f32::NAN,
            ..Limits::default()
        },
        ..settings
    };
    let Err(Refusal::Limit(error)) = Device::<f32>::new(&BOX, &settings) else {
        panic!()
    };
    assert_eq!(error.parameter, LimitParameter::Force);
    let too_stiff = Description {
        stiffness_rotation: 2.01,
        ..BOX
    };
    let settings = Settings {
        passivity: Some(passivity),
        ..Settings::default()
    };
    assert!(matches!(
        Device::<f32>::new(&too_stiff, &settings),
        Err(Refusal::Limit(_))
    ));
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
    let same = Parameters {
        stiffness_translation: 400.0,
        stiffness_rotation: 0.5,
        friction_static: 0.5,
        friction_dynamic: 0.3,
        memory: None,
    };
    bench.controller.set_parameters(&same).unwrap();
    let taken = bench.sample(Hand::new(0.03, 0.04, 1.0));
    assert!(taken.pose.held);
    assert_eq!(taken.pose.position, before.pose.position);
    assert_eq!(taken.output.unwrap().status, Status::Ok);
    assert_eq!(bench.tick(None).force, Wrench::default());
}
