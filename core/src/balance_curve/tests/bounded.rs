//! The bounded quantities of a motion of two contacts, against its formulas.

use super::*;

/// On a motion of two contacts: each quantity with its bounds from its beginning to the end of the
/// window.
#[test]
fn quantities_are_bounded() {
    const WINDOW: f64 = 0.8;
    for seed in sampled(1..=200, 29) {
        let mut random = Random(seed);
        let curve = random.kinematic();
        let formula = |x: f64| {
            let (sin, cos) = libm::sincos(curve.rate * x);
            (sin * curve.hold.x + (1.0 - cos) * curve.hold.y) / curve.rate
        };
        let once = (0.0, core::f64::consts::TAU / curve.rate.abs());
        let bounded = [
            |m: &BalanceCurve<f64>, x: f64| m.rotation_as(&m.at(x)).0,
            |m: &BalanceCurve<f64>, x: f64| m.rotation_as(&m.at(x)).1,
            |m: &BalanceCurve<f64>, x: f64| m.turn_as(&m.at(x), WINDOW),
            |m: &BalanceCurve<f64>, x: f64| m.part_as(&m.at(x), WINDOW),
            |m: &BalanceCurve<f64>, x: f64| m.part_velocity_as(&m.at(x)),
        ];
        for (i, bounded) in bounded.into_iter().enumerate() {
            let at = |x: f64| bounded(&curve, x);
            for x in [0.0, 0.3, 0.8] {
                let Bounded { value, slope, .. } = at(x);
                let (sin, cos) = libm::sincos(curve.rate * x);
                let turn = curve.rate * x;
                let velocity = cos * curve.hold.x + sin * curve.hold.y;
                let should = [cos, sin, turn, formula(x), velocity];
                close(value, should[i], curve.hold.length_bound());
                close(
                    slope,
                    derivatives(|x| at(x).value, x)[0],
                    at(x).bounds.suprema[1],
                );
            }
            let [most, steepest, curvature] = at(0.0).bounds.suprema;
            let values = largest(|x| at(x).value, (0.0, WINDOW));
            let slopes = largest(|x| at(x).slope, once);
            let size = match i {
                // A quantity that grows with x grows by no more than this.
                2 | 3 => slopes * WINDOW,
                _ => largest(|x| at(x).value, once),
            };
            let curvatures = largest(|x| derivatives(|x| at(x).slope, x)[0], once);
            assert!(values <= most * (1.0 + 1e-9) && most <= 1.3 * size);
            assert!(slopes <= steepest * (1.0 + 1e-9) && steepest <= 1.3 * slopes);
            assert!(curvatures <= curvature + 1e-5 && curvature <= 1.3 * curvatures + 1e-5);
        }
        for far in [0.3, 3.0] {
            let part_bound = curve.extent_to(far).part_bound;
            let most = largest(formula, (0.0, far));
            let steepest = largest(|x| curve.at(x).h_slope, once);
            assert!(
                most <= part_bound && part_bound <= 1.3 * far * steepest,
                "{most} {part_bound}"
            );
        }
        let rate: Bounded<f64> = curve.rate_as();
        assert_eq!(rate.value, curve.rate);
        assert_eq!(rate.bounds.suprema, [curve.rate.abs(), 0.0, 0.0]);
    }
}
