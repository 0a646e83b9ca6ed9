//! What every number type must do, down to the sign of a zero: the same bits on every machine.

use super::*;

/// For a type with two zeros, which `is_negative` distinguishes.
fn check_zeros<R: Real>(is_negative: impl Fn(R) -> bool) {
    let (plus, minus) = (R::ZERO, -R::ZERO);
    assert!(!is_negative(plus) && is_negative(minus));
    for (zero, other) in [(plus, minus), (minus, plus)] {
        let sign = is_negative(zero);
        let same = [zero.min(other), zero.max(other)];
        assert!(same.into_iter().all(|x| is_negative(x) == sign));
        assert!(!is_negative(zero.abs()));
        assert!(!is_negative(zero.sqrt()));
        assert!(!is_negative(zero.hypot(other)));
        assert_eq!(zero.sign(), R::ONE);
    }
}

#[test]
fn zeros_keep_their_signs_and_roots_have_none() {
    check_zeros(f32::is_sign_negative);
    check_zeros(f64::is_sign_negative);
}

/// A number plus its rounding is another number, which is near. In fixed point, whose numbers are equally spaced, at 0 too.
fn check_rounding<R: Real>(from: i32) {
    for n in from..=8 {
        let size = R::from_int(n);
        let rounding = R::rounding(size);
        assert!(size + rounding > size, "{size:?}");
        assert!(rounding <= R::EPSILON * size.max(R::ONE), "{size:?}");
    }
}

#[test]
fn rounding_is_seen_and_small() {
    check_rounding::<f32>(1);
    check_rounding::<f64>(1);
    check_rounding::<Fixed>(0);
    #[cfg(feature = "comparison")]
    check_rounding::<CordicFixed>(0);
}

/// The ends of a saturating type stand for everything beyond them.
#[cfg(feature = "comparison")]
#[test]
fn ends_of_fixed_point_are_not_finite() {
    fn check<R: Real<Si = f32>>() {
        assert!(!R::HUGE.is_finite() && !R::LEAST.is_finite());
        for end in [R::HUGE, R::LEAST] {
            let within = end - end.sign() * R::EPSILON;
            assert!(within.is_finite(), "{within:?}");
        }
        assert_eq!(R::LEAST, -R::HUGE);
        assert_eq!(R::from_si(f32::INFINITY, 1.0), R::HUGE);
    }
    check::<Fixed>();
    check::<CordicFixed>();
    assert_eq!(CordicFixed::from_si(f32::NAN, 1.0), CordicFixed::ZERO);
}
