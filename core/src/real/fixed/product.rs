//! Products of Q24 numbers: exact in 64 bits, then rounded once to the nearest, halves away from zero, so that
//! mirrored factors give mirrored bits. Arguments and results lie in -[`RAIL`]..=[`RAIL`].

/// The largest number; its negative is the lower rail.
pub(super) const RAIL: i32 = i32::MAX;

/// Binary places of the number type.
pub(super) const PLACES: u32 = 24;

/// a b, rounded.
#[inline(never)]
pub(super) fn multiply(a: i32, b: i32) -> i32 {
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    return halves::multiply(a, b);
    #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
    return rounded(wide(a, b));
}

/// a b + c d, rounded once.
#[inline(never)]
pub(super) fn sum(a: i32, b: i32, c: i32, d: i32) -> i32 {
    rounded(wide(a, b).wrapping_add(wide(c, d)))
}

/// a b - c d, rounded once.
#[inline(never)]
pub(super) fn difference(a: i32, b: i32, c: i32, d: i32) -> i32 {
    rounded(wide(a, b).wrapping_sub(wide(c, d)))
}

/// The exact product.
// ARMv6-M multiplies to 32 bits only. It is the Arm core without exclusive access, and this stable condition
// distinguishes it from the larger ones.
#[inline]
pub(super) fn wide(a: i32, b: i32) -> i64 {
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    return halves::wide(a, b);
    #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
    return i64::from(a).wrapping_mul(i64::from(b));
}

/// A product of Q24 numbers as a Q24 number, saturated at the rail if it does not fit.
#[inline]
fn rounded(product: i64) -> i32 {
    const HALF: i64 = 1 << (PLACES - 1);
    // one less below zero: halves away from zero
    let product = product.wrapping_add(HALF).wrapping_add(product >> 63);
    let upper = (product >> 32) as i32;
    if upper.wrapping_add(1 << 23) as u32 >> 24 == 0 {
        ((product >> PLACES) as i32).max(-RAIL)
    } else {
        let sign = upper >> 31;
        (RAIL ^ sign).wrapping_sub(sign)
    }
}

/// The upper half of a product, to two units of its last place: a b / 2^32 without the product of the lower halves.
#[inline]
pub(super) fn high(a: i32, b: i32) -> i32 {
    let (a_low, b_low) = (a & 0xffff, b & 0xffff);
    let (a_high, b_high) = (a >> 16, b >> 16);
    a_high
        .wrapping_mul(b_high)
        .wrapping_add(a_high.wrapping_mul(b_low) >> 16)
        .wrapping_add(a_low.wrapping_mul(b_high) >> 16)
}

/// x² / 2^31 to two units of the last place.
#[inline]
pub(super) fn square(x: i32) -> i32 {
    let (upper, lower) = (x >> 16, x & 0xffff);
    upper
        .wrapping_mul(upper)
        .wrapping_mul(2)
        .wrapping_add(upper.wrapping_mul(lower) >> 14)
}

/// The products of this file by four multiplies of 16-bit halves, bit for bit.
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
mod halves {
    use super::{PLACES, RAIL};

    /// The product of two Q24 numbers, rounded to the nearest with halves away from zero, saturated at the rails.
    #[inline]
    pub(super) fn multiply(a: i32, b: i32) -> i32 {
        let (x, y) = (a.unsigned_abs(), b.unsigned_abs());
        let (x_low, y_low) = (x & 0xffff, y & 0xffff);
        let (x_high, y_high) = (x >> 16, y >> 16);
        let upper = x_high.wrapping_mul(y_high);
        let middle = x_high
            .wrapping_mul(y_low)
            .wrapping_add(x_low.wrapping_mul(y_high))
            .wrapping_add(x_low.wrapping_mul(y_low) >> 16);
        let size = if upper >> (PLACES - 1) == 0 {
            let size = (upper << 8).wrapping_add(middle.wrapping_add(0x80) >> 8);
            size.min(RAIL as u32) as i32
        } else {
            RAIL
        };
        let sign = (a ^ b) >> 31;
        (size ^ sign).wrapping_sub(sign)
    }

    #[inline]
    pub(super) fn wide(a: i32, b: i32) -> i64 {
        let (a_low, b_low) = (a & 0xffff, b & 0xffff);
        let (a_high, b_high) = (a >> 16, b >> 16);
        let lower = a_low.wrapping_mul(b_low) as u32;
        let upper = a_high.wrapping_mul(b_high);
        let middle = [a_high.wrapping_mul(b_low), a_low.wrapping_mul(b_high)];
        (i64::from(upper) << 32)
            .wrapping_add(i64::from(lower))
            .wrapping_add(i64::from(middle[0]) << 16)
            .wrapping_add(i64::from(middle[1]) << 16)
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{all_pairs, nearest, pairs, random};
    use super::*;

    fn check(a: i32, b: i32) {
        let exact = i128::from(a) * i128::from(b);
        assert_eq!(multiply(a, b), nearest(exact, 1 << 24), "{a} {b}");
        assert_eq!(halves::multiply(a, b), multiply(a, b), "{a} {b}");
        assert_eq!(i128::from(halves::wide(a, b)), exact, "{a} {b}");
        assert_eq!(i128::from(wide(a, b)), exact, "{a} {b}");
        assert_eq!(multiply(-a, b), -multiply(a, b), "{a} {b}");
        let error = exact - (i128::from(high(a, b)) << 32);
        assert!((0..3 << 32).contains(&error), "{a} {b}");
        if a.unsigned_abs() <= 1 << 30 {
            let error = i128::from(a) * i128::from(a) - (i128::from(square(a)) << 31);
            assert!((0..5 << 31).contains(&error), "{a} {error}");
        }
    }

    fn check_sums(a: i32, b: i32, c: i32, d: i32) {
        let (ab, cd) = (i128::from(a) * i128::from(b), i128::from(c) * i128::from(d));
        assert_eq!(
            sum(a, b, c, d),
            nearest(ab + cd, 1 << 24),
            "{a} {b} {c} {d}"
        );
        assert_eq!(
            difference(a, b, c, d),
            nearest(ab - cd, 1 << 24),
            "{a} {b} {c} {d}"
        );
    }

    #[test]
    fn products_are_rounded_to_the_nearest_on_both_kinds_of_machine() {
        all_pairs(2_000_000).for_each(|(a, b)| check(a, b));
    }

    #[test]
    fn sums_of_products_are_rounded_once() {
        for (a, b) in pairs() {
            for (c, d) in [
                (a, b),
                (b, a),
                (1 << 23, 1),
                (RAIL, RAIL),
                (RAIL, -RAIL),
                (3, 1 << 22),
            ] {
                check_sums(a, b, c, d);
            }
        }
        let mut numbers = random(4_000_000);
        while let (Some(a), Some(b), Some(c), Some(d)) = (
            numbers.next(),
            numbers.next(),
            numbers.next(),
            numbers.next(),
        ) {
            check_sums(a, b, c, d);
        }
    }
}
