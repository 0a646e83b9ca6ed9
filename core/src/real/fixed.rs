//! Fixed point with 8 bits before and 24 bits after the point: the solver on chips without a floating-point unit. Everything saturates,
//! nothing wraps or panics; the kernels multiply 16-bit halves if the chip has no long multiply and give the same bits everywhere. Errors
//! in units of the last place, 2^-24 = 6e-8:
//!
//! | function | error |
//! |---|---|
//! | +, -, ×, a b ± c d, /, in other units, square root, hypotenuse, from and to f32 | rounded to the nearest |
//! | sine, cosine, arctangent, turns | 0.75 |
//! | sin(x) / x | 1.2 |

use super::Real;
use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};
use product::RAIL;

mod angle;
mod circle;
mod float;
mod product;
mod quotient;
mod root;
#[cfg(test)]
pub(super) mod samples;

/// A fixed-point number in [-128, 128] in steps of 2^-24; the ends of the range stand for everything beyond. The number type for chips
/// without a floating-point unit: the same solver, with scenes, hands and answers in `f32`.
///
/// | function | error, in units of the last place, 2^-24 = 6e-8 |
/// |---|---|
/// | sums, products, quotients, square root, hypotenuse, from and to `f32` | rounded to the nearest |
/// | sine, cosine, arctangent, turns | 0.75 |
/// | sin(x) / x | 1.2 |
///
/// It represents coordinates up to 16 body sizes and moments up to 64 k_h L² (STATICS 16):
///
/// ```
/// use stiction_core::{Description, Evolution, Fixed, Hand, Scene, Solver, Status};
/// use stiction_core::SurfaceDescription;
///
/// let scene: Scene<Fixed, 4, 1> = Scene::new(&Description {
///     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
///     start: [0.0, 0.03, 0.0],
///     weight: 0.0,
///     holding_point: Some([0.0, 0.02]),
///     reach: 0.0,
///     stiffness_translation: 500.0,
///     stiffness_rotation: 0.5,
///     surfaces: &[SurfaceDescription {
///         normal: [0.0, 1.0],
///         offset: 0.0,
///         friction_static: 0.5,
///         friction_dynamic: 0.3,
///         memory: None,
///     }],
///     obstacles: &[],
/// })?;
/// let solver = Solver::new(scene, Evolution::Frame);
/// let (mut state, _) = solver.start(Hand::new(0.0, 0.04, 0.0));
/// let [_, push] = solver.wrench(&state).force;
/// assert!((push + 5.0).abs() < 1e-3, "10 mm deep at 500 N/m");
///
/// // 5 m are 43 sizes of this body: the hand is out of range, and the body stays where it is.
/// let output = solver.step(&mut state, Hand::new(5.0, 0.04, 0.0));
/// assert_eq!((output.status, output.position[0]), (Status::Saturated, 0.0));
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
// The most negative number of the format never occurs: the rails are symmetric, so that -x and |x| are exact.
#[derive(Clone, Copy, Default, PartialEq, PartialOrd)]
pub struct Fixed(i32);

impl Fixed {
    const fn new(bits: i32) -> Self {
        Self(bits)
    }
    const fn bits(self) -> i32 {
        self.0
    }
}

/// The number itself, not its bits.
impl fmt::Debug for Fixed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = f64::from(self.0) / f64::from(1 << product::PLACES);
        f.debug_tuple("Fixed").field(&number).finish()
    }
}

impl Add for Fixed {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.bits().saturating_add(other.bits()).max(-RAIL))
    }
}

impl Sub for Fixed {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.bits().saturating_sub(other.bits()).max(-RAIL))
    }
}

impl Mul for Fixed {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self::new(product::multiply(self.bits(), other.bits()))
    }
}

impl Div for Fixed {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        Self::new(quotient::divide(self.bits(), other.bits()))
    }
}

impl Neg for Fixed {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(self.bits().wrapping_neg())
    }
}

impl Real for Fixed {
    type Si = f32;

    const ZERO: Self = Self::new(0);
    const HALF: Self = Self::new(1 << 23);
    const ONE: Self = Self::new(1 << 24);
    const TWO: Self = Self::new(1 << 25);
    const TAU: Self = Self::new(105_414_357);
    const EPSILON: Self = Self::new(1);
    const TOUCH: Self = Self::new(1 << 5);
    const MICRO: Self = Self::new(1 << 5);
    const RANGE: Self = Self::new(1 << 28);
    const LOAD: Self = Self::new(1 << 30);
    const TURN: Self = Self::new(1 << 30);
    const HUGE: Self = Self::new(RAIL);
    const LEAST: Self = Self::new(-RAIL);

    fn from_int(n: i32) -> Self {
        match n {
            ..=-128 => Self::new(-RAIL),
            -127..=127 => Self::new(n << product::PLACES),
            128.. => Self::new(RAIL),
        }
    }
    fn from_si(x: f32, per: f32) -> Self {
        Self::new(float::from_single(x, per))
    }
    fn to_si(self, unit: f32) -> f32 {
        float::to_single(self.bits(), unit)
    }
    fn is_finite(self) -> bool {
        self.bits().wrapping_abs() != RAIL
    }
    fn sqrt(self) -> Self {
        Self::new(root::square_root(self.bits()))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = circle::sine_and_cosine(self.bits());
        (Self::new(sin), Self::new(cos))
    }
    fn sinc_cos(self) -> (Self, Self) {
        let (sinc, cos) = circle::sinc_and_cosine(self.bits());
        (Self::new(sinc), Self::new(cos))
    }
    fn atan2(self, other: Self) -> Self {
        Self::new(angle::arctangent(self.bits(), other.bits()))
    }
    fn turns(self) -> (i32, Self) {
        let (turns, rest) = angle::turns(self.bits());
        (turns, Self::new(rest))
    }
    fn hypot(self, other: Self) -> Self {
        Self::new(root::hypotenuse(self.bits(), other.bits()))
    }
    fn root_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        Self::new(root::root_of_sum(a.bits(), b.bits(), c.bits(), d.bits()))
    }
    fn halved(self) -> Self {
        Self::new(self.bits() / 2)
    }
    fn unit(self) -> Self {
        Self::new(quotient::power_below(self.bits()))
    }
    fn in_units(self, unit: Self) -> Self {
        Self::new(quotient::divide_by_power(self.bits(), unit.bits()))
    }
    fn rounding(size: Self) -> Self {
        Self::EPSILON.max(Self::new(size.bits() >> product::PLACES))
    }
    fn sum_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        Self::new(product::sum(a.bits(), b.bits(), c.bits(), d.bits()))
    }
    fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        Self::new(product::difference(a.bits(), b.bits(), c.bits(), d.bits()))
    }
}

#[cfg(test)]
mod tests {
    use super::samples::{edges, pairs};
    use super::*;

    fn saturated(exact: i64) -> i32 {
        exact.clamp(-i64::from(RAIL), i64::from(RAIL)) as i32
    }

    #[test]
    fn sums_saturate_and_nothing_leaves_the_rails() {
        for (a, b) in pairs() {
            let (x, y) = (Fixed::new(a), Fixed::new(b));
            assert_eq!((x + y).bits(), saturated(i64::from(a) + i64::from(b)));
            assert_eq!((x - y).bits(), saturated(i64::from(a) - i64::from(b)));
            let (turns, rest) = x.turns();
            let results = [
                [x + y, x - y, x * y, x / y, x.hypot(y), x.atan2(y)],
                [
                    x.sqrt(),
                    x.sin_cos().0,
                    x.sin_cos().1,
                    x.sinc_cos().0,
                    rest,
                    Fixed::from_int(turns),
                ],
                [
                    Fixed::sum_of_products(x, y, x, y),
                    Fixed::sum_of_products(x, x, y, y),
                    Fixed::difference_of_products(x, y, y, x),
                    Fixed::difference_of_products(x, -x, y, y),
                    Fixed::from_int(a),
                    Fixed::from_si(a as f32, b as f32),
                ],
            ];
            for result in results.iter().flatten() {
                assert_ne!(result.bits(), i32::MIN, "{a} {b}");
                assert!(*result >= Fixed::LEAST && *result <= Fixed::HUGE);
            }
        }
    }

    #[test]
    fn negation_and_size_are_exact() {
        for x in edges().map(Fixed::new) {
            assert_eq!(-(-x), x);
            assert_eq!(x.abs(), (-x).abs());
            assert_eq!((-x).bits(), -x.bits());
            assert_eq!(x.is_finite(), (-x).is_finite());
        }
    }

    #[test]
    fn only_the_rails_are_not_finite() {
        for x in edges().map(Fixed::new) {
            assert_eq!(x.is_finite(), x != Fixed::HUGE && x != Fixed::LEAST);
        }
        assert!(!(Fixed::HUGE + Fixed::ONE).is_finite());
        assert!(!(Fixed::ONE / Fixed::ZERO).is_finite());
        assert!(!Fixed::from_si(f32::NEG_INFINITY, 1.0).is_finite());
        assert!(!Fixed::from_si(f32::NAN, 1.0).is_finite());
        assert_eq!(-Fixed::ONE / Fixed::ZERO, Fixed::LEAST);
        assert_eq!(Fixed::ZERO / Fixed::ZERO, Fixed::ZERO);
    }

    #[test]
    fn constants_are_what_they_say() {
        assert_eq!(Fixed::from_int(1), Fixed::ONE);
        assert_eq!(Fixed::from_int(2), Fixed::TWO);
        assert_eq!(Fixed::HALF + Fixed::HALF, Fixed::ONE);
        assert_eq!(Fixed::from_int(16), Fixed::RANGE);
        assert_eq!(Fixed::from_int(128), Fixed::HUGE);
        assert_eq!(Fixed::from_int(i32::MIN), Fixed::LEAST);
        let turn = core::f64::consts::TAU * 16_777_216.0;
        assert_eq!(Fixed::TAU.bits(), libm::round(turn) as i32);
    }
}
