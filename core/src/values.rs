//! Value and slope of event functions, and the vectors that they are made of.

use crate::geometry::Vec2;
use crate::real::Real;
use core::ops::{Add, Mul, Neg};

/// Value and slope of an event function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Value<R> {
    pub(crate) v: R,
    pub(crate) d: R,
}
impl<R: Real> Value<R> {
    /// Of a function that does not exist: far from zero.
    pub(crate) const NONE: Self = Self {
        v: R::HUGE,
        d: R::ZERO,
    };
    pub(crate) fn times(self, k: R) -> Self {
        Self {
            v: self.v * k,
            d: self.d * k,
        }
    }
}
impl<R: Real> Add for Value<R> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self {
            v: self.v + b.v,
            d: self.d + b.d,
        }
    }
}
impl<R: Real> Mul for Value<R> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self {
            v: self.v * b.v,
            d: R::sum_of_products(self.d, b.v, self.v, b.d),
        }
    }
}
impl<R: Real> Neg for Value<R> {
    type Output = Self;
    fn neg(self) -> Self {
        self.times(-R::ONE)
    }
}

/// A vector with its velocity along x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Moving<R> {
    pub(crate) at: Vec2<R>,
    pub(crate) rate: Vec2<R>,
}
impl<R: Real> Moving<R> {
    pub(crate) fn cross(self, b: Self) -> Value<R> {
        Value {
            v: self.at.cross(b.at),
            d: self.rate.cross(b.at) + self.at.cross(b.rate),
        }
    }
    pub(crate) fn dot(self, b: Self) -> Value<R> {
        Value {
            v: self.at.dot(b.at),
            d: self.rate.dot(b.at) + self.at.dot(b.rate),
        }
    }
    pub(crate) fn times(self, k: Value<R>) -> Self {
        Self {
            at: self.at * k.v,
            rate: self.rate * k.v + self.at * k.d,
        }
    }
}
impl<R: Real> Add for Moving<R> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self {
            at: self.at + b.at,
            rate: self.rate + b.rate,
        }
    }
}

/// The event functions other than gaps, in the order of the functions of a watch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Values<R>([Value<R>; 8]);

impl<R: Real> Values<R> {
    pub(crate) const ZERO: Self = Self(
        [Value {
            v: R::ZERO,
            d: R::ZERO,
        }; 8],
    );
    /// The places of what is left of p and of -E_u along u.
    pub(crate) const PATH: usize = 6;
    pub(crate) const STABLE: usize = 7;

    pub(crate) fn get(&self, place: usize) -> Value<R> {
        self.0.get(place).copied().unwrap_or(Value::NONE)
    }
    pub(crate) fn iter(&self) -> impl Iterator<Item = Value<R>> + '_ {
        self.0.iter().copied()
    }
    pub(crate) fn fill(&mut self, values: &[Value<R>]) {
        let mut values = values.iter().copied();
        for slot in &mut self.0 {
            *slot = values.next().unwrap_or(Value::NONE);
        }
    }
    pub(crate) fn put(&mut self, place: usize, value: Value<R>) {
        if let Some(slot) = self.0.get_mut(place) {
            *slot = value;
        }
    }
}
