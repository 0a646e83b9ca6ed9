//! `f64`: the reference. Trigonometry and square root from libm, in software, the same bits everywhere.

use super::Real;
use core::f64::consts::{PI, TAU};

impl Real for f64 {
    type Si = f64;

    const ZERO: f64 = 0.0;
    const HALF: f64 = 0.5;
    const ONE: f64 = 1.0;
    const TWO: f64 = 2.0;
    const TAU: f64 = TAU;
    const EPSILON: f64 = f64::EPSILON;
    const TOUCH: f64 = 1e-10;
    const MICRO: f64 = 1.0 / 524_288.0;
    const RANGE: f64 = 1e12;
    const LOAD: f64 = 4.0 * Self::RANGE;
    const TURN: f64 = 1e5;
    const HUGE: f64 = 1e30;
    const LEAST: f64 = -Self::HUGE;

    fn from_int(n: i32) -> f64 {
        f64::from(n)
    }
    fn from_si(x: f64, per: f64) -> f64 {
        x * per
    }
    fn to_si(self, unit: f64) -> f64 {
        self * unit
    }
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
    fn sqrt(self) -> f64 {
        if self > 0.0 { libm::sqrt(self) } else { 0.0 }
    }
    fn abs(self) -> f64 {
        f64::abs(self)
    }
    fn sin_cos(self) -> (f64, f64) {
        libm::sincos(self)
    }
    fn atan2(self, other: f64) -> f64 {
        libm::atan2(self, other)
    }
    fn turns(self) -> (i32, f64) {
        if self.abs() <= PI {
            return (0, self);
        }
        let turns = (self / TAU + 0.5f64.copysign(self)) as i32;
        (turns, self - f64::from(turns) * TAU)
    }
}
