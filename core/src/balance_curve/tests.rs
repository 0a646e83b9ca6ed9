//! The curve and the quantities on it, against their formulas and against finite differences. The bounds of the curvatures must hold over
//! the range that they are given for, and must be no looser than the terms that they are sums of.

use super::*;
use crate::bounded::Bounded;
use crate::fixtures::{Random, sampled, searches};
use crate::moment::{Drive, Sliding};

mod bounded;
mod cases;
mod ends;
mod reversal;

impl Random {
    /// A number of a magnitude from 0.03 to 10.
    fn number(&mut self) -> f64 {
        let size = libm::exp(3.0 * self.next() - 0.7);
        size * self.next().sign()
    }
    fn numbers(&mut self) -> Vec2<f64> {
        Vec2::new(self.number(), self.number())
    }
    /// (cos, sin) of an angle from an edge of a friction cone to the normal.
    fn edge(&mut self) -> (f64, f64) {
        let (sin, cos) = libm::sincos(1.5 * self.next());
        (cos, sin)
    }
    fn moment<H: SecondHarmonic<f64>>(&mut self) -> Moment<f64, H> {
        Moment {
            couple: 0.0,
            stiffness: self.number().abs(),
            hold: self.numbers(),
            harmonic: H::sliding((self.number(), self.number()), self.edge()),
        }
    }
    fn drive(&mut self) -> Drive<f64> {
        Drive {
            couple: self.number(),
            hold: self.numbers(),
        }
    }
    fn curve<H: SecondHarmonic<f64>>(&mut self) -> BalanceCurve<f64, H> {
        BalanceCurve::balanced(&self.moment::<H>(), &self.drive())
    }
    fn kinematic(&mut self) -> BalanceCurve<f64> {
        BalanceCurve::kinematic(self.number(), self.numbers())
    }
    fn margin(&mut self) -> Margin<f64> {
        Margin {
            start: self.number(),
            along: self.number(),
            turning: self.numbers(),
            rounding: 1e-15,
        }
    }
}

const STEP: f64 = 1e-4;

/// Points, and windows over which a bound must hold from there.
const WINDOWS: [(f64, f64); 5] = [
    (0.0, 0.1),
    (0.05, 0.02),
    (0.3, 0.5),
    (0.01, 2.0),
    (3.0, 0.01),
];

/// The first and the second derivative at a point.
fn derivatives(f: impl Fn(f64) -> f64, x: f64) -> [f64; 2] {
    let (before, at, after) = (f(x - STEP), f(x), f(x + STEP));
    let first = (after - before) / (2.0 * STEP);
    [first, (after - 2.0 * at + before) / (STEP * STEP)]
}

/// The largest magnitude of a function over a range, by dense sampling.
fn largest(f: impl Fn(f64) -> f64, (from, to): (f64, f64)) -> f64 {
    let places = (0..=64).map(|i| from + (to - from) * f64::from(i) / 64.0);
    places.map(|x| f(x).abs()).fold(0.0, f64::max)
}

#[track_caller]
fn close(is: f64, should: f64, size: f64) {
    let bound = 1e-6 * (size.abs() + should.abs());
    assert!((is - should).abs() <= bound, "{is} for {should} of {size}");
}

/// |f''| stays below its bound over a range, and the bound below a few times `terms`.
#[track_caller]
fn bounds(bound: f64, second: f64, terms: f64) {
    assert!(second <= bound * (1.0 + 1e-9) + 1e-5, "{second} > {bound}");
    assert!(bound <= 2.5 * terms + 1e-5, "{bound} for {terms}");
}

/// E at a point and a tau.
fn level(margin: &Margin<f64>, p: &Place<f64>, tau: f64) -> f64 {
    let (sin, cos) = libm::sincos(p.turn);
    let Vec2 { x, y } = margin.turning;
    margin.start + margin.along * tau - x * (1.0 - cos) + y * sin
}

/// The largest derivatives of H and D on the whole turn, orders 1 to 3.
fn turns<H: SecondHarmonic<f64>>(curve: &BalanceCurve<f64, H>) -> [[f64; 3]; 2] {
    let once = (0.0, core::f64::consts::TAU / curve.rate.abs());
    let second = |x: f64| curve.second(&curve.at(x));
    [
        [
            largest(|x| curve.at(x).h_slope, once),
            largest(|x| second(x).0, once),
            largest(|x| derivatives(|x| second(x).0, x)[0], once),
        ],
        [
            largest(|x| curve.at(x).d_slope, once),
            largest(|x| second(x).1, once),
            largest(|x| derivatives(|x| second(x).1, x)[0], once),
        ],
    ]
}

/// Runs every test with a foot that stays and with one that slides.
macro_rules! test_both {
    ($($case:ident),* $(,)?) => {$(
        #[test]
        fn $case() {
            for seed in sampled(1..=200, 29) {
                cases::$case::<Pinned>(&mut Random(seed));
                cases::$case::<Sliding<f64>>(&mut Random(seed));
            }
        }
    )*};
}

test_both! {
    curve_is_in_balance,
    slopes_are_derivatives,
    fold_is_where_the_part_stops_growing,
    margin_is_bounded,
    extent_ends_at_its_first_event,
    balance_is_polished_and_curved,
}

/// The springs of a hand that turns by `dphi` against a load of `kappa`.
fn turning(kappa: f64, dphi: f64) -> BalanceCurve<f64> {
    let moment = Moment {
        couple: 0.0,
        stiffness: 1.0,
        hold: Vec2::new(kappa, 0.0),
        harmonic: Pinned,
    };
    let drive = Drive {
        couple: dphi,
        hold: Vec2::ZERO,
    };
    BalanceCurve::balanced(&moment, &drive)
}

/// STATICS 11: u + kappa sin u = delta folds as delta grows from 0.
#[test]
fn turn_of_the_hand_ends_at_the_fold() {
    for (kappa, fold, delta) in [
        (1.05, 2.831_748_013_8, 3.151_904_225_7),
        (1.5, 2.300_523_983_0, 3.418_557_971_8),
        (2.0, 2.094_395_102_4, 3.826_445_910_0),
        (5.0, 1.772_154_247_6, 6.671_133_733_2),
    ] {
        for turn in [1.01 * delta, 1.5 * delta, 10.0 * delta] {
            let extent = turning(kappa, turn).extent();
            assert!(extent.folds && !extent.unsure, "{kappa}");
            // A double root: half of the digits.
            assert!((extent.end.turn - fold).abs() < 1e-6, "{kappa}");
            assert!((extent.end.part() * turn - delta).abs() < 1e-9, "{kappa}");
        }
        let extent = turning(kappa, 0.99 * delta).extent();
        assert!(!extent.folds && extent.end.turn < fold);
    }
}
