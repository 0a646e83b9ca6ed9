//! What the states see of a scene: its surfaces, the body's vertices and centroid, springs and weight. Lengths / L, forces
//! / (k_h L).

use crate::friction::{Coulomb, SlidingEdge};
use crate::geometry::Vec2;
use crate::real::Real;
use crate::thresholds::Thresholds;
use core::ops::Range;

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
    /// Nothing reaches it.
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

    /// The direction of an edge of the friction cone from its (normal, friction) parts.
    pub(crate) fn direction(&self, (normal, friction): (R, R)) -> Vec2<R> {
        self.normal * normal + self.tangent * friction
    }

    /// (N, T) of the contact that bears a force on the body.
    pub(crate) fn reaction(&self, force: Vec2<R>) -> (R, R) {
        (-self.normal.dot(force), -self.tangent.dot(force))
    }
}

/// What the states ask of a scene. The constants are known to the compiler: what a scene cannot need is not compiled in.
pub(crate) trait World<R: Real> {
    /// A body of more than one vertex: it can lie on an edge.
    const EDGES: bool;
    /// More than one surface: it can touch two at once.
    const SURFACES: bool;
    /// Two contacts at once are possible.
    const SEVERAL: bool = Self::EDGES || Self::SURFACES;
    /// The only surface is without friction. A contact on it glides: its foot is where the tangential forces balance.
    const GLIDES: bool;

    /// Vertices, body frame, counter-clockwise.
    fn vertices(&self) -> &[Vec2<R>];
    /// The surface of an index; a plane that nothing reaches where there is none.
    fn surface(&self, index: u8) -> Surface<R>;
    /// The indices of all surfaces.
    fn surface_indices(&self) -> Range<u8>;
    /// cg, body frame.
    fn centroid(&self) -> Vec2<R>;
    /// k_theta / (k_h L²)
    fn stiffness(&self) -> R;
    /// The weight as a force, W / (k_h L).
    fn weight(&self) -> Vec2<R>;

    /// Nothing holds the angle of the body in the hand, which holds it at `arm` from its centroid: it swings freely about the holding
    /// point (STATICS 3.7). Held at its centroid it does so in spite of its weight.
    fn swings(&self, arm: Vec2<R>) -> bool {
        let is_held_there = || arm.length_bound() <= R::of_coordinates();
        self.stiffness() == R::ZERO && (self.weight() == Vec2::ZERO || is_held_there())
    }

    /// v_i, body frame; the origin where there is no such vertex.
    fn vertex(&self, i: u8) -> Vec2<R> {
        let vertex = self.vertices().get(usize::from(i));
        *vertex.unwrap_or(&Vec2::ZERO)
    }

    /// The indices of all vertices.
    fn vertex_indices(&self) -> Range<u8> {
        0..u8::try_from(self.vertices().len()).unwrap_or(u8::MAX)
    }

    /// The two neighbours of a vertex (of a rod twice the other one, of a point itself): on the surface that it touches
    /// nothing else can arrive first.
    fn neighbours(&self, i: u8) -> [u8; 2] {
        let last = self.vertex_indices().end.saturating_sub(1);
        let next = if i >= last { 0 } else { i.saturating_add(1) };
        let previous = if i == 0 { last } else { i.saturating_sub(1) };
        [next, previous]
    }
}
