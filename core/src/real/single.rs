//! `f32`: the default. Own polynomials, fitted to minimise the largest error: sine and cosine of degree 7 and 8 on
//! [-pi/4, pi/4] (error below 1.2e-7), arctangent of degree 9 on [0, tan(pi/8)] (error below 4e-7 over the circle).
//! Only +, -, ×, / and a correctly rounded square root: the same bits on every machine.

use super::Real;
use core::f32::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// pi/2 in two parts, the first with 12 trailing zero bits, so that small multiples of it are exact.
const QUARTER_TURN: (f32, f32) = (1.570_312_5, 4.838_268e-4);

/// The range in which sine and cosine need no reduction.
const SMALL: f32 = 0.78;

/// sin(x) / x - 1 for |x| <= pi/4, y = x².
fn sine_excess(y: f32) -> f32 {
    y * (-0.166_666_51 + y * (0.008_331_978 - y * 0.000_194_955_68))
}

/// sin(x) for |x| <= pi/4, y = x².
fn sine(x: f32, y: f32) -> f32 {
    x + x * sine_excess(y)
}

/// cos(x) for |x| <= pi/4, y = x².
fn cosine(y: f32) -> f32 {
    1.0 - 0.5 * y + y * y * (0.041_666_646 + y * (-0.001_388_736_7 + y * 2.443_838e-5))
}

/// atan(x) for |x| <= tan(pi/8).
fn arctangent(x: f32) -> f32 {
    let y = x * x;
    x + x * y * (-0.333_327_56 + y * (0.199_718_71 + y * (-0.138_243_75 + y * 0.079_023_43)))
}

/// Sine and cosine of an angle: reduced to a quarter turn in two steps. Compiled once per image.
#[inline(never)]
fn reduced(angle: f32) -> (f32, f32) {
    let quarters = (angle * FRAC_2_PI + 0.5f32.copysign(angle)) as i32;
    let n = quarters as f32;
    let x = (angle - n * QUARTER_TURN.0) - n * QUARTER_TURN.1;
    let y = x * x;
    let (s, c) = (sine(x, y), cosine(y));
    match quarters & 3 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// The whole turns of an angle and the remainder. Compiled once per image.
#[inline(never)]
fn whole_turns(x: f32) -> (i32, f32) {
    let turns = (x / TAU + 0.5f32.copysign(x)) as i32;
    let n = turns as f32 * 4.0;
    (turns, (x - n * QUARTER_TURN.0) - n * QUARTER_TURN.1)
}

impl Real for f32 {
    type Si = f32;

    const ZERO: f32 = 0.0;
    const HALF: f32 = 0.5;
    const ONE: f32 = 1.0;
    const TWO: f32 = 2.0;
    const TAU: f32 = TAU;
    const EPSILON: f32 = f32::EPSILON;
    const TOUCH: f32 = 1e-6;
    const MICRO: f32 = 1.0 / 524_288.0;
    const RANGE: f32 = 1e6;
    const LOAD: f32 = 4.0 * Self::RANGE;
    const TURN: f32 = 1e5;
    const HUGE: f32 = 1e15;
    const LEAST: f32 = -Self::HUGE;

    fn from_int(n: i32) -> f32 {
        n as f32
    }
    fn from_si(x: f32, per: f32) -> f32 {
        x * per
    }
    fn to_si(self, unit: f32) -> f32 {
        self * unit
    }
    fn is_finite(self) -> bool {
        f32::is_finite(self)
    }
    fn sqrt(self) -> f32 {
        if self > 0.0 { libm::sqrtf(self) } else { 0.0 }
    }
    fn abs(self) -> f32 {
        f32::abs(self)
    }
    #[inline]
    fn sin_cos(self) -> (f32, f32) {
        if self.abs() < SMALL {
            let y = self * self;
            (sine(self, y), cosine(y))
        } else {
            reduced(self)
        }
    }
    fn sinc_cos(self) -> (f32, f32) {
        if self.abs() < SMALL {
            let y = self * self;
            return (1.0 + sine_excess(y), cosine(y));
        }
        let (sin, cos) = Real::sin_cos(self);
        (sin / self, cos)
    }
    /// The arctangent of the smaller over the larger coordinate, reduced to tan(pi/8), moved to its octant.
    fn atan2(self, other: f32) -> f32 {
        let (x, y) = (other.abs(), self.abs());
        if x == 0.0 && y == 0.0 {
            return 0.0;
        }
        let swapped = y > x;
        let ratio = if swapped { x / y } else { y / x };
        let angle = if ratio > 0.414_213_57 {
            FRAC_PI_4 + arctangent((ratio - 1.0) / (ratio + 1.0))
        } else {
            arctangent(ratio)
        };
        let angle = if swapped { FRAC_PI_2 - angle } else { angle };
        let angle = if other < 0.0 { PI - angle } else { angle };
        angle.copysign(self)
    }
    #[inline]
    fn turns(self) -> (i32, f32) {
        if self.abs() <= PI {
            (0, self)
        } else {
            whole_turns(self)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixed::samples::sampled;
    use super::*;

    #[test]
    fn sine_and_cosine_are_within_their_bound() {
        for i in sampled(-32_000..=32_000_i16) {
            let x = f32::from(i) / 5_000.0;
            let (sin, cos) = Real::sin_cos(x);
            assert!(
                (f64::from(sin) - libm::sin(f64::from(x))).abs() < 1.2e-7,
                "sin {x}"
            );
            assert!(
                (f64::from(cos) - libm::cos(f64::from(x))).abs() < 1.2e-7,
                "cos {x}"
            );
        }
    }

    #[test]
    fn arctangent_is_within_its_bound() {
        for i in sampled(-31_400..=31_400_i16) {
            let angle = f64::from(i) / 10_000.0;
            let (y, x) = (libm::sin(angle) as f32, libm::cos(angle) as f32);
            let exact = libm::atan2(f64::from(y), f64::from(x));
            assert!(
                (f64::from(Real::atan2(y, x)) - exact).abs() < 4e-7,
                "{angle}"
            );
        }
        for (y, x) in [(0.0, 2.0), (2.0, 0.0), (-2.0, 0.0), (0.0, -2.0)] {
            let exact = libm::atan2(f64::from(y), f64::from(x)) as f32;
            assert_eq!(Real::atan2(y, x), exact, "{y} {x}");
        }
        assert_eq!(Real::atan2(0.0, 0.0_f32), 0.0);
    }

    #[test]
    fn turns_and_remainder_make_the_angle() {
        for i in sampled(-1000..=1000_i16) {
            let x = f32::from(i) * 0.37;
            let (turns, rest) = x.turns();
            let exact = f64::from(x) - f64::from(turns) * core::f64::consts::TAU;
            assert!(rest.abs() <= PI + 1e-6);
            assert!((f64::from(rest) - exact).abs() < 1e-6 * (1.0 + f64::from(x).abs() / 10.0));
        }
    }
}
