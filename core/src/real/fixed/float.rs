//! Conversion between f32 values in a unit and Q24 numbers, by integer operations on the bits of the floats: rounded
//! once; the float library is called only for numbers that are not normal.

use super::product::{PLACES, RAIL, wide};

/// A normal float: `mantissa` / 2^30, in [1, 2), times 2^(`exponent` - 127).
struct Normalized {
    mantissa: i32,
    exponent: i32,
}

impl Normalized {
    /// `None` for zero, a subnormal number, infinity and NaN.
    #[inline]
    fn new(x: f32) -> Option<Self> {
        let bits = x.to_bits();
        let exponent = (bits >> 23 & 0xff) as i32;
        let mantissa = (bits << 7 & 0x3fff_ff80 | 0x4000_0000) as i32;
        matches!(exponent, 1..=254).then_some(Self { mantissa, exponent })
    }
}

/// The product of two mantissas in [2^30, 2^31), in [2^60, 2^61): halved if it is larger; and whether it was.
#[inline]
fn product(a: i32, b: i32) -> (i64, i32) {
    let product = wide(a, b);
    if product >> 61 == 0 {
        (product, 0)
    } else {
        (product >> 1, 1)
    }
}

/// x·per as the nearest Q24 number, halves away from zero: the rail for anything beyond it and for NaN, 0 if a factor
/// is subnormal.
#[inline(never)]
pub(super) fn from_single(x: f32, per: f32) -> i32 {
    let size = match (Normalized::new(x), Normalized::new(per)) {
        (Some(a), Some(b)) => {
            let (product, halved) = product(a.mantissa, b.mantissa);
            let top = (product >> 29) as u32;
            let exponent = a.exponent.wrapping_add(b.exponent).wrapping_add(halved);
            match 260i32.wrapping_sub(exponent) {
                ..0 => RAIL,
                shift @ 0..=31 => (top >> shift).div_ceil(2).min(RAIL as u32) as i32,
                32.. => 0,
            }
        }
        _ if x.to_bits() << 1 == 0 => 0,
        _ if x.is_finite() && per.is_finite() => 0,
        _ => RAIL,
    };
    let sign = (x.to_bits() ^ per.to_bits()) as i32 >> 31;
    (size ^ sign).wrapping_sub(sign)
}

/// x·unit as the nearest float, halves away from zero.
#[inline(never)]
pub(super) fn to_single(x: i32, unit: f32) -> f32 {
    const STEP: f32 = 1.0 / (1 << PLACES) as f32;
    if x == 0 {
        return 0.0;
    }
    // where the result can neither overflow nor be subnormal
    let Some(normal) = Normalized::new(unit).filter(|unit| matches!(unit.exponent, 26..=240))
    else {
        return x as f32 * STEP * unit;
    };
    let shift = x.unsigned_abs().leading_zeros();
    let size = (x.unsigned_abs() << shift >> 1) as i32;
    let (product, halved) = product(size, normal.mantissa);
    let mantissa = ((product >> 36) as u32).div_ceil(2);
    let exponent = normal
        .exponent
        .wrapping_add(halved)
        .wrapping_add(6)
        .wrapping_sub(shift as i32);
    let size = f32::from_bits(((exponent as u32) << 23).wrapping_add(mantissa));
    let sign = x as u32 ^ unit.to_bits();
    size.copysign(f32::from_bits(sign))
}

#[cfg(test)]
mod tests {
    use super::super::samples::{edges, random_pairs, sampled};
    use super::*;

    fn floats() -> impl Iterator<Item = f32> + Clone {
        let sizes = (0..=254).flat_map(|exponent: u32| {
            [0, 1, 0x2a_aaaa, 0x40_0000, 0x7f_ffff].map(|m| f32::from_bits(exponent << 23 | m))
        });
        sizes.chain([f32::INFINITY]).flat_map(|x| [x, -x])
    }

    fn check_from(x: f32, per: f32) {
        if (x * per).is_nan() && x != 0.0 {
            assert_eq!(from_single(x, per).abs(), RAIL, "{x} {per}");
            return;
        }
        let exact = f64::from(x) * f64::from(per) * f64::from(1 << PLACES);
        let rounded = match (x.is_subnormal(), per.is_subnormal()) {
            (false, false) => libm::round(exact) as i64,
            _ if x.is_infinite() || per.is_infinite() => exact as i64,
            _ => 0,
        };
        let exact = rounded.clamp(-i64::from(RAIL), i64::from(RAIL));
        assert_eq!(i64::from(from_single(x, per)), exact, "{x} {per}");
    }

    fn check_to(x: i32, unit: f32) {
        let exact = f64::from(x) / f64::from(1 << PLACES) * f64::from(unit);
        let nearest = to_single(x, unit);
        let step = f64::from(nearest.abs().next_up()) - f64::from(nearest.abs());
        let error = (f64::from(nearest) - exact).abs();
        assert!(error <= 0.500_001 * step, "{x} {unit}");
    }

    #[test]
    fn floats_are_taken_to_the_nearest_number() {
        for x in sampled(floats()) {
            sampled(floats()).for_each(|per| check_from(x, per));
            check_from(x, f32::NAN);
        }
        for (x, per) in random_pairs(2_000_000) {
            check_from(f32::from_bits(x as u32), f32::from_bits(per as u32));
            check_from(x as f32 / 16_777_216.0, 1.0 + per as f32 / 4_294_967_296.0);
        }
    }

    #[test]
    fn numbers_are_given_as_the_nearest_float() {
        for x in edges() {
            for unit in [1.0, 0.1, 0.333_333_34, 1e-9, 1e9, 1e-30, 1e30, -3.0, 0.0] {
                check_to(x, unit);
            }
            if x.abs() <= 1 << 24 {
                assert_eq!(from_single(to_single(x, 1.0), 1.0), x);
            }
        }
        // Beyond the normal numbers of f32 as near as those are.
        for x in edges() {
            for unit in [1e-37_f32, 1e-40, 1e38, f32::INFINITY] {
                let exact = f64::from(x) / f64::from(1 << PLACES) * f64::from(unit);
                let nearest = f64::from(to_single(x, unit));
                let off = (nearest - exact).abs();
                let close = off <= 1e-7 * exact.abs() + 2e-45 || nearest == f64::from(exact as f32);
                assert!(close || x == 0 && nearest == 0.0, "{x} {unit}");
            }
        }
        for (x, unit) in random_pairs(2_000_000) {
            check_to(x, (unit as f32).abs() / 1000.0 + 1e-12);
        }
    }
}
