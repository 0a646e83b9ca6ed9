//! The angle of a vector, by one division and a polynomial of degree 9 on [0, tan(pi/8)], and an angle as whole
//! turns and a remainder.

use super::product::{high, square};
use super::quotient::Divisor;

/// pi in units of 2^-29.
const HALF_TURN: i32 = 1_686_629_713;
/// The largest Q24 number of half a turn.
const HALF_TURN_24: i32 = 52_707_179;

/// The angle of the vector (x, y) in [-pi, pi]; 0 for the zero vector.
#[inline(never)]
pub(super) fn arctangent(y: i32, x: i32) -> i32 {
    let (right, up) = (x.unsigned_abs(), y.unsigned_abs());
    if right | up == 0 {
        return 0;
    }
    let angle = if up > right {
        (HALF_TURN / 2).wrapping_sub(within_octant(right, up))
    } else {
        within_octant(up, right)
    };
    let angle = if x < 0 {
        HALF_TURN.wrapping_sub(angle)
    } else {
        angle
    };
    let sign = y >> 31;
    ((angle.wrapping_add(1 << 4) >> 5) ^ sign).wrapping_sub(sign)
}

/// 2^29 atan(small / large) for 0 <= small <= large.
#[inline]
fn within_octant(small: u32, large: u32) -> i32 {
    let shift = large.leading_zeros().wrapping_sub(1);
    let (small, large) = (small << shift, large << shift);
    let below_22_degrees = (large >> 2)
        .wrapping_add(large >> 3)
        .wrapping_add(large >> 5);
    let (base, opposite, adjacent) = if small <= below_22_degrees {
        (0, small, large)
    } else {
        let (less, sum) = (large.wrapping_sub(small), large.wrapping_add(small));
        let halved = sum >> 31;
        (HALF_TURN / 4, less >> halved, sum >> halved)
    };
    let angle = small_angle(Divisor::new(adjacent).ratio(opposite) as i32);
    if base == 0 {
        angle
    } else {
        i32::wrapping_sub(base, angle)
    }
}

/// 2^29 atan(t) for 2^30 t, 0 <= t <= 0.4223.
#[inline]
fn small_angle(t: i32) -> i32 {
    let y = square(t << 1);
    let short = y >> 13;
    let c = (short.wrapping_mul(40_914) >> 4).wrapping_sub(1_184_814_593);
    let c = high(y, c).wrapping_add(857_654_885);
    let c = high(y, c).wrapping_sub(715_813_633);
    (t >> 1).wrapping_add(high(t << 1, high(y, c)))
}

/// An angle as whole turns and a remainder in [-pi, pi].
#[inline]
pub(super) fn turns(angle: i32) -> (i32, i32) {
    if angle.wrapping_abs() <= HALF_TURN_24 {
        return (0, angle);
    }
    let (turns, rest) = reduced(angle.wrapping_abs());
    let sign = angle >> 31;
    let signed = |size: i32| (size ^ sign).wrapping_sub(sign);
    (signed(turns), signed(rest))
}

/// For an angle above half a turn.
#[inline(never)]
fn reduced(angle: i32) -> (i32, i32) {
    const INVERSE: i32 = 10_430; // 2^16 / (2 pi)
    const TURN: i32 = 3_373_259_426u32 as i32; // 2^29 times the angle, modulo 2^32
    let mut turns = (angle >> 14).wrapping_mul(INVERSE).wrapping_add(1 << 25) >> 26;
    let mut rest = angle.wrapping_shl(5).wrapping_sub(turns.wrapping_mul(TURN));
    if rest > HALF_TURN {
        turns = turns.wrapping_add(1);
        rest = rest.wrapping_sub(TURN);
    }
    (turns, rest.wrapping_add(1 << 4) >> 5)
}

#[cfg(test)]
mod tests {
    use super::super::samples::{edges, pairs, random_pairs, sampled};
    use super::*;

    const UNIT: f64 = 16_777_216.0;

    #[test]
    fn arctangent_is_within_its_bound() {
        let around = sampled(-314_200..=314_200).map(|i| {
            let (sin, cos) = libm::sincos(f64::from(i) / 100_000.0);
            ((sin * UNIT) as i32, (cos * UNIT) as i32)
        });
        let anywhere = random_pairs(2_000_000);
        for (y, x) in pairs().chain(around).chain(anywhere) {
            let exact = libm::atan2(f64::from(y), f64::from(x)) * UNIT;
            let error = f64::from(arctangent(y, x)) - exact;
            assert!(error.abs() <= 0.75, "{y} {x} {error}");
        }
    }

    #[test]
    fn mirrored_vectors_give_mirrored_angles() {
        for (y, x) in pairs().filter(|(y, x)| (*y, *x) != (0, 0)) {
            assert_eq!(
                arctangent(-y, x),
                if y == 0 {
                    arctangent(y, x)
                } else {
                    -arctangent(y, x)
                }
            );
        }
    }

    #[test]
    fn turns_and_remainder_make_the_angle() {
        let everywhere = sampled((-i32::MAX..i32::MAX - 1009).step_by(1009));
        for angle in edges().chain(everywhere) {
            let (whole, rest) = turns(angle);
            let exact = f64::from(angle) - f64::from(whole) * core::f64::consts::TAU * UNIT;
            assert!((f64::from(rest) - exact).abs() <= 0.6, "{angle}");
            assert!(rest.abs() <= HALF_TURN_24, "{angle}");
            assert_eq!(turns(-angle), (-whole, -rest));
        }
    }
}
