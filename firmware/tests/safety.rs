//! The force that may be output to the hand: limits of size and growth, passivity.

use crate::with;
use stiction_core::Wrench;
use stiction_firmware::safety::{Allowed, Governor, LimitParameter, Limits, Passivity, Wanted};
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

/// k_h (N/m) and k_theta (N·m/rad).
const STIFFNESS: [f32; 2] = [500.0, 0.5];

/// What a governor with limits as after power-up is asked for.
fn wanted(force: [f32; 2], moment: f32) -> Wanted {
    Limits::DEFAULT.sized(&Wrench { force, moment }, STIFFNESS)
}

#[test]
fn size_is_never_exceeded_nor_growth_after_zero_force() {
    let (mut governor, mut random) = (Governor::new(&Limits::DEFAULT), Random(1));
    let (step, turn) = (0.1, 0.002); // 100 N/s, 2 N·m/s, at 1 kHz
    // Ticks since zero force, until what was wanted is reached.
    let mut grows = Some(0.0);
    let (mut at_size, mut at_rate, mut bad) = (0, 0, 0);
    for _ in 0..1_000_000 {
        if random.bits() % 16 == 0 {
            assert_eq!(governor.cut().wrench, Wrench::default());
            grows = Some(0.0);
        }
        // Some are so small that they are soon reached.
        let scale = [1.0, 0.05, 0.001][random.bits() as usize % 3];
        let [x, y, moment] = std::array::from_fn(|_| any(&mut random) * scale);
        let force = [x, y];
        let given = governor.toward(&wanted(force, moment));
        let w = given.wrench;
        assert!(size(w.force) <= 5.0 && w.moment.abs() <= 0.1, "{w:?}");
        if given.not_finite {
            bad += 1;
            assert_eq!(w, Wrench::default());
            grows = Some(0.0);
            continue;
        }
        if let Some(ticks) = &mut grows {
            // 1e-6 of the limits for the rounding of the sum.
            *ticks += 1.0;
            assert!(size(w.force) <= *ticks * step + 5e-6, "{w:?}");
            assert!(f64::from(w.moment.abs()) <= *ticks * turn + 1e-7, "{w:?}");
        } else {
            assert!(!given.rate_limited);
        }
        if given.rate_limited {
            at_rate += 1;
        } else if given.size_limited {
            at_size += 1;
            // One of the two springs would be at its limit alone: 50 mJ or 20 mJ, twice.
            let held = size(w.force).powi(2) / 500.0 + f64::from(w.moment).powi(2) / 0.5;
            assert!((held - 0.02).abs() < 1e-6, "{held}");
        } else {
            assert_eq!((w.force, w.moment), (force, moment));
        }
        grows = grows.filter(|_| given.rate_limited);
    }
    assert!(at_size > 10_000 && at_rate > 10_000 && bad > 10_000);
}

#[test]
fn a_limit_keeps_the_direction_of_force_and_moment_together() {
    let mut governor = Governor::new(&Limits::DEFAULT);
    let far = wanted([30.0, -40.0], 0.2);
    for _ in 0..100 {
        let given = governor.toward(&far);
        let [x, y] = given.wrench.force;
        let part = x / 30.0;
        let is_along =
            (y + 40.0 * part).abs() < 1e-5 && (given.wrench.moment - 0.2 * part).abs() < 1e-7;
        assert!(is_along && given.size_limited, "{given:?}");
    }
    let given = governor.toward(&far);
    // 50 N and 0.2 N·m hold 5.08 J, twice; 0.1 N·m hold 0.02 J.
    let part = (0.02_f32 / 5.08).sqrt();
    assert!((given.wrench.moment - 0.2 * part).abs() < 1e-6 && !given.rate_limited);
}

#[test]
fn what_a_device_does_not_output_limits_nothing() {
    let knob = with(Limits::DEFAULT, |limits| limits.moment = 0.0);
    let mut governor = Governor::new(&knob);
    let mut given = Wrench::default();
    for _ in 0..60 {
        let wrench = Wrench {
            force: [3.0, 3.9],
            moment: 7.0,
        };
        given = governor.toward(&knob.sized(&wrench, STIFFNESS)).wrench;
    }
    assert_eq!((given.force, given.moment), ([3.0, 3.9], 0.0));
}

#[test]
fn a_wanted_force_within_the_limits_is_reached_exactly() {
    let mut governor = Governor::new(&Limits::DEFAULT);
    let (force, moment) = ([1.234_567, -0.765_432], 0.012_345);
    let is_reached = |given: &Wrench<f32>| (given.force, given.moment) == (force, moment);
    let far = wanted(force, moment);
    let ticks = (0..).take_while(|_| !is_reached(&governor.toward(&far).wrench));
    // They hold 4.53 mJ, twice: 0.476 of the size of 20 mJ, which grows in 50 ticks.
    assert_eq!(ticks.count(), 23);
    let given = governor.toward(&far);
    assert!(!given.size_limited && !given.rate_limited && is_reached(&given.wrench));
}

#[test]
fn a_force_that_has_grown_follows_at_once_and_one_that_falls_always_does() {
    let mut governor = Governor::new(&Limits::DEFAULT);
    let along = |x: f32| wanted([x, 0.0], 0.01 * x);
    // Less than has grown is given at once, and so is everything from then on.
    for _ in 0..10 {
        governor.toward(&along(2.0));
    }
    for x in [0.5, 0.0, 2.0, -2.0, 0.67] {
        let given = governor.toward(&along(x));
        assert!(
            given.wrench.force == [x, 0.0] && !given.rate_limited,
            "{given:?}"
        );
    }
    // The direction is that of the demand, also while it grows: 0.02 of the limits per tick.
    governor.cut();
    governor.toward(&along(2.0));
    let given = governor.toward(&along(-2.0));
    let [x, _] = given.wrench.force;
    assert!(
        (-0.2..-0.05).contains(&x) && given.rate_limited,
        "{given:?}"
    );
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
        turn_us: 0,
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
    // So does a turn, and one that is as long as a tick or longer lets a force be held for two: of the knob of the example, and of the Pico.
    let bound = |turn_us, period_us| {
        let late = with(passivity, |passivity| passivity.turn_us = turn_us);
        let [along, _] = late.at_period(period_us).bounds();
        along
    };
    assert!((bound(675, 1_000) - 0.5 / 1.175e-3).abs() < 1e-3);
    assert!((bound(1_000, 1_000) - 0.5 / 2e-3).abs() < 1e-3);
    assert!((bound(2_068, 1_000) - 0.5 / 3.568e-3).abs() < 1e-3);
    assert!((bound(0, 2_000) - 0.5 / 1e-3).abs() < 1e-3);
    let endless = with(passivity, |passivity| passivity.turn_us = 1_000_001);
    assert_eq!(endless.check().unwrap_err().parameter, LimitParameter::Turn);
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
