//! A quantity on a motion: its value alone, with its slope, or also with bounds of its magnitude, slope and curvature, so that products of
//! such quantities have the bound that the certified search needs. The values are the same bits.

use crate::geometry::Vec2;
use crate::real::{Real, along};
use crate::search::Slope;
use core::ops::{Add, Mul, Neg, Sub};

/// Value and slope at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sloped<R> {
    pub(crate) value: R,
    pub(crate) slope: R,
}

/// Value and slope at a point, with bounds that hold on the whole motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounded<R> {
    pub(crate) value: R,
    pub(crate) slope: R,
    pub(crate) bounds: Bounds<R>,
}

/// The rounding error of the value, here and approximately elsewhere, and suprema of |f|, |f'|, |f''|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds<R> {
    pub(crate) error: R,
    pub(crate) suprema: [R; 3],
}

/// A quantity whose bounds are known or not.
pub(crate) trait Quantity<R: Real>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// A value, and what else is known about it.
    fn known(value: R, slope: impl FnOnce() -> R, bounds: impl FnOnce() -> Bounds<R>) -> Self;
    fn value(&self) -> R;
    /// This quantity multiplied by `k`.
    fn times(self, k: R) -> Self;
    /// This quantity with suprema that cover only a window from here.
    fn within(self, window: R) -> Self;
    /// A quantity with this value everywhere.
    fn constant(value: R) -> Self {
        let bounds = || Bounds {
            error: R::rounding(value.abs()),
            suprema: [value.abs(), R::ZERO, R::ZERO],
        };
        Self::known(value, || R::ZERO, bounds)
    }
}

/// The value alone.
impl<R: Real> Quantity<R> for R {
    fn known(value: R, _: impl FnOnce() -> R, _: impl FnOnce() -> Bounds<R>) -> Self {
        value
    }
    fn value(&self) -> R {
        *self
    }
    fn times(self, k: R) -> Self {
        self * k
    }
    fn within(self, _: R) -> Self {
        self
    }
}

impl<R: Real> Quantity<R> for Sloped<R> {
    fn known(value: R, slope: impl FnOnce() -> R, _: impl FnOnce() -> Bounds<R>) -> Self {
        Self {
            value,
            slope: slope(),
        }
    }
    fn value(&self) -> R {
        self.value
    }
    fn times(self, k: R) -> Self {
        Self {
            value: self.value * k,
            slope: self.slope * k,
        }
    }
    fn within(self, _: R) -> Self {
        self
    }
}

impl<R: Real> Quantity<R> for Bounded<R> {
    fn known(value: R, slope: impl FnOnce() -> R, bounds: impl FnOnce() -> Bounds<R>) -> Self {
        Self {
            value,
            slope: slope(),
            bounds: bounds(),
        }
    }
    fn value(&self) -> R {
        self.value
    }
    fn times(self, k: R) -> Self {
        let size = k.abs();
        Self {
            value: self.value * k,
            slope: self.slope * k,
            bounds: Bounds {
                error: self.bounds.error * size,
                suprema: self.bounds.suprema.map(|bound| bound * size),
            },
        }
    }
    /// Over a window from here a value and a slope change by no more than the window times the bound of their derivative.
    fn within(self, window: R) -> Self {
        let Bounds {
            error,
            suprema: [most, fastest, bent],
        } = self.bounds;
        let fastest = fastest.min(self.slope.abs() + window * bent);
        let most = most.min(self.value.abs() + window * fastest);
        let suprema = [most, fastest, bent];
        Self {
            bounds: Bounds { error, suprema },
            ..self
        }
    }
}

impl<R: Real> Sloped<R> {
    /// As a function whose first zero is searched for, with its bounds on the whole motion.
    pub(crate) fn as_slope(self, sign: R, bounds: &Bounds<R>) -> Slope<R> {
        let [.., curvature] = bounds.suprema;
        Slope {
            value: along(sign, self.value),
            slope: along(sign, self.slope),
            curvature,
            rounding: bounds.error,
        }
    }
}

impl<R: Real> Add for Sloped<R> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self {
            value: self.value + b.value,
            slope: self.slope + b.slope,
        }
    }
}

impl<R: Real> Neg for Sloped<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            slope: -self.slope,
        }
    }
}

impl<R: Real> Sub for Sloped<R> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + (-b)
    }
}

impl<R: Real> Mul for Sloped<R> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self {
            value: self.value * b.value,
            slope: self.slope * b.value + self.value * b.slope,
        }
    }
}

impl<R: Real> Bounded<R> {
    fn sloped(self) -> Sloped<R> {
        Sloped {
            value: self.value,
            slope: self.slope,
        }
    }

    fn of(Sloped { value, slope }: Sloped<R>, bounds: Bounds<R>) -> Self {
        Self {
            value,
            slope,
            bounds,
        }
    }
}

impl<R: Real> Add for Bounded<R> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        let ([f0, f1, f2], [g0, g1, g2]) = (self.bounds.suprema, b.bounds.suprema);
        let bounds = Bounds {
            error: self.bounds.error + b.bounds.error,
            suprema: [f0 + g0, f1 + g1, f2 + g2],
        };
        Self::of(self.sloped() + b.sloped(), bounds)
    }
}

impl<R: Real> Neg for Bounded<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::of(-self.sloped(), self.bounds)
    }
}

impl<R: Real> Sub for Bounded<R> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + (-b)
    }
}

impl<R: Real> Mul for Bounded<R> {
    type Output = Self;
    /// The product rule, for values, slopes and suprema: |(f g)''| <= |f''| |g| + 2 |f'| |g'| + |f| |g''|.
    fn mul(self, b: Self) -> Self {
        let ([f0, f1, f2], [g0, g1, g2]) = (self.bounds.suprema, b.bounds.suprema);
        let product = self.sloped() * b.sloped();
        let bounds = Bounds {
            error: self.value.abs() * b.bounds.error
                + b.value.abs() * self.bounds.error
                + R::rounding(product.value.abs()),
            suprema: [
                f0 * g0,
                f1 * g0 + f0 * g1,
                f2 * g0 + (f1 * g1).doubled() + f0 * g2,
            ],
        };
        Self::of(product, bounds)
    }
}

/// A vector of such quantities.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QuantityVec<Q> {
    pub(crate) x: Q,
    pub(crate) y: Q,
}

impl<Q> QuantityVec<Q> {
    pub(crate) fn constant<R: Real>(v: Vec2<R>) -> Self
    where
        Q: Quantity<R>,
    {
        Self {
            x: Q::constant(v.x),
            y: Q::constant(v.y),
        }
    }
    /// This quantity with suprema that cover only a window from here.
    pub(crate) fn within<R: Real>(self, window: R) -> Self
    where
        Q: Quantity<R>,
    {
        Self {
            x: self.x.within(window),
            y: self.y.within(window),
        }
    }
}

impl<Q: Copy + Sub<Output = Q> + Mul<Output = Q>> QuantityVec<Q> {
    pub(crate) fn cross(self, b: Self) -> Q {
        self.x * b.y - self.y * b.x
    }
    pub(crate) fn scaled(self, k: Q) -> Self {
        Self {
            x: self.x * k,
            y: self.y * k,
        }
    }
}

impl<Q: Add<Output = Q>> Add for QuantityVec<Q> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self {
            x: self.x + b.x,
            y: self.y + b.y,
        }
    }
}

impl<Q: Sub<Output = Q>> Sub for QuantityVec<Q> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self {
            x: self.x - b.x,
            y: self.y - b.y,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// c exp(a x) for x <= 0: it and its derivatives are largest at 0.
    fn exponential(c: f64, a: f64, x: f64) -> Bounded<f64> {
        let value = c * libm::exp(a * x);
        let size = c.abs();
        Bounded {
            value,
            slope: a * value,
            bounds: Bounds {
                error: f64::EPSILON * size,
                suprema: [size, size * a, size * a * a],
            },
        }
    }

    #[track_caller]
    fn same(is: Bounded<f64>, should: Bounded<f64>) {
        let numbers = |bounded: Bounded<f64>| {
            [bounded.value, bounded.slope]
                .into_iter()
                .chain(bounded.bounds.suprema)
        };
        for (is, should) in numbers(is).zip(numbers(should)) {
            assert!((is - should).abs() < 1e-12, "{is} {should}");
        }
    }

    /// Sums and products of growing exponentials reach their bounds, all at the same point: there the rules are equations.
    #[test]
    fn bounds_are_reached_where_all_is_largest_at_one_place() {
        for (c, d) in [(2.0, 3.0), (0.7, 5.0)] {
            for x in [0.0, -0.3, -2.0] {
                let (a, b) = (1.5, 0.25);
                let (f, g) = (exponential(c, a, x), exponential(d, b, x));
                same(f * g, exponential(c * d, a + b, x));
                let [sum, difference] = [f + g, f - g];
                let suprema = [c + d, c * a + d * b, c * a * a + d * b * b];
                let bounds = Bounds {
                    error: 0.0,
                    suprema,
                };
                let (slope, other) = (f.slope + g.slope, f.slope - g.slope);
                let value = f.value + g.value;
                same(
                    sum,
                    Bounded {
                        value,
                        slope,
                        bounds,
                    },
                );
                let (value, slope) = (f.value - g.value, other);
                same(
                    difference,
                    Bounded {
                        value,
                        slope,
                        bounds,
                    },
                );
                same(f * Bounded::constant(-2.0), exponential(-2.0 * c, a, x));
            }
        }
    }

    /// u×v = u_x v_y - u_y v_x, and k times as much for k u; sums and differences are taken by component.
    #[test]
    fn vectors_go_by_part() {
        let x = -0.4;
        let vector = |a: f64| QuantityVec {
            x: exponential(2.0, a, x),
            y: exponential(3.0, 2.0 * a, x),
        };
        let (u, v, k) = (vector(0.5), vector(0.75), exponential(1.5, 0.3, x));
        same(u.cross(v), u.x * v.y - u.y * v.x);
        same(u.scaled(k).cross(v), u.x * k * v.y - u.y * k * v.x);
        same((u + v).x, u.x + v.x);
        same((u + v).y, u.y + v.y);
        same((u - v).x, u.x - v.x);
        same((u - v).y, u.y - v.y);
        let still = QuantityVec::constant(Vec2::new(2.0, -3.0));
        same(still.y, Bounded::constant(-3.0));
        assert_eq!(
            (still.x.value, still.x.bounds.suprema),
            (2.0, [2.0, 0.0, 0.0])
        );
    }

    #[test]
    fn zero_is_searched_for_in_the_direction_of_a_sign() {
        let bounded = exponential(-2.0, 0.5, -1.0);
        let slope = bounded.sloped().as_slope(-1.0, &bounded.bounds);
        assert_eq!((slope.value, slope.slope), (-bounded.value, -bounded.slope));
        assert_eq!(slope.curvature, 0.5);
        assert_eq!(slope.rounding, bounded.bounds.error);
    }
}
