//! The units of a scene.

use super::*;

/// 1 over a unit is less than [`Real::HUGE`], which represents everything beyond all numbers; so is the unit itself.
fn check<F: Real>() {
    let usable = |unit: F| Units::new(F::ONE, unit).are_usable();
    let least = F::ONE / F::HUGE;
    assert!(!usable(F::ZERO) && !usable(least.halved()) && !usable(least));
    assert!(usable(least.doubled()) && usable(F::ONE) && usable(F::HUGE));
    assert!(!usable(F::ONE / F::ZERO));
    let small = |length: F| Units::new(length, F::ONE / length).are_usable();
    assert!(!small(least) && small(least.doubled()));
}

#[test]
fn units_are_no_less_than_one_over_the_largest_number() {
    check::<f32>();
    check::<f64>();
}
