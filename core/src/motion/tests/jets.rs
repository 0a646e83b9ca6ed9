//! The jets of a motion of two contacts, against its formulas.

use super::*;

/// On a motion of two contacts: each with its bounds from its beginning to the end of the window.
#[test]
fn jets_are_bounded() {
    const WINDOW: f64 = 0.8;
    for seed in sampled(1..=200, 29) {
        let mut random = Random(seed);
        let motion = random.kinematic();
        let formula = |x: f64| {
            let (sin, cos) = libm::sincos(motion.rate * x);
            (sin * motion.hold.x + (1.0 - cos) * motion.hold.y) / motion.rate
        };
        let once = (0.0, core::f64::consts::TAU / motion.rate.abs());
        let jets = [
            |m: &Motion<f64>, x: f64| m.rotation_jets(&m.at(x)).0,
            |m: &Motion<f64>, x: f64| m.rotation_jets(&m.at(x)).1,
            |m: &Motion<f64>, x: f64| m.turn_jet(&m.at(x), WINDOW),
            |m: &Motion<f64>, x: f64| m.part_jet(&m.at(x), WINDOW),
            |m: &Motion<f64>, x: f64| m.part_velocity(&m.at(x)),
        ];
        for (i, jet) in jets.into_iter().enumerate() {
            let at = |x: f64| jet(&motion, x);
            for x in [0.0, 0.3, 0.8] {
                let Jet { value, slope, .. } = at(x);
                let (sin, cos) = libm::sincos(motion.rate * x);
                let turn = motion.rate * x;
                let velocity = cos * motion.hold.x + sin * motion.hold.y;
                let should = [cos, sin, turn, formula(x), velocity];
                close(value, should[i], motion.hold.reach());
                close(slope, derivatives(|x| at(x).value, x)[0], at(x).bounds[1]);
            }
            let [most, steepest, bent] = at(0.0).bounds;
            let values = largest(|x| at(x).value, (0.0, WINDOW));
            let slopes = largest(|x| at(x).slope, once);
            let size = match i {
                // What grows with the way grows at most by this.
                2 | 3 => slopes * WINDOW,
                _ => largest(|x| at(x).value, once),
            };
            let curvatures = largest(|x| derivatives(|x| at(x).slope, x)[0], once);
            assert!(values <= most * (1.0 + 1e-9) && most <= 1.3 * size);
            assert!(slopes <= steepest * (1.0 + 1e-9) && steepest <= 1.3 * slopes);
            assert!(curvatures <= bent + 1e-5 && bent <= 1.3 * curvatures + 1e-5);
        }
        for way in [0.3, 3.0] {
            let reach = motion.course_to(way).reach;
            let most = largest(formula, (0.0, way));
            let steepest = largest(|x| motion.at(x).h_slope, once);
            assert!(
                most <= reach && reach <= 1.3 * way * steepest,
                "{most} {reach}"
            );
        }
        assert_eq!(motion.rate_jet().value, motion.rate);
        assert_eq!(motion.rate_jet().bounds, [motion.rate.abs(), 0.0, 0.0]);
    }
}
