//! Number types from existing crates: f32 with the functions of `libm` or of `micromath`, and `fixed` arithmetic with
//! the functions of `cordic`. They exist only to measure how much time and error the solver's own kernels save; nothing
//! else depends on them. Errors, where that of sin(x) / x is at most twice that of the sine:
//!
//! | type | sine, cosine | atan2 | square root, relative, of 1/64 and more |
//! |---|---|---|---|
//! | [`LibmSingle`] | 6e-8 | 2.5e-7 | 6e-8 |
//! | [`MicromathSingle`] | 1.1e-3 | 2.9e-3 | 6.1e-2 |
//! | [`CordicFixed`]: 24 steps, each cut off at 2^-24 | 2.5e-6 | 2e-6 | 2.5e-6 |

use super::Real;
use core::ops::{Add, Div, Mul, Neg, Sub};
use fixed::types::I8F24;
use micromath::F32;

/// Implements the operators of a newtype by functions of its inner value.
macro_rules! operators {
    ($name:ident: $add:path, $sub:path, $mul:path, $div:path, $neg:path) => {
        operators!(@ $name, Add, add, $add);
        operators!(@ $name, Sub, sub, $sub);
        operators!(@ $name, Mul, mul, $mul);
        operators!(@ $name, Div, div, $div);
        impl Neg for $name {
            type Output = Self;
            fn neg(self) -> Self {
                Self($neg(self.0))
            }
        }
    };
    (@ $name:ident, $operator:ident, $method:ident, $function:path) => {
        impl $operator for $name {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self($function(self.0, other.0))
            }
        }
    };
}

/// The constants of a newtype of f32.
macro_rules! constants {
    ($($name:ident)*) => {$(
        const $name: Self = Self(f32::$name);
    )*};
}

/// Implements [`Real`] for a newtype of f32: everything is that of f32 except what follows the name.
macro_rules! single {
    ($name:ident: $($functions:item)*) => {
        operators!($name: f32::add, f32::sub, f32::mul, f32::div, f32::neg);

        impl Real for $name {
            type Si = f32;

            constants!(ZERO HALF ONE TWO TAU EPSILON TOUCH MICRO RANGE LOAD TURN HUGE LEAST);

            fn from_int(n: i32) -> Self {
                Self(f32::from_int(n))
            }
            fn from_si(x: f32, per: f32) -> Self {
                Self(f32::from_si(x, per))
            }
            fn to_si(self, unit: f32) -> f32 {
                self.0.to_si(unit)
            }
            fn is_finite(self) -> bool {
                self.0.is_finite()
            }
            fn turns(self) -> (i32, Self) {
                let (turns, rest) = self.0.turns();
                (turns, Self(rest))
            }
            $($functions)*
        }
    };
}

/// f32 with the functions of `libm`, to measure against; only with the feature `comparison`.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct LibmSingle(f32);

single! { LibmSingle:
    fn sqrt(self) -> Self {
        Self(libm::sqrtf(self.0.max(0.0)))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = libm::sincosf(self.0);
        (Self(sin), Self(cos))
    }
    fn atan2(self, other: Self) -> Self {
        Self(libm::atan2f(self.0, other.0))
    }
}

/// f32 with the functions of `micromath`, to measure against; only with the feature `comparison`. The errors of the
/// statics are as large as those of its angles: a body that touches a surface at its start may be refused, and forces
/// do not balance.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct MicromathSingle(f32);

single! { MicromathSingle:
    fn sqrt(self) -> Self {
        Self(if self.0 > 0.0 { F32(self.0).sqrt().0 } else { 0.0 })
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = F32(self.0).sin_cos();
        (Self(sin.0), Self(cos.0))
    }
    fn sinc_cos(self) -> (Self, Self) {
        sinc_and_cosine(self)
    }
    fn atan2(self, other: Self) -> Self {
        if self.0 == 0.0 && other.0 == 0.0 {
            return Self::ZERO;
        }
        Self(F32(self.0).atan2(F32(other.0)).0)
    }
}

/// The arithmetic of `fixed`, saturating, with the functions of `cordic`, to measure against; only with the feature
/// `comparison`.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct CordicFixed(I8F24);

operators!(CordicFixed: I8F24::saturating_add, I8F24::saturating_sub, I8F24::saturating_mul, saturating_div,
    I8F24::saturating_neg);

fn saturating_div(a: I8F24, b: I8F24) -> I8F24 {
    if b != I8F24::ZERO {
        a.saturating_div(b)
    } else if a < I8F24::ZERO {
        I8F24::MIN
    } else {
        I8F24::MAX
    }
}

impl Real for CordicFixed {
    type Si = f32;

    const ZERO: Self = Self(I8F24::ZERO);
    const HALF: Self = Self(I8F24::lit("0.5"));
    const ONE: Self = Self(I8F24::ONE);
    const TWO: Self = Self(I8F24::lit("2"));
    const TAU: Self = Self(I8F24::TAU);
    const EPSILON: Self = Self(I8F24::DELTA);
    const TOUCH: Self = Self(I8F24::from_bits(1 << 5));
    const MICRO: Self = Self(I8F24::from_bits(1 << 5));
    const RANGE: Self = Self(I8F24::lit("16"));
    const LOAD: Self = Self(I8F24::lit("64"));
    const TURN: Self = Self(I8F24::lit("64"));
    const HUGE: Self = Self(I8F24::MAX);
    const LEAST: Self = Self(I8F24::from_bits(-i32::MAX));

    fn from_int(n: i32) -> Self {
        Self(I8F24::saturating_from_num(n))
    }
    fn from_si(x: f32, per: f32) -> Self {
        let x = x * per;
        Self(I8F24::saturating_from_num(if x.is_nan() { 0.0 } else { x }))
    }
    fn to_si(self, unit: f32) -> f32 {
        self.0.to_num::<f32>() * unit
    }
    fn is_finite(self) -> bool {
        self < Self::HUGE && self > Self::LEAST
    }
    fn rounding(size: Self) -> Self {
        Self::EPSILON.max(Self::EPSILON * size)
    }
    fn sqrt(self) -> Self {
        // The crate overflows from 64 on.
        if self.0 >= 64 {
            Self(cordic::sqrt(self.0.saturating_div_int(4)).saturating_mul_int(2))
        } else {
            Self(cordic::sqrt(self.0.max(I8F24::ZERO)))
        }
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = cordic::sin_cos(self.0);
        (Self(sin), Self(cos))
    }
    fn sinc_cos(self) -> (Self, Self) {
        sinc_and_cosine(self)
    }
    /// The angle of (x, y) from the arctangent of the smaller over the larger coordinate, moved to its quadrant.
    fn atan2(self, other: Self) -> Self {
        // The division of the crate does not check the range of the quotient.
        let (x, y) = (other, self);
        if Real::abs(y) > Real::abs(x) {
            let angle = cordic::atan(saturating_div(x.0, y.0));
            let quarter = if y < Self::ZERO {
                I8F24::FRAC_PI_2.saturating_neg()
            } else {
                I8F24::FRAC_PI_2
            };
            Self(quarter.saturating_sub(angle))
        } else if x == Self::ZERO {
            Self::ZERO
        } else {
            let angle = cordic::atan(saturating_div(y.0, x.0));
            Self(match (x < Self::ZERO, y < Self::ZERO) {
                (false, _) => angle,
                (true, false) => angle.saturating_add(I8F24::PI),
                (true, true) => angle.saturating_sub(I8F24::PI),
            })
        }
    }
    fn turns(self) -> (i32, Self) {
        let turns = self.0.saturating_div(I8F24::TAU).round();
        let whole = turns.saturating_mul(I8F24::TAU);
        (turns.to_num(), Self(self.0.saturating_sub(whole)))
    }
}

/// sin(x) / x and cos(x) for sines whose error is too large for a division by a small angle.
fn sinc_and_cosine<R: Real>(x: R) -> (R, R) {
    let (sin, cos) = x.sin_cos();
    if x.abs() < R::HALF {
        let y = x * x;
        let sinc = R::ONE - y / R::from_int(6) * (R::ONE - y / R::from_int(20));
        (sinc, cos)
    } else {
        (sin / x, cos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{PI, TAU};

    /// Largest errors: of sine and cosine, of atan2, of a square root relative to it.
    struct Errors {
        circle: f64,
        angle: f64,
        root: f64,
    }

    fn wide<R: Real<Si = f32>>(x: R) -> f64 {
        f64::from(x.to_si(1.0))
    }

    fn check_angles<R: Real<Si = f32>>(errors: &Errors) {
        for i in -31_400..=31_400_i16 {
            let angle = R::from_si(f32::from(i) / 5_000.0, 1.0);
            let x = wide(angle);
            let (sin, cos) = angle.sin_cos();
            assert!((wide(sin) - libm::sin(x)).abs() < errors.circle, "{x}");
            assert!((wide(cos) - libm::cos(x)).abs() < errors.circle, "{x}");
            let (sinc, _) = angle.sinc_cos();
            let exact = if x == 0.0 { 1.0 } else { libm::sin(x) / x };
            assert!((wide(sinc) - exact).abs() < 2.0 * errors.circle, "{x}");
            check_vector::<R>((x, f64::from(1 + i.rem_euclid(97)) / 9.0), errors);
            check_root::<R>((x * 20.0).abs(), errors);
            let (turns, rest) = (angle + angle).turns();
            let whole = f64::from(turns) * TAU;
            assert!((whole + wide(rest) - 2.0 * x).abs() < 1e-6, "{x}");
            assert!(wide(rest).abs() < PI + 1e-6, "{x}");
        }
    }

    /// The angle of a vector of a length.
    fn check_vector<R: Real<Si = f32>>((angle, length): (f64, f64), errors: &Errors) {
        let [y, x] = [libm::sin(angle), libm::cos(angle)]
            .map(|part| R::from_si((length * part) as f32, 1.0));
        let apart = (wide(y.atan2(x)) - libm::atan2(wide(y), wide(x))).abs();
        assert!(apart.min(TAU - apart) < errors.angle, "{angle} {length}");
        if wide(y).abs() > 0.01 * length {
            assert_eq!(y.atan2(x) < R::ZERO, y < R::ZERO, "{angle} {length}");
        }
    }

    fn check_root<R: Real<Si = f32>>(x: f64, errors: &Errors) {
        let square = R::from_si(x as f32, 1.0);
        if wide(square) >= 1.0 / 64.0 {
            let exact = libm::sqrt(wide(square));
            let error = (wide(square.sqrt()) - exact).abs();
            assert!(error <= errors.root * exact, "{x}");
        }
        assert_eq!((-square).sqrt(), R::ZERO);
    }

    fn check<R: Real<Si = f32>>(errors: &Errors) {
        check_angles::<R>(errors);
        assert_eq!(R::ZERO.sqrt(), R::ZERO);
        assert_eq!(R::ZERO.atan2(R::ZERO), R::ZERO);
        let (above, below) = (R::ONE / R::ZERO, -R::ONE / R::ZERO);
        assert!(!above.is_finite() && !below.is_finite());
        assert!(above > R::ZERO && below < R::ZERO);
        for (y, x) in [(0.0, 1.0), (1.0, 0.0), (-1.0, 0.0), (0.0, -1.0)] {
            let angle = R::from_si(y, 1.0).atan2(R::from_si(x, 1.0));
            let exact = libm::atan2(f64::from(y), f64::from(x));
            // Half a turn counts as one, in either direction.
            let apart = (wide(angle) - exact).abs();
            assert!(apart.min((apart - TAU).abs()) <= errors.angle, "{y} {x}");
        }
    }

    #[test]
    fn functions_of_other_crates_are_as_good_as_they_say() {
        check::<LibmSingle>(&Errors {
            circle: 6e-8,
            angle: 2.5e-7,
            root: 6e-8,
        });
        check::<MicromathSingle>(&Errors {
            circle: 1.1e-3,
            angle: 2.9e-3,
            root: 6.1e-2,
        });
        check::<CordicFixed>(&Errors {
            circle: 2.5e-6,
            angle: 2e-6,
            root: 2.5e-6,
        });
    }
}
