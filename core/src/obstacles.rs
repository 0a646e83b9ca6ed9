//! Obstacles with corners: closed convex polygons, thin walls of two corners, pins of one (STATICS 12). A scene without them, C = 0, has no
//! code for them.

pub(crate) mod apart;
pub(crate) mod axes;
mod cover;
pub(crate) mod ends;
pub(crate) mod flat;
mod front;
pub(crate) mod join;
mod leave;
mod straight;
pub(crate) mod union;
mod witness;

use crate::contact::{Contact, Contacts, Feature};
use crate::event::StateKind;
use crate::forces::Touch;
use crate::geometry::Vec2;
use crate::real::Real;
use crate::world::{Side, Statics};

/// A corner of an obstacle, and the side from it to the next one. World frame, lengths / L.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corner<R> {
    pub(crate) place: Vec2<R>,
    /// That side, on the line that it forms with others; of a pin its friction alone.
    pub(crate) side: Side<R>,
    /// Where the side begins and ends along its tangent, with all sides that are one with it.
    pub(crate) ends: [R; 2],
    /// The index of the longest side in its line.
    pub(crate) line: u8,
    /// The index of the first side that is one with it: the one that is touched.
    pub(crate) one: u8,
    /// The index of the first corner at its place: the one that is touched.
    pub(crate) first: u8,
    pub(crate) obstacle: u8,
    /// No side of the body can touch it.
    pub(crate) covered: bool,
    /// No vertex can touch its side: another obstacle is before it.
    pub(crate) hidden: bool,
}

/// An obstacle: its corners, counter-clockwise, and a circle around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Obstacle<R> {
    pub(crate) from: u8,
    pub(crate) count: u8,
    pub(crate) middle: Vec2<R>,
    pub(crate) radius: R,
}

impl<R: Real> Corner<R> {
    pub(crate) const NOWHERE: Self = Self {
        place: Vec2::ZERO,
        side: Side::NOWHERE,
        ends: [R::LEAST, R::HUGE],
        line: u8::MAX,
        one: u8::MAX,
        first: u8::MAX,
        obstacle: u8::MAX,
        covered: true,
        hidden: true,
    };
}

impl<R: Real> Obstacle<R> {
    pub(crate) const NONE: Self = Self {
        from: 0,
        count: 0,
        middle: Vec2::ZERO,
        radius: R::ZERO,
    };
    /// The index of its corner k, counted around it.
    pub(crate) fn corner(&self, k: u8) -> u8 {
        let k = if k < self.count {
            k
        } else {
            k.saturating_sub(self.count)
        };
        self.from.saturating_add(k)
    }
    pub(crate) fn corners(&self) -> core::ops::Range<u8> {
        self.from..self.from.saturating_add(self.count)
    }
    /// A pin has none.
    pub(crate) fn has_sides(&self) -> bool {
        self.count > 1
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// A corner of the world; one that nothing reaches if there is none of that index.
    pub(crate) fn corner(&self, index: u8) -> &Corner<R> {
        let corner = self.world.corners.get(usize::from(index));
        corner.filter(|_| C > 0).unwrap_or(&self.world.nowhere)
    }
    pub(crate) fn obstacle(&self, index: u8) -> Obstacle<R> {
        let obstacle = self.world.obstacles.get(usize::from(index));
        obstacle.copied().unwrap_or(Obstacle::NONE)
    }
    /// All obstacles, with their indices.
    pub(crate) fn obstacles(&self) -> impl Iterator<Item = (u8, Obstacle<R>)> {
        (0_u8..).zip(self.world.obstacles.iter().copied())
    }
    /// The corner at which a side of an obstacle begins; none for a half-plane.
    pub(crate) fn corner_of_side(&self, side: u8) -> Option<u8> {
        let planes = u8::try_from(self.world.sides.len()).unwrap_or(u8::MAX);
        side.checked_sub(planes)
    }
    /// The side that begins at a corner, as one that is touched.
    pub(crate) fn side_at(&self, corner: u8) -> u8 {
        self.corner(corner).one
    }
    /// The longest side in the line of a side.
    fn line(&self, side: u8) -> u8 {
        self.corner_of_side(side)
            .map_or(side, |corner| self.corner(corner).line)
    }
    /// The sides of the body; a point has none.
    pub(crate) fn body_sides(&self) -> core::ops::Range<u8> {
        let count = u8::try_from(self.world.vertices.len()).unwrap_or(u8::MAX);
        0..if count > 1 { count } else { 0 }
    }
    /// The vertex after one, or before it, counted around the body.
    pub(crate) fn next_vertex(&self, vertex: u8) -> u8 {
        let next = vertex.saturating_add(1);
        if usize::from(next) < self.world.vertices.len() {
            next
        } else {
            0
        }
    }
    pub(crate) fn vertex_before(&self, vertex: u8) -> u8 {
        let last = self.world.vertices.len().saturating_sub(1);
        let last = u8::try_from(last).unwrap_or(u8::MAX);
        vertex.checked_sub(1).unwrap_or(last)
    }
    /// The obstacle of a contact; none for a half-plane.
    pub(crate) fn obstacle_of(&self, contact: Contact) -> Option<u8> {
        let corner = match contact.feature {
            Feature::Vertex { side, .. } => self.corner_of_side(side)?,
            Feature::Corner { corner, .. } => corner,
        };
        Some(self.corner(corner).obstacle)
    }
    /// What touches is held already: the vertex on the same line, the corner on the same side of the body.
    pub(crate) fn holds(&self, contacts: &Contacts, feature: Feature) -> bool {
        if C == 0 {
            return contacts.contains(feature);
        }
        contacts.iter().any(|held| match (held.feature, feature) {
            (Feature::Vertex { vertex, side }, Feature::Vertex { vertex: v, side: s }) => {
                vertex == v && self.line(side) == self.line(s)
            }
            (Feature::Corner { .. }, Feature::Corner { .. })
            | (Feature::Vertex { .. }, Feature::Corner { .. })
            | (Feature::Corner { .. }, Feature::Vertex { .. }) => held.feature == feature,
        })
    }
    /// Two contacts in one line by what touches: on one line of the world, on one side of the body, or a vertex and a corner on both.
    pub(crate) fn is_in_line(&self, a: Contact, b: Contact) -> bool {
        if C == 0 {
            return !self.has_wedges() || a.is_in_line(b);
        }
        match (a.feature, b.feature) {
            (Feature::Vertex { side, .. }, Feature::Vertex { side: other, .. }) => {
                self.line(side) == self.line(other)
            }
            (
                Feature::Corner { body_side, .. },
                Feature::Corner {
                    body_side: other, ..
                },
            ) => body_side == other,
            (Feature::Vertex { vertex, side }, Feature::Corner { corner, body_side })
            | (Feature::Corner { corner, body_side }, Feature::Vertex { vertex, side }) => {
                let is_end = vertex == body_side || vertex == self.next_vertex(body_side);
                is_end && self.is_on_line(corner, side)
            }
        }
    }
    /// A corner lies on the line of a side.
    fn is_on_line(&self, corner: u8, side: u8) -> bool {
        let side = self.side(side);
        let height = side.normal.dot(self.corner(corner).place) - side.offset;
        height.abs() <= R::MICRO
    }
    /// Two contacts in one line, and of equal friction: an edge.
    pub(crate) fn is_edge(&self, contacts: &Contacts) -> bool {
        let [first, second] = contacts.pair();
        match contacts.len() {
            0 | 1 => false,
            2 => self.is_even(first, second),
            _ => !self.has_wedges(),
        }
    }
    /// Two contacts in one line are of equal friction.
    pub(crate) fn is_even(&self, a: Contact, b: Contact) -> bool {
        self.is_in_line(a, b) && self.has_one_friction(a, b)
    }
    /// Two contacts in one line are of equal friction; those of one side are.
    pub(crate) fn has_one_friction(&self, a: Contact, b: Contact) -> bool {
        C == 0 || a.is_in_line(b) && !a.is_corner() || self.friction(a) == self.friction(b)
    }
    /// What touches what, by the indices of the description.
    pub(crate) fn touch_of(&self, contact: Contact) -> Touch {
        let corner = match contact.feature {
            Feature::Vertex { side, .. } => self.corner_of_side(side),
            Feature::Corner { corner, .. } => Some(corner),
        };
        let index = usize::from;
        let obstacle = |corner| self.corner(corner).obstacle;
        let within =
            |corner: u8| index(corner.saturating_sub(self.obstacle(obstacle(corner)).from));
        match (contact.feature, corner) {
            (Feature::Vertex { vertex, .. }, Some(side)) => Touch::Side {
                vertex: index(vertex),
                obstacle: index(obstacle(side)),
                side: within(side),
            },
            (Feature::Vertex { vertex, side }, None) => Touch::Surface {
                vertex: index(vertex),
                surface: index(side),
            },
            (Feature::Corner { corner, body_side }, _) => Touch::Corner {
                obstacle: index(obstacle(corner)),
                corner: within(corner),
                body_side: index(body_side),
            },
        }
    }
    /// The name of what the contacts are.
    pub(crate) fn kind(&self, contacts: &Contacts) -> StateKind {
        let [first, second] = contacts.pair();
        match contacts.len() {
            0 => StateKind::NonContact,
            1 => StateKind::SingleVertex,
            2 if self.is_in_line(first, second) => StateKind::Edge,
            2 if first.shares_vertex(second) => StateKind::Corner,
            2 => StateKind::TwoVertex,
            _ => StateKind::Locked,
        }
    }
}
