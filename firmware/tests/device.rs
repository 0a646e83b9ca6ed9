//! The control loop: silence, drop-outs, recovery, counters, and changes in mid-contact.

use stiction_core::{
    Angle, Description, Evolution, Fixed, Hand, Real, Scene, Solver, StateKind, Status,
    SurfaceDescription, Wrench,
};
use stiction_firmware::device::{Controller, Parameters, Placement, Refusal, Sample, Settings};
use stiction_firmware::safety::{LimitParameter, Limits, Passivity};

const FLOOR: SurfaceDescription<f32> = SurfaceDescription {
    normal: [0.0, 1.0],
    offset: 0.0,
    friction_static: 0.5,
    friction_dynamic: 0.3,
};

const BOX: Description<'static, f32> = Description {
    vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
    start: [0.0, 0.03, 0.0],
    weight: 0.0,
    holding_point: Some([0.0, 0.02]),
    reach: 0.02,
    stiffness_translation: 500.0,
    stiffness_rotation: 0.5,
    surfaces: &[FLOOR],
};

type Device<R = f32> = Controller<R, 4, 2>;

/// A device with a sender at 1 kHz.
struct Bench<R: Real> {
    controller: Device<R>,
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
            // The clock wraps on the way.
            now_us: u32::MAX - 50_000,
            number: 65_500,
        }
    }
    /// The next tick, with a sample.
    fn sample(&mut self, hand: Hand<f32>) -> stiction_firmware::device::Tick {
        self.number = self.number.wrapping_add(1);
        let sample = Sample {
            hand,
            number: self.number,
            received_us: self.now_us,
        };
        self.tick(Some(&sample))
    }
    /// The next tick.
    fn tick(&mut self, sample: Option<&Sample>) -> stiction_firmware::device::Tick {
        let tick = self.controller.tick(self.now_us, sample);
        self.now_us = self.now_us.wrapping_add(1_000);
        tick
    }
    /// The hand presses and stays until the force has settled.
    fn pressed(&mut self, hand: Hand<f32>) -> stiction_firmware::device::Tick {
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
    let last_heard = bench.now_us.wrapping_sub(1_000);
    loop {
        let now = bench.now_us;
        let tick = bench.tick(None);
        assert_eq!(tick.pose, before.pose);
        let age = now.wrapping_sub(last_heard);
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
    // Samples return from elsewhere: the pose follows at once, the force within its rate.
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
        // It stays so until a usable one comes, and is silence when none does.
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

/// What is left of a change that changes nothing: rounding.
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
    // And it goes on as if nothing had been: the hold is the same, and so is where the hand takes the body.
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
        let tick = |mut controller: Device<R>| controller.tick(bench.now_us, Some(&sample));
        let (there, here) = (tick(unchanged.clone()), tick(bench.controller.clone()));
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
    // Let go and taken elsewhere, turned.
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
    };
    let output = bench.controller.set_parameters(&ice).unwrap().unwrap();
    assert_eq!(output.slips, 1);
    // It slips until |T| = 0.1 N: 0.5 mm of spring are left.
    assert!((output.position[0] - 0.0015).abs() < 1e-6, "{output:?}");
    // The force goes there within its rate.
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

    // A wall that touches it, or one lower down, will do.
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

    // From its own start the higher floor is one like any other.
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

fn set_mode(bench: &mut Bench<f32>, evolution: Evolution, tolerance: f32) -> Result<(), Refusal> {
    bench.controller.set_settings(&Settings {
        evolution,
        tolerance,
        ..Settings::default()
    })
}

#[test]
fn reset_begins_anew_and_the_mode_changes_in_the_middle() {
    let mut bench = Bench::<f32>::new();
    let first = bench.sample(deep());
    bench.pressed(Hand::new(0.05, 0.045, 0.2));
    assert_eq!(set_mode(&mut bench, Evolution::Frame, 1e-4), Ok(()));
    let before = bench.tick(None);
    assert_eq!(bench.sample(Hand::new(0.05, 0.045, 0.2)).pose, before.pose);
    bench.controller.reset();
    let idle = bench.tick(None);
    assert_eq!(
        (idle.force, idle.pose.position, idle.pose.held),
        (Wrench::default(), [0.0, 0.03], false)
    );
    assert_eq!(set_mode(&mut bench, Evolution::Path, 0.0), Ok(()));
    let again = bench.sample(deep());
    assert_eq!(again.output, first.output);
    assert!(size(&again.force) <= 0.1 + 1e-5);
}

#[test]
fn a_released_body_gives_no_force_and_keeps_its_pose() {
    let mut bench = Bench::<f32>::new();
    let before = bench.pressed(deep());
    let after = bench.pressed(deep().released());
    assert_eq!(after.force, Wrench::default());
    assert_eq!(after.pose.position, before.pose.position);
    assert!(!after.pose.held && !after.flags.is_safe_state());
    // Taken again off its holding point, in a scene changed meanwhile: where the hand is.
    let same = Parameters {
        stiffness_translation: 400.0,
        stiffness_rotation: 0.5,
        friction_static: 0.5,
        friction_dynamic: 0.3,
    };
    bench.controller.set_parameters(&same).unwrap();
    let taken = bench.sample(Hand::new(0.03, 0.04, 1.0));
    assert!(taken.pose.held);
    assert_eq!(taken.pose.position, before.pose.position);
    assert_eq!(taken.output.unwrap().status, Status::Ok);
    assert_eq!(bench.tick(None).force, Wrench::default());
}
