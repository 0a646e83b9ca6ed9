//! Sine and cosine: whole quarter turns are removed in units of 2^-31 rad, then polynomials of degree 7 and 8 on
//! [-pi/4, pi/4], fitted to minimise the largest error.

use super::product::{high, square};
use super::quotient::divide;

/// 2^31 pi / 2
const QUARTER_TURN: u32 = 3_373_259_426;

/// An angle (rad) as quarter turns and the rest in [-pi/4, pi/4], slightly more at its ends, times 2^31.
#[inline]
fn quarter_turns(angle: i32) -> (i32, i32) {
    const INVERSE: i32 = 10_430; // 2^14 * 2 / pi
    let quarters = (angle >> 14).wrapping_mul(INVERSE).wrapping_add(1 << 23) >> 24;
    let rest = (angle as u32)
        .wrapping_shl(7)
        .wrapping_sub((quarters as u32).wrapping_mul(QUARTER_TURN));
    (quarters, rest as i32)
}

/// 2^32 (sin(x) / x - 1) for y = 2^31 x².
#[inline]
fn sine_excess(y: i32) -> i32 {
    let short = y as u32 >> 15;
    let c = 143_142_114i32.wrapping_sub((short.wrapping_mul(52_329) >> 10) as i32);
    let c = high(y, c).wrapping_sub(1_431_654_374);
    high(y, c)
}

/// 2^30 cos(x) for y = 2^31 x².
#[inline]
fn cosine(y: i32) -> i32 {
    let short = y as u32 >> 15;
    let c = ((short.wrapping_mul(52_478) >> 14) as i32).wrapping_sub(11_929_147);
    let c = high(y, c).wrapping_add(178_956_885);
    let c = high(y, c).wrapping_sub(1 << 30);
    high(y, c).wrapping_add(1 << 30)
}

#[inline]
fn turned(quarters: i32, sin: i32, cos: i32) -> (i32, i32) {
    let (sin, cos) = if quarters & 1 == 0 {
        (sin, cos)
    } else {
        (cos, sin.wrapping_neg())
    };
    if quarters & 2 == 0 {
        (sin, cos)
    } else {
        (sin.wrapping_neg(), cos.wrapping_neg())
    }
}

/// The sine and cosine of an angle (rad).
#[inline(never)]
pub(super) fn sine_and_cosine(angle: i32) -> (i32, i32) {
    let sign = angle >> 31;
    let (quarters, x) = quarter_turns(angle.wrapping_abs());
    let y = square(x);
    let sin = x.wrapping_add(high(x, sine_excess(y)));
    let cos = cosine(y);
    let (sin, cos) = turned(
        quarters,
        sin.wrapping_add(1 << 6) >> 7,
        cos.wrapping_add(1 << 5) >> 6,
    );
    ((sin ^ sign).wrapping_sub(sign), cos)
}

/// sin(x) / x, which is 1 at 0, and cos(x).
#[inline(never)]
pub(super) fn sinc_and_cosine(angle: i32) -> (i32, i32) {
    let (quarters, x) = quarter_turns(angle.wrapping_abs());
    if quarters == 0 {
        let y = square(x);
        let sinc = (sine_excess(y).wrapping_add(1 << 7) >> 8).wrapping_add(1 << 24);
        (sinc, cosine(y).wrapping_add(1 << 5) >> 6)
    } else {
        let (sin, cos) = sine_and_cosine(angle);
        (divide(sin, angle), cos)
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{edges, sampled};
    use super::*;

    const UNIT: f64 = 16_777_216.0;

    fn angles() -> impl Iterator<Item = i32> {
        let everywhere = sampled((-i32::MAX..i32::MAX - 5003).step_by(5003));
        let small = sampled(-200_000..200_000);
        edges().chain(everywhere).chain(small)
    }

    #[test]
    fn sine_and_cosine_are_within_their_bound() {
        for angle in angles() {
            let (sin, cos) = sine_and_cosine(angle);
            let x = f64::from(angle) / UNIT;
            let errors = [
                f64::from(sin) - libm::sin(x) * UNIT,
                f64::from(cos) - libm::cos(x) * UNIT,
            ];
            assert!(errors.iter().all(|e| e.abs() <= 0.65), "{x} {errors:?}");
        }
    }

    #[test]
    fn sinc_is_within_its_bound() {
        assert_eq!(sinc_and_cosine(0), (1 << 24, 1 << 24));
        for angle in angles().filter(|angle| *angle != 0) {
            let (sinc, cos) = sinc_and_cosine(angle);
            let x = f64::from(angle) / UNIT;
            let error = f64::from(sinc) - libm::sin(x) / x * UNIT;
            // Below an eighth of a turn there is no division.
            let bound = if x.abs() < 0.78 { 0.65 } else { 1.2 };
            assert!(error.abs() <= bound, "{x} {error}");
            assert_eq!(cos, sine_and_cosine(angle).1);
        }
    }

    #[test]
    fn mirrored_angles_give_mirrored_sines() {
        for angle in angles() {
            let (sin, cos) = sine_and_cosine(angle);
            assert_eq!(sine_and_cosine(-angle), (-sin, cos));
            assert_eq!(sinc_and_cosine(-angle), sinc_and_cosine(angle));
        }
    }
}
