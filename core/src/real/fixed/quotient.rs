//! Quotients without a divide instruction: digits of 12 bits, each from a 16-bit reciprocal of the divisor, never too
//! large, so that the remainder stays positive and the last one gives exact rounding.

use super::product::{PLACES, RAIL};

/// Bits of a digit: the most for which the remainder of [`Divisor::digit`] stays below 2^32.
const DIGIT: u32 = 12;

/// A divisor in [2^30, 2^31) with its reciprocal.
pub(super) struct Divisor {
    size: u32,
    /// 2^46 / size, at most 1e-4 of it too small, never too large.
    reciprocal: u32,
}

impl Divisor {
    pub(super) fn new(size: u32) -> Self {
        let top = (size >> 15).wrapping_add(1);
        let seed = 92_521u32.wrapping_sub(top.wrapping_mul(61_681) >> 16);
        Self {
            size,
            reciprocal: refined(refined(seed, top), top),
        }
    }

    /// The next `bits` <= 12 bits of remainder / divisor, at most 3 too small, and the new remainder.
    #[inline]
    pub(super) fn digit(&self, remainder: u32, bits: u32) -> (u32, u32) {
        let digit = (remainder >> 16).wrapping_mul(self.reciprocal) >> (30u32.wrapping_sub(bits));
        let rest = remainder
            .wrapping_shl(bits)
            .wrapping_sub(digit.wrapping_mul(self.size));
        (digit, rest)
    }

    /// 2^30 dividend / divisor, at most 3 too small, for a dividend below the divisor.
    #[inline]
    pub(super) fn ratio(&self, dividend: u32) -> u32 {
        let (first, rest) = self.digit(dividend, 10);
        let (second, rest) = self.digit(rest, 10);
        let (third, _) = self.digit(rest, 10);
        (first << 20).wrapping_add(second << 10).wrapping_add(third)
    }
}

/// A Newton step v (2 - d v); 2^31 represents d v = 1.
#[inline]
fn refined(reciprocal: u32, top: u32) -> u32 {
    let excess = top.wrapping_mul(reciprocal).wrapping_neg();
    reciprocal.wrapping_mul(excess >> 16) >> 15
}

/// The largest power of two that is not larger than |a|; at least the last place.
pub(super) fn power_below(a: i32) -> i32 {
    let top = 31u32.wrapping_sub((a.unsigned_abs() | 1).leading_zeros());
    1 << top.min(30)
}

/// a / b for a power of two b, rounded to the nearest, halves away from zero.
pub(super) fn divide_by_power(a: i32, b: i32) -> i32 {
    let places = b.trailing_zeros();
    let size = a.unsigned_abs();
    let size = if places >= PLACES {
        let down = places.wrapping_sub(PLACES);
        size.wrapping_add((1 << down) >> 1) >> down
    } else {
        let up = PLACES.wrapping_sub(places);
        if size > RAIL.unsigned_abs() >> up {
            RAIL.unsigned_abs()
        } else {
            size << up
        }
    };
    let sign = a >> 31;
    (size.cast_signed() ^ sign).wrapping_sub(sign)
}

/// a / b, rounded to the nearest, halves away from zero; the rail of the sign of a for b = 0, 0 for 0 / 0.
#[inline(never)]
pub(super) fn divide(a: i32, b: i32) -> i32 {
    let sign = (a ^ b) >> 31;
    let (dividend, divisor) = (a.unsigned_abs(), b.unsigned_abs());
    if dividend == 0 {
        return 0;
    }
    let size = if dividend >> (31 - PLACES) >= divisor {
        RAIL
    } else {
        quotient(dividend, divisor)
    };
    (size ^ sign).wrapping_sub(sign)
}

/// 2^24 dividend / divisor < 2^31, rounded.
#[inline]
fn quotient(dividend: u32, divisor: u32) -> i32 {
    let shift = divisor.leading_zeros().wrapping_sub(1);
    let divisor = Divisor::new(divisor << shift);
    let (first, remainder) = divisor.digit(dividend, DIGIT);
    let (second, mut remainder) = divisor.digit(remainder, PLACES - DIGIT);
    let mut result = (first << (PLACES - DIGIT)).wrapping_add(second);
    let mut bits = shift;
    while bits > 0 {
        let count = bits.min(DIGIT);
        let (digit, rest) = divisor.digit(remainder, count);
        result = (result << count).wrapping_add(digit);
        remainder = rest;
        bits = bits.wrapping_sub(count);
    }
    while remainder >= divisor.size {
        remainder = remainder.wrapping_sub(divisor.size);
        result = result.wrapping_add(1);
    }
    if remainder >= divisor.size.wrapping_sub(remainder) {
        result = result.wrapping_add(1);
    }
    result.min(RAIL as u32) as i32
}

#[cfg(test)]
mod tests {
    use super::super::samples::{all_pairs, edges, nearest, random, random_pairs, sampled};
    use super::*;

    fn check(a: i32, b: i32) {
        let exact = match b {
            0 => a.signum() * RAIL,
            _ => nearest(i128::from(a) << PLACES, i128::from(b)),
        };
        assert_eq!(divide(a, b), exact, "{a} / {b}");
    }

    #[test]
    fn quotients_are_rounded_to_the_nearest() {
        all_pairs(4_000_000).for_each(|(a, b)| check(a, b));
    }

    #[test]
    fn units_are_powers_of_two_and_divide_alike() {
        for a in edges().chain(random(100_000)) {
            let power = power_below(a);
            let size = a.unsigned_abs().max(1);
            assert_eq!(power.count_ones(), 1, "{a}");
            assert_eq!(size / power.unsigned_abs(), 1, "{a}");
            for places in 0..31 {
                let unit = 1 << places;
                assert_eq!(divide_by_power(a, unit), divide(a, unit), "{a} / {unit}");
            }
        }
    }

    #[test]
    fn reciprocals_are_never_too_large() {
        for top in sampled(1u32 << 15..1 << 16) {
            for size in [top << 15, (top << 15) + 0x7fff] {
                let excess = (1u64 << 46)
                    .checked_sub(u64::from(size) * u64::from(Divisor::new(size).reciprocal));
                assert!(
                    excess.is_some_and(|e| e as f64 / (1u64 << 46) as f64 <= 1.0e-4),
                    "{size}"
                );
            }
        }
    }

    #[test]
    fn ratios_are_at_most_three_too_small() {
        for (a, b) in random_pairs(1_000_000) {
            let divisor = b.unsigned_abs() << 1 >> 1 | 1 << 30;
            let dividend = a.unsigned_abs() % divisor;
            let exact = (u64::from(dividend) << 30) / u64::from(divisor);
            let error = exact - u64::from(Divisor::new(divisor).ratio(dividend));
            assert!(error <= 3, "{dividend} / {divisor}: {error}");
        }
    }
}
