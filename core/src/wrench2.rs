//! A force with its moment, and the products by which cones of them are described.

use crate::geometry::Vec2;
use crate::real::Real;

/// A force with its moment about the pivot of the state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wrench2<R> {
    pub(crate) force: Vec2<R>,
    pub(crate) moment: R,
}

impl<R: Real> Wrench2<R> {
    /// A product that is zero for a wrench in the plane of two others.
    pub(crate) fn dot(self, b: Self) -> R {
        self.force.dot(b.force) + self.moment * b.moment
    }

    /// Normal to two wrenches, as a facet of their cone.
    pub(crate) fn cross(self, b: Self) -> Self {
        let (f, g) = (self.force, b.force);
        Self {
            force: Vec2::new(
                f.y * b.moment - self.moment * g.y,
                self.moment * g.x - f.x * b.moment,
            ),
            moment: f.cross(g),
        }
    }

    pub(crate) fn scaled(self, k: R) -> Self {
        Self {
            force: self.force * k,
            moment: self.moment * k,
        }
    }

    pub(crate) fn over(self, k: R) -> Self {
        Self {
            force: self.force.over(k),
            moment: self.moment / k,
        }
    }

    pub(crate) fn size(self) -> R {
        self.force.length().hypot(self.moment)
    }
}
