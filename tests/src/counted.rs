//! A number type that counts its operations: f64, so that the work of a frame is the same on every machine and in every build.

use std::cell::Cell;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use stiction_core::Real;

thread_local! {
    static OPERATIONS: Cell<u64> = const { Cell::new(0) };
}

/// An f64 whose operations are counted on this thread.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counted(f64);

/// The result of a function, and how many operations it takes: sums, products, quotients, comparisons, roots and
/// trigonometric functions each count 1.
pub fn counted<T>(work: impl FnOnce() -> T) -> (T, u64) {
    let before = OPERATIONS.get();
    let made = work();
    (made, OPERATIONS.get() - before)
}

fn count<T>(value: T) -> T {
    OPERATIONS.set(OPERATIONS.get() + 1);
    value
}

macro_rules! counted {
    ($($operator:ident $method:ident),*) => {$(
        impl $operator for Counted {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                count(Self(self.0.$method(other.0)))
            }
        }
    )*};
}

counted!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        count(self.0.partial_cmp(&other.0))
    }
}

macro_rules! constants {
    ($($name:ident)*) => {$(
        const $name: Self = Self(<f64 as Real>::$name);
    )*};
}

impl Real for Counted {
    type Si = f64;

    constants!(ZERO HALF ONE TWO TAU EPSILON TOUCH MICRO RANGE LOAD TURN HUGE LEAST);

    fn from_int(n: i32) -> Self {
        Self(n.into())
    }
    fn from_si(x: f64, per: f64) -> Self {
        count(Self(x * per))
    }
    fn to_si(self, unit: f64) -> f64 {
        count(self.0 * unit)
    }
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    fn sqrt(self) -> Self {
        count(Self(Real::sqrt(self.0)))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = count(Real::sin_cos(self.0));
        (Self(sin), Self(cos))
    }
    fn atan2(self, other: Self) -> Self {
        count(Self(Real::atan2(self.0, other.0)))
    }
    fn turns(self) -> (i32, Self) {
        let (turns, rest) = Real::turns(self.0);
        (turns, Self(rest))
    }
}
