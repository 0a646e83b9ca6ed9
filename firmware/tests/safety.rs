//! What force may go to the hand: limits of size and rate, passivity, silence, the sender's count, missed ticks.

use stiction_core::Wrench;
use stiction_firmware::safety::{
    Allowed, Arrival, Governor, LimitParameter, Limits, Line, Passivity, Ticks,
};

/// Random numbers (splitmix64).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    /// Any float, of any size, now and then none.
    fn any(&mut self) -> f32 {
        match self.bits() % 8 {
            0 => f32::from_bits(self.bits() as u32),
            1 => [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 0.0]
                [self.bits() as usize % 5],
            _ => (self.bits() as i32) as f32 / i32::MAX as f32 * 12.0,
        }
    }
}

fn size([x, y]: [f32; 2]) -> f64 {
    f64::from(x).hypot(f64::from(y))
}

fn change(a: &Wrench<f32>, b: &Wrench<f32>) -> (f64, f64) {
    let [ax, ay] = a.force.map(f64::from);
    let [bx, by] = b.force.map(f64::from);
    (
        (bx - ax).hypot(by - ay),
        f64::from(b.moment) - f64::from(a.moment),
    )
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
            force: [random.any(), random.any()],
            moment: random.any(),
        };
        let given = governor.toward(&wanted);
        let w = given.wrench;
        assert!(size(w.force) <= 5.0, "{wanted:?} {w:?}");
        assert!(
            f64::from(w.moment).abs() <= f64::from(0.1f32),
            "{wanted:?} {w:?}"
        );
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
    // Larger than its square can be told in f32.
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
    assert_eq!(ticks.count(), 14); // 1.4526 N in steps of 0.1 N: there with the 15th
    let given = governor.toward(&wanted);
    assert!(!given.size_limited && !given.rate_limited && given.wrench == wanted);
}

#[test]
fn limits_that_are_not_numbers_or_out_of_range_are_refused_by_name() {
    use LimitParameter as P;
    let good = Limits::default();
    assert_eq!(good.check(), Ok(()));
    for bad in [f32::NAN, f32::INFINITY, -1.0] {
        let cases = [
            (Limits { force: bad, ..good }, P::Force),
            (
                Limits {
                    moment: bad,
                    ..good
                },
                P::Moment,
            ),
            (
                Limits {
                    force_rate: bad,
                    ..good
                },
                P::ForceRate,
            ),
            (
                Limits {
                    moment_rate: bad,
                    ..good
                },
                P::MomentRate,
            ),
        ];
        for (limits, parameter) in cases {
            assert_eq!(limits.check().unwrap_err().parameter, parameter);
        }
    }
    let refused = |limits: Limits| limits.check().unwrap_err();
    assert_eq!(
        refused(Limits {
            force_rate: 0.0,
            ..good
        })
        .parameter,
        P::ForceRate
    );
    assert_eq!(
        refused(Limits {
            period_us: 0,
            ..good
        })
        .parameter,
        P::Period
    );
    assert_eq!(
        refused(Limits {
            silence_us: 1_999,
            ..good
        })
        .parameter,
        P::Silence
    );
    let error = refused(Limits {
        silence_us: 2_000_000,
        ..good
    });
    assert_eq!(
        error.to_string(),
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
    let nan = Passivity {
        damping_rotation: f32::NAN,
        ..passivity
    };
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
    let late = Passivity {
        delay_us: 500,
        ..passivity
    };
    assert_eq!(late.bounds(), [500.0, 31.25]);
    // Without damping nothing is passive but nothing.
    let free = Passivity {
        damping_translation: 0.0,
        ..passivity
    };
    assert!(free.admit(1e-6, 0.0).is_err());
    let none = Passivity {
        hold_us: 0,
        ..passivity
    };
    assert_eq!(none.check().unwrap_err().parameter, LimitParameter::Hold);
}

/// A mass at a virtual wall that is sampled and held, integrated finely: the energy that the wall has given to it when it
/// leaves.
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

fn line() -> Line {
    Line::new(20_000, 1_000)
}

#[test]
fn silence_is_noticed_before_20_ms_have_passed() {
    // Whatever the phase of the sample between two ticks, and wherever the clock wraps.
    for start in [0, u32::MAX - 5_000, 1 << 31, (1 << 31) - 10_000] {
        for phase in [0, 1, 499, 500, 999] {
            let mut line = line();
            assert!(line.is_silent(start));
            assert_eq!(line.arrive(0), Arrival::New);
            line.hear(start);
            let at = |tick: u32| start.wrapping_add(phase + tick * 1_000);
            let zero = (0..30).find(|&tick| line.is_silent(at(tick))).unwrap();
            let age = phase + zero * 1_000;
            assert!(age <= 20_000 && age > 19_000, "{age}");
            assert_eq!(line.silences, 1);
        }
    }
}

#[test]
fn silence_lasts_until_something_is_heard_however_often_the_clock_wraps() {
    let mut line = line();
    line.hear(0);
    let mut now = 0u32;
    for _ in 0..10_000 {
        now = now.wrapping_add(1_234_567);
        assert!(line.is_silent(now));
    }
    line.hear(now);
    assert!(!line.is_silent(now));
    assert_eq!(line.silences, 1);
    // A time stamp a little ahead of the clock is of now.
    line.hear(now.wrapping_add(3));
    assert!(!line.is_silent(now));
}

#[test]
fn late_and_lost_samples_are_counted() {
    let mut line = line();
    let numbers = [65_533, 65_534, 65_534, 2, 0, 3, 2, 4];
    let new = numbers.map(|number| {
        let arrival = line.arrive(number);
        line.hear(0);
        arrival == Arrival::New
    });
    assert_eq!(new, [true, true, false, true, false, true, false, true]);
    // 65 535, 0 and 1 are missing; 0 comes late after all; 65 534 and 2 come twice.
    assert_eq!((line.lost, line.late, line.restarts), (3, 3, 0));
}

#[test]
fn a_sender_that_begins_anew_is_believed_in_silence_only() {
    let mut line = line();
    for number in 1_000..1_010 {
        line.arrive(number);
    }
    line.hear(0);
    assert!(!line.is_silent(1_000));
    assert_eq!(line.arrive(0), Arrival::Late);
    assert_eq!(line.arrive(1), Arrival::Late);
    assert!(line.is_silent(20_000));
    // One of them alone may be an old one.
    assert_eq!(line.arrive(2), Arrival::Late);
    assert_eq!(line.arrive(3), Arrival::New);
    assert_eq!(line.arrive(4), Arrival::New);
    assert_eq!((line.restarts, line.late, line.lost), (1, 3, 0));
    // One that goes on where it was is believed at once.
    assert_eq!(line.arrive(7), Arrival::New);
    assert_eq!(line.lost, 2);
}

#[test]
fn counters_stay_at_their_largest_value() {
    let mut line = line();
    line.lost = u32::MAX - 1;
    line.late = u32::MAX;
    line.arrive(0);
    line.arrive(30_000);
    line.arrive(5);
    assert_eq!((line.lost, line.late), (u32::MAX, u32::MAX));
    let mut ticks = Ticks::new(1_000);
    ticks.missed = u32::MAX - 1;
    ticks.done = u32::MAX;
    ticks.tick(0);
    ticks.tick(1 << 30);
    assert_eq!((ticks.missed, ticks.done), (u32::MAX, u32::MAX));
}

#[test]
fn missed_ticks_are_counted_to_the_nearest() {
    let mut ticks = Ticks::new(1_000);
    let start = u32::MAX - 1_500;
    let times = [0, 1_000, 1_990, 3_010, 4_499, 6_100, 11_100, 11_100, 10_000];
    let missed = times.map(|time| ticks.tick(start.wrapping_add(time)));
    // A clock that stands still or goes backwards misses nothing.
    assert_eq!(missed, [0, 0, 0, 0, 0, 1, 4, 0, 0]);
    assert_eq!((ticks.missed, ticks.done), (5, 9));
}
