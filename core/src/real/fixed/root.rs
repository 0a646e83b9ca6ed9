//! Square roots by a 16-bit reciprocal root (Newton): 28 good bits without a division, then exact rounding by
//! the remainder of the square.

use super::product::{PLACES, RAIL, wide};

/// sqrt(x), rounded to the nearest; 0 for a negative number.
#[inline(never)]
pub(super) fn square_root(x: i32) -> i32 {
    if x <= 0 {
        return 0;
    }
    let pairs = x.leading_zeros() / 2;
    let mut root = shifted(
        approximate(x.wrapping_shl(pairs.wrapping_mul(2)) as u32),
        pairs.wrapping_add(4),
    );
    let mut remainder = (x as u32)
        .wrapping_shl(PLACES)
        .wrapping_sub(root.wrapping_mul(root));
    while remainder as i32 > root as i32 {
        remainder = remainder.wrapping_sub(root.wrapping_mul(2).wrapping_add(1));
        root = root.wrapping_add(1);
    }
    root as i32
}

/// sqrt(x² + y²), rounded to the nearest.
#[inline(never)]
pub(super) fn hypotenuse(x: i32, y: i32) -> i32 {
    nearest(wide(x, x).wrapping_add(wide(y, y)))
}

/// sqrt(a b + c d), rounded to the nearest; 0 where that is negative.
#[inline(never)]
pub(super) fn root_of_sum(a: i32, b: i32, c: i32, d: i32) -> i32 {
    nearest(wide(a, b).wrapping_add(wide(c, d)))
}

/// sqrt(square), rounded to the nearest; 0 for a negative number.
#[inline(never)]
fn nearest(square: i64) -> i32 {
    let (upper, lower) = ((square >> 32) as u32, square as u32);
    let mut root = if square <= 0 {
        return 0;
    } else if upper >> 30 != 0 {
        return RAIL;
    } else if upper != 0 {
        let pairs = upper.leading_zeros() / 2;
        let filled = lower >> 1 >> 31u32.wrapping_sub(pairs.wrapping_mul(2));
        let top = (upper << pairs.wrapping_mul(2)).wrapping_add(filled);
        shifted(approximate(top), pairs)
    } else {
        let pairs = lower.leading_zeros() / 2;
        let top = lower << pairs.wrapping_mul(2);
        shifted(approximate(top), pairs.wrapping_add(16))
    };
    let mut remainder = square.wrapping_sub(wide(root as i32, root as i32));
    while remainder > i64::from(root) {
        remainder = remainder.wrapping_sub(i64::from(root).wrapping_mul(2).wrapping_add(1));
        root = root.wrapping_add(1);
    }
    root.min(RAIL as u32) as i32
}

#[inline]
fn shifted(root: u32, bits: u32) -> u32 {
    (root >> bits.wrapping_sub(1)).wrapping_add(1) >> 1
}

/// 2^16 sqrt(square) for a square of at least 2^30, at most 80 too small, never too large.
#[inline(never)]
pub(super) fn approximate(square: u32) -> u32 {
    let top = square >> 16;
    let seed = 87_518u32.wrapping_sub(
        top.wrapping_mul(107_654u32.wrapping_sub(top.wrapping_mul(53_692) >> 16) >> 1) >> 15,
    );
    let reciprocal = refined(refined(seed, top), top);
    let first = top.wrapping_mul(reciprocal) >> 15;
    let remainder = square.wrapping_sub(first.wrapping_mul(first));
    let second = (remainder >> 4).wrapping_mul(reciprocal) >> 12;
    (first << 16).wrapping_add(second).wrapping_sub(1)
}

#[inline]
fn refined(reciprocal: u32, top: u32) -> u32 {
    let square = (reciprocal.wrapping_mul(reciprocal) >> 16).wrapping_add(1);
    let unit = square.wrapping_mul(top);
    let factor = (3u32 << 30).wrapping_sub(unit) >> 16;
    reciprocal.wrapping_mul(factor) >> 15
}

#[cfg(test)]
mod tests {
    use super::super::samples::{all_pairs, sampled};
    use super::*;

    fn nearest_root(square: u128) -> i32 {
        let floor = square.isqrt();
        let root = if square - floor * floor > floor {
            floor + 1
        } else {
            floor
        };
        root.min(RAIL as u128) as i32
    }

    fn check(a: i32, b: i32) {
        let squares = [a, b].map(|x| u128::from(x.unsigned_abs()).pow(2));
        let exact = nearest_root(squares[0] + squares[1]);
        assert_eq!(hypotenuse(a, b), exact, "{a} {b}");
        assert_eq!(root_of_sum(a, a, b, b), exact, "{a} {b}");
        let product = i128::from(a) * i128::from(b) + i128::from(b) * i128::from(a >> 3);
        let exact = u128::try_from(product).map_or(0, nearest_root);
        assert_eq!(root_of_sum(a, b, b, a >> 3), exact, "{a} {b}");
        for x in [a, b] {
            let exact = u128::try_from(i128::from(x) << PLACES).map_or(0, nearest_root);
            assert_eq!(square_root(x), exact, "{x}");
        }
    }

    #[test]
    fn roots_are_rounded_to_the_nearest() {
        all_pairs(2_000_000).for_each(|(a, b)| check(a, b));
    }

    #[test]
    fn approximate_roots_are_never_too_large() {
        for top in sampled(1u32 << 14..1 << 16) {
            for square in [top << 16, (top << 16) + 0x7777, (top << 16) + 0xffff] {
                let exact = (u64::from(square) << 32).isqrt();
                let error = exact.checked_sub(u64::from(approximate(square)));
                assert!(error.is_some_and(|e| e <= 80), "{square} {error:?}");
            }
        }
    }
}
