//! The states' view of a scene: its surfaces, the body's vertices and centroid, springs and weight. Lengths / L, forces / (k_h L).

use crate::contact::Pair;
use crate::forces::Touch;
use crate::geometry::{Rotation, Vec2};
use crate::obstacle::{Corner, Round};
use crate::real::Real;
pub(crate) use crate::surface::Surface;
use crate::thresholds::Thresholds;
use core::ops::Range;

/// The interface of a scene to the states. The constants are known to the compiler: code that a scene cannot need is not compiled in.
pub(crate) trait World<R: Real>: Sized {
    /// A body of more than one vertex: it can lie on an edge.
    const EDGES: bool;
    /// More than one surface, or obstacles: it can touch two simultaneously.
    const SURFACES: bool;
    /// Obstacles with corners.
    const CORNERS: bool;
    /// Two simultaneous contacts are possible.
    const SEVERAL: bool = Self::EDGES || Self::SURFACES;
    /// The only surface is without friction. A contact on it glides: its foot is where the tangential forces balance.
    const GLIDES: bool;

    /// Vertices, body frame, counter-clockwise.
    fn vertices(&self) -> &[Vec2<R>];
    /// The surface of an index; if there is none, a plane that nothing reaches.
    fn surface(&self, index: u8) -> Surface<R>;
    /// The indices of all half-planes.
    fn surface_indices(&self) -> Range<u8>;
    /// All corners of obstacles, obstacle by obstacle; the indices of corners as surfaces follow those of the half-planes.
    fn corners(&self) -> &[Corner<R>];
    /// For each obstacle the index of its first corner.
    fn firsts(&self) -> &[u8];
    /// For each obstacle a circle that contains it.
    fn rounds(&self) -> &[Round<R>];
    /// m_j: the outward normal of the body's side that begins at vertex j, body frame.
    fn body_normal(&self, side: u8) -> Vec2<R>;
    /// cg, body frame.
    fn centroid(&self) -> Vec2<R>;
    /// k_theta / (k_h L²)
    fn stiffness(&self) -> R;
    /// The weight as a force, W / (k_h L).
    fn weight(&self) -> Vec2<R>;

    /// Returns whether nothing holds the angle of the body in the hand, which holds it at `arm` from its centroid: then it swings freely
    /// about the holding point (STATICS 3.7). Held at its centroid it does so in spite of its weight.
    fn swings(&self, arm: Vec2<R>) -> bool {
        let is_held_there = || arm.length_bound() <= R::of_coordinates();
        self.stiffness() == R::ZERO && (self.weight() == Vec2::ZERO || is_held_there())
    }

    /// The corner of an index among the surfaces.
    fn corner(&self, index: u8) -> Option<&Corner<R>> {
        let first = self.surface_indices().end;
        (self.corners()).get(usize::from(index.checked_sub(first)?))
    }

    /// The obstacle of a contact; `None` for a half-plane.
    fn obstacle_of(&self, contact: Pair) -> Option<u8> {
        self.corner(contact.surface).map(|corner| corner.obstacle)
    }

    /// The surface of a contact in an orientation of the body: for a corner the line of the body's side, which turns with the body.
    fn face(&self, contact: Pair, rotation: Rotation<R>) -> Surface<R> {
        let surface = self.surface(contact.surface);
        if !Self::CORNERS || !contact.is_corner() {
            return surface;
        }
        let place = self.corner(contact.surface).map_or(Vec2::ZERO, |c| c.place);
        let normal = -rotation.apply(self.body_normal(contact.body_side()));
        let offset = normal.dot(place);
        Surface {
            normal,
            tangent: Vec2::new(normal.y, -normal.x),
            offset,
            origin: normal * offset,
            friction: surface.friction,
        }
    }

    /// What touches what, by the indices of the description.
    fn touch(&self, contact: Pair) -> Touch {
        let (vertex, surface) = (usize::from(contact.vertex), usize::from(contact.surface));
        let Some(corner) = self.corner(contact.surface) else {
            return Touch::Surface { vertex, surface };
        };
        let obstacle = usize::from(corner.obstacle);
        let first = self.firsts().get(obstacle).copied().unwrap_or_default();
        let first = usize::from(self.surface_indices().end.saturating_add(first));
        let index = surface.saturating_sub(first);
        if contact.is_corner() {
            Touch::Corner {
                obstacle,
                corner: index,
                body_side: usize::from(contact.body_side()),
            }
        } else {
            Touch::Side {
                vertex,
                obstacle,
                side: index,
            }
        }
    }

    /// Where the side of a contact begins and ends along t; for a half-plane beyond all numbers.
    fn reach(&self, contact: Pair) -> [R; 2] {
        let Some(corner) = self.corner(contact.surface) else {
            return [R::LEAST, R::HUGE];
        };
        if !contact.is_corner() {
            return corner.reach;
        }
        // t_b
        let tangent = self.body_normal(contact.body_side()).turned();
        let side = contact.body_side();
        let [next, _] = self.neighbours(side);
        [next, side].map(|end| -tangent.dot(self.vertex(end)))
    }

    /// v_i, body frame; the origin if there is no such vertex.
    fn vertex(&self, i: u8) -> Vec2<R> {
        let vertex = self.vertices().get(usize::from(i));
        *vertex.unwrap_or(&Vec2::ZERO)
    }

    /// The indices of all vertices.
    fn vertex_indices(&self) -> Range<u8> {
        0..u8::try_from(self.vertices().len()).unwrap_or(u8::MAX)
    }

    /// The two neighbours of a vertex (for a rod twice the other one, for a point itself): on the surface that it touches nothing else can
    /// arrive first.
    fn neighbours(&self, i: u8) -> [u8; 2] {
        let last = self.vertex_indices().end.saturating_sub(1);
        let next = if i >= last { 0 } else { i.saturating_add(1) };
        let previous = if i == 0 { last } else { i.saturating_sub(1) };
        [next, previous]
    }
}
