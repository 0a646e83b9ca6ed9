//! The force that may be output to the hand: limits of size and rate, passivity.

use crate::with;
use stiction_core::Wrench;
use stiction_firmware::safety::{Allowed, Governor, LimitParameter, Limits, Passivity};
use stiction_tests::station::noise::Random;

/// Any float, of any magnitude, and sometimes NaN or an infinity.
fn any(random: &mut Random) -> f32 {
    match random.bits() % 8 {
        0 => f32::from_bits(random.bits() as u32),
        1 => {
            [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 0.0][random.bits() as usize % 5]
        }
        _ => (random.bits() as i32) as f32 / i32::MAX as f32 * 12.0,
    }
}

fn size([x, y]: [f32; 2]) -> f64 {
    f64::from(x).hypot(f64::from(y))
}

fn change(a: &Wrench<f32>, b: &Wrench<f32>) -> (f64, f64) {
    let [ax, ay] = a.force.map(f64::from);
    let [bx, by] = b.force.map(f64::from);
    let turned = f64::from(b.moment) - f64::from(a.moment);
    ((bx - ax).hypot(by - ay), turned)
}

#[test]
fn force_and_its_rate_are_never_exceeded() {
    let limits = Limits::default();
    let (mut governor, mut random) = (Governor::new(&limits), Random(1));
    let (step, turn) = (0.1, 0.002); // 100 N/s, 2 N·m/s, at 1 kHz
    let mut last = Wrench::default();
    let (mut at_size, mut at_rate, mut bad) = (0, 0, 0);
    for _ in 0..1_000_000 {
        let wanted = Wrench {
            force: [any(&mut random), any(&mut random)],
            moment: any(&mut random),
        };
        let given = governor.toward(&wanted);
        let w = given.wrench;
        assert!(size(w.force) <= 5.0, "{wanted:?} {w:?}");
        assert!(w.moment.abs() <= 0.1, "{wanted:?} {w:?}");
        if given.not_finite {
            bad += 1;
            assert_eq!(w, Wrench::default());
        } else {
            // 1e-6 of the limit for the rounding of the sum.
            let (force, moment) = change(&last, &w);
            assert!(force <= step + 5e-6, "{last:?} {w:?}");
            assert!(moment.abs() <= turn + 1e-7, "{last:?} {w:?}");
        }
        at_size += u32::from(given.size_limited);
        at_rate += u32::from(given.rate_limited);
        last = w;
    }
    assert!(at_size > 10_000 && at_rate > 10_000 && bad > 10_000);
}

#[test]
fn the_force_keeps_its_direction_at_its_limit() {
    let mut governor = Governor::new(&Limits::default());
    let wanted = Wrench {
        force: [30.0, -40.0],
        moment: 0.0,
    };
    let mut given = governor.toward(&wanted);
    for _ in 0..100 {
        given = governor.toward(&wanted);
    }
    let [x, y] = given.wrench.force;
    assert!((x - 3.0).abs() < 1e-5 && (y + 4.0).abs() < 1e-5);
    assert!(given.size_limited && !given.rate_limited);
    // Its square is too large for f32.
    let huge = Wrench {
        force: [3e38, 3e38],
        moment: -3e38,
    };
    for _ in 0..200 {
        given = governor.toward(&huge);
    }
    let [x, y] = given.wrench.force;
    assert!((x - y).abs() < 1e-6 && (size([x, y]) - 5.0).abs() < 1e-5);
    assert!((given.wrench.moment + 0.1).abs() < 1e-6);
}

#[test]
fn a_wanted_force_within_the_limits_is_reached_exactly() {
    let mut governor = Governor::new(&Limits::default());
    let wanted = Wrench {
        force: [1.234_567, -0.765_432],
        moment: 0.012_345,
    };
    let ticks = (0..).take_while(|_| governor.toward(&wanted).wrench != wanted);
    assert_eq!(ticks.count(), 14); // 1.4526 N in steps of 0.1 N: reached with the 15th
    let given = governor.toward(&wanted);
    assert!(!given.size_limited && !given.rate_limited && given.wrench == wanted);
}

#[test]
fn limits_that_are_not_numbers_or_out_of_range_are_refused_by_name() {
    use LimitParameter as P;
    assert_eq!(Limits::default().check(), Ok(()));
    let refused = |change: &dyn Fn(&mut Limits)| with(Limits::default(), change).check();
    let parameter = |change: &dyn Fn(&mut Limits)| refused(change).unwrap_err().parameter;
    for bad in [f32::NAN, f32::INFINITY, -1.0] {
        assert_eq!(parameter(&|limits| limits.force = bad), P::Force);
        assert_eq!(parameter(&|limits| limits.moment = bad), P::Moment);
        assert_eq!(parameter(&|limits| limits.force_rate = bad), P::ForceRate);
        assert_eq!(parameter(&|limits| limits.moment_rate = bad), P::MomentRate);
    }
    assert_eq!(parameter(&|limits| limits.force_rate = 0.0), P::ForceRate);
    assert_eq!(parameter(&|limits| limits.period_us = 0), P::Period);
    assert_eq!(parameter(&|limits| limits.silence_us = 1_999), P::Silence);
    assert_eq!(
        refused(&|limits| limits.silence_us = 2_000_000)
            .unwrap_err()
            .to_string(),
        "silence (µs) is 2000000, allowed: 2000 to 1000000"
    );
}

#[test]
fn stiffness_is_passive_below_twice_the_damping_over_the_tick() {
    let passivity = Passivity {
        damping_translation: 0.5,
        damping_rotation: 0.03125,
        hold_us: 1_000,
        delay_us: 0,
    };
    assert_eq!(passivity.check(), Ok(()));
    let nan = with(passivity, |passivity| passivity.damping_rotation = f32::NAN);
    assert_eq!(
        nan.check().unwrap_err().parameter,
        LimitParameter::DampingRotation
    );
    assert_eq!(passivity.bounds(), [1000.0, 62.5]);
    assert_eq!(passivity.admit(999.9, 62.4), Ok(()));
    assert_eq!(passivity.admit(0.0, 0.0), Ok(()));
    let error = passivity.admit(1000.0, 1.0).unwrap_err();
    assert_eq!(error.parameter, LimitParameter::StiffnessTranslation);
    assert_eq!(error.allowed, Allowed::PassiveBelow(1000.0));
    assert_eq!(
        error.to_string(),
        "translational stiffness k_h (N/m) is 1000, allowed: less than 1000, where the device is passive"
    );
    let error = passivity.admit(1.0, 62.5).unwrap_err();
    assert_eq!(error.parameter, LimitParameter::StiffnessRotation);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let wrong = [passivity.admit(bad, 1.0), passivity.admit(1.0, bad)];
        assert!(wrong.iter().all(Result::is_err), "{bad}");
    }
    // A delay costs twice as much as a tick.
    let late = with(passivity, |passivity| passivity.delay_us = 500);
    assert_eq!(late.bounds(), [500.0, 31.25]);
    // Without damping only zero stiffness is passive.
    let free = with(passivity, |passivity| passivity.damping_translation = 0.0);
    assert!(free.admit(1e-6, 0.0).is_err());
    let none = with(passivity, |passivity| passivity.hold_us = 0);
    assert_eq!(none.check().unwrap_err().parameter, LimitParameter::Hold);
}

/// A mass at a virtual wall that is sampled and held, integrated finely: the energy that the wall has added to it when it leaves.
fn energy_gained(stiffness: f64, damping: f64) -> f64 {
    let (mass, hold, fine) = (0.05, 1e-3, 1_000);
    let dt = hold / f64::from(fine);
    let mut worst = f64::NEG_INFINITY;
    for phase in 0..50 {
        let speed = 0.02;
        let (mut x, mut v) = (hold * speed * (f64::from(phase) + 0.5) / 50.0, -speed);
        for _ in 0..10_000 {
            let force = if x < 0.0 { -stiffness * x } else { 0.0 };
            for _ in 0..fine {
                v += (force - damping * v) / mass * dt;
                x += v * dt;
            }
            if x > 0.0 && v > 0.0 {
                break;
            }
        }
        worst = worst.max(0.5 * mass * (v * v - speed * speed));
    }
    worst
}

#[test]
fn a_wall_below_the_bound_takes_energy_and_far_above_it_gives_some() {
    let damping = 0.5; // the bound is 1000 N/m
    assert!(energy_gained(999.0, damping) < 0.0);
    assert!(energy_gained(20_000.0, damping) > 0.0);
}
