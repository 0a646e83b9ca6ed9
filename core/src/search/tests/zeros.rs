//! The first zero of a function.

use super::*;

/// The search never passes a zero, even if a later one is steeper.
#[test]
fn first_zero_is_the_first() {
    for shift in [0.3, 1.0, 1.7, 2.9_f64] {
        let found = first_zero(100.0, &mut { Looks::ALL }, |x| {
            Samples::far([Slope {
                value: libm::sin(shift + x) + 0.2 * libm::sin(7.0 * (shift + x)) + 0.1,
                slope: libm::cos(shift + x) + 1.4 * libm::cos(7.0 * (shift + x)),
                curvature: 1.0 + 9.8,
                rounding: 1e-15,
            }])
        });
        let f = |x: f64| libm::sin(shift + x) + 0.2 * libm::sin(7.0 * (shift + x)) + 0.1;
        // The interpreter is slow.
        let step = if cfg!(miri) { 1e-3 } else { 1e-5 };
        let first = (0..1_000_000)
            .map(|i| f64::from(i) * step)
            .find(|&x| f(x) <= 0.0);
        let (Found::Zero { x, .. }, Some(first)) = (found, first) else {
            panic!("{found:?} {first:?}");
        };
        assert!(x <= first && first - x < 2.0 * step, "{x} {first}");
    }
}

/// A function that starts a little above zero and rises is not at its zero.
#[test]
fn rising_start_is_no_zero() {
    // Zero at 1.
    let found = first_zero(2.0, &mut { Looks::ALL }, |x: f64| {
        Samples::far([Slope {
            value: 1e-6 * (1.0 - x) + x * (1.0 - x),
            slope: 1.0 - 1e-6 - 2.0 * x,
            // A bound.
            curvature: 8.0,
            rounding: 5e-7,
        }])
    });
    let Found::Zero { x, which: 0 } = found else {
        panic!("{found:?}");
    };
    assert!((x - 1.0).abs() <= 1e-6, "{x}");
}
