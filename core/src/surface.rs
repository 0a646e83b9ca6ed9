//! A line that a contact touches: a half-plane, the side of an obstacle, or the side of the body at a corner. World frame, lengths / L.

use crate::friction::{Coulomb, SlidingEdge};
use crate::geometry::Vec2;
use crate::real::Real;

/// A checked surface, lengths / L.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Surface<R> {
    /// n: unit normal to the free side.
    pub(crate) normal: Vec2<R>,
    /// t = (n_y, -n_x)
    pub(crate) tangent: Vec2<R>,
    /// b: the free side is n·p >= b.
    pub(crate) offset: R,
    /// The point of the surface that is nearest to the origin.
    pub(crate) origin: Vec2<R>,
    /// Friction on this surface.
    pub(crate) friction: Coulomb<R>,
}

impl<R: Real> Surface<R> {
    /// A surface that nothing reaches.
    pub(crate) const NOWHERE: Self = Self {
        normal: Vec2::new(R::ZERO, R::ONE),
        tangent: Vec2::new(R::ONE, R::ZERO),
        offset: R::LEAST,
        origin: Vec2::ZERO,
        friction: Coulomb::FRICTIONLESS,
    };

    /// The directions of a contact that slides along sign·t.
    pub(crate) fn sliding(&self, sign: R) -> SlidingEdge<R> {
        self.friction
            .sliding_along((self.normal, self.tangent), sign)
    }

    /// The direction of an edge of the friction cone from its (normal, friction) components.
    pub(crate) fn direction(&self, (normal, friction): (R, R)) -> Vec2<R> {
        self.normal * normal + self.tangent * friction
    }

    /// (N, T) of the contact that bears a force on the body.
    pub(crate) fn reaction(&self, force: Vec2<R>) -> (R, R) {
        (-self.normal.dot(force), -self.tangent.dot(force))
    }
}
