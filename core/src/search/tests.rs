//! The certified step and the first zero against their definitions: what is passed, what counts as zero, what gives up.

use super::*;
use crate::fixtures::searches;

mod zeros;

/// The step leads to the zero of the lowest curve that a bound of the curvature permits, E + d x - K x²/2; a function that starts at zero
/// and rises is stepped to the crest of that.
#[test]
fn steps_follow_the_lowest_course() {
    const ROUNDING: f64 = 1e-9;
    let slope = |value: f64, slope: f64, curvature: f64| Slope {
        value,
        slope,
        curvature,
        rounding: ROUNDING,
    };
    for e in [1e-3, 0.5, 40.0] {
        for d in [-30.0, -0.2, 0.0, 0.2, 30.0] {
            for k in [1e-3, 1.0, 70.0] {
                let f = slope(e, d, k);
                let step = f.safe_step();
                let lowest = |x: f64| e + d * x - k * x * x / 2.0;
                let size = e + d.abs() * step;
                assert!(lowest(step).abs() < 1e-12 * size && lowest(0.99 * step) > 0.0);
                assert_eq!(f.first_step(), step);
                assert!(f.is_clear_of(0.99 * step - ROUNDING / e));
                assert!(!f.is_clear_of(1.01 * step));
            }
        }
        for d in [0.0, 1.0] {
            assert_eq!(slope(e, d, 0.0).safe_step(), <f64 as Real>::HUGE);
        }
    }
    let zero = 0.5 * ROUNDING;
    for (value, d, first) in [
        (ROUNDING, 3.0, 1.5),
        (zero, 3.0, 1.5),
        (-1.0, 3.0, 1.5),
        (zero, -3.0, 0.0),
        (zero, 0.0, 0.0),
    ] {
        assert_eq!(slope(value, d, 2.0).first_step(), first, "{value} {d}");
        // Later on it is reached, or, if the function still falls, just before.
        let next = slope(value, d, 2.0).safe_step();
        assert!(if value > 0.0 && d < 0.0 {
            next > 0.0 && next < ROUNDING
        } else {
            next == 0.0
        });
    }
    assert_eq!(slope(zero, 3.0, 0.0).first_step(), <f64 as Real>::HUGE);
}

/// A value as small as its rounding is not clear of zero, at the beginning or at the end of a step.
#[test]
fn rounding_counts_as_zero() {
    const ROUNDING: f64 = 1.0 / 1024.0;
    let slope = |value: f64, slope: f64| Slope {
        value: value * ROUNDING,
        slope: slope * ROUNDING,
        curvature: 0.0,
        rounding: ROUNDING,
    };
    for (value, d, is_clear) in [
        (1.0, 1.0, false),
        (2.0, -1.0, false),
        (1.5, 0.0, true),
        (2.0, -0.5, true),
        (3.0, -3.0, false),
    ] {
        assert_eq!(slope(value, d).is_clear_of(1.0), is_clear, "{value} {d}");
    }
}

/// Of two zeros at one point the first in the list counts; with no zero before the limit there is none.
#[test]
fn first_listed_of_two_zeros_counts() {
    let falls = |x: f64, from: f64| Slope {
        value: from - x,
        slope: -1.0,
        curvature: 0.0,
        rounding: 1e-15,
    };
    for (begins, which) in [([1.0, 1.0], 0), ([1.5, 1.0], 1), ([1.0, 1.5], 0)] {
        let sample = |x: f64| Samples::far(begins.map(|from| falls(x, from)));
        let found = first_zero(8.0, &mut { Looks::ALL }, sample);
        assert_eq!(found, Found::Zero { x: 1.0, which });
        let found = first_zero(0.5, &mut { Looks::ALL }, sample);
        assert_eq!(found, Found::Nothing { x: 0.0 });
    }
}

/// (1 - x)² with a bound of its curvature that is twice too large: every step is a fraction of the distance to its double root. A search
/// that gives up reports it, at a point up to which there is no zero.
#[test]
fn search_that_gives_up_says_so() {
    let falls = |x: f64| Slope {
        value: (1.0 - x) * (1.0 - x),
        slope: -2.0 * (1.0 - x),
        curvature: 4.0,
        rounding: 1e-30,
    };
    let flat = Slope {
        value: 1.0,
        slope: 0.0,
        curvature: 0.0,
        rounding: 1e-30,
    };
    let mut last = 0.0;
    for most in 1..20 {
        let search = || first_zero(8.0, &mut { Looks::ALL }, |x| Samples::far([flat, falls(x)]));
        let (found, counts) = searches::giving_up(most, search);
        let Found::Unsure { x, which: 1 } = found else {
            panic!("{most}: {found:?}");
        };
        assert!(x > last && x < 1.0, "{most}: {x}");
        assert_eq!((counts.steps, counts.unsure), (most, 1));
        last = x;
    }
}
