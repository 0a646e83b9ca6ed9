//! The size of 1 and the origin inside the solver: conversion from SI units and back. Lengths / L, forces / (k_h L), moments / (k_h L²).

use crate::geometry::Vec2;
use crate::real::Real;
use crate::scene::Description;

/// The size of 1 inside the solver, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units<F> {
    /// L (m)
    pub(crate) length: F,
    /// k_h L (N)
    pub(crate) force: F,
    /// k_h L² (N·m)
    pub(crate) moment: F,
    /// 1/L (1/m)
    per_length: F,
    /// The place (m) of the origin inside the solver, where the first vertex starts: so coordinates keep their digits far from that of the
    /// world.
    pub(crate) origin: [F; 2],
}

impl<F: Real> Units<F> {
    /// For a scene whose body has this size (m).
    pub(crate) fn new(d: &Description<'_, F>, length: F) -> Self {
        let force = d.stiffness_translation * length;
        let [x, y, theta] = d.start;
        let (_, rest) = theta.turns();
        let (sin, cos) = rest.sin_cos();
        let [a, b] = d.vertices.first().copied().unwrap_or([F::ZERO; 2]);
        Self {
            length,
            force,
            moment: force * length,
            per_length: F::ONE / length,
            origin: [x + cos * a - sin * b, y + sin * a + cos * b],
        }
    }
    /// They are neither too large nor too small to divide by.
    pub(crate) fn are_usable(&self) -> bool {
        let usable = |unit: F| unit.is_finite() && unit > F::ONE / F::HUGE;
        usable(self.length) && usable(self.force) && usable(self.moment)
    }
    /// So many per k_h L² (1/(N·m)).
    pub(crate) fn per_moment(&self, count: i32) -> F {
        F::from_int(count) / self.moment
    }
    /// 1/(k_h L) (1/N)
    pub(crate) fn per_force(&self) -> F {
        F::ONE / self.force
    }
    /// The units of a tangent: of the pose by the hand, of the wrench by the hand.
    pub(crate) fn of_tangent(&self) -> [[[F; 3]; 3]; 2] {
        let per_hand = [self.per_length, self.per_length, F::ONE];
        let table = |rows: [F; 3]| rows.map(|row| per_hand.map(|per| row * per));
        [
            table([self.length, self.length, F::ONE]),
            table([self.force, self.force, self.moment]),
        ]
    }
    /// A coordinate (m) has no digits left within the body.
    pub(crate) fn is_far(&self, x: F) -> bool {
        x.abs() > F::RANGE * self.length
    }
    /// A length (m), non-dimensional.
    pub(crate) fn length<R: Real<Si = F>>(&self, x: F) -> R {
        R::from_si(x, self.per_length)
    }
    /// A vector (m), or a point of the body frame, non-dimensional.
    pub(crate) fn vector<R: Real<Si = F>>(&self, [x, y]: [F; 2]) -> Vec2<R> {
        Vec2::new(self.length(x), self.length(y))
    }
    /// A point of the world (m), non-dimensional.
    pub(crate) fn point<R: Real<Si = F>>(&self, [x, y]: [F; 2]) -> Vec2<R> {
        let [from_x, from_y] = self.origin;
        self.vector([x - from_x, y - from_y])
    }
    /// A point of the world in m.
    pub(crate) fn place<R: Real<Si = F>>(&self, point: Vec2<R>) -> [F; 2] {
        let [x, y] = self.origin;
        [
            x + point.x.to_si(self.length),
            y + point.y.to_si(self.length),
        ]
    }
    /// The offset (m) of a line of unit normal from the origin inside the solver.
    pub(crate) fn offset(&self, [x, y]: [F; 2], offset: F) -> F {
        let [from_x, from_y] = self.origin;
        offset - (x * from_x + y * from_y)
    }
}
