//! A sign, or zero, in a byte: how a state stores a direction.

use crate::real::Real;

/// -1, 0 or 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sign(i8);

impl Sign {
    pub(crate) fn of<R: Real>(number: R) -> Self {
        Self(if number > R::ZERO {
            1
        } else if number < R::ZERO {
            -1
        } else {
            0
        })
    }

    pub(crate) fn number<R: Real>(self) -> R {
        R::from_int(i32::from(self.0))
    }
}
