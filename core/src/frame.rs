//! A contact in the world: its frame, which is all that cones, shares, modes and pairs see of it; its foot and its gap.

use crate::contact::{Contact, Feature, Sense};
use crate::geometry::{Rotation, Vec2};
use crate::real::Real;
use crate::world::{Friction, Statics};

/// A contact in the world: normal to the free side, tangent t = -i n, lever from the holding point to the contact point, whether the normal
/// turns with the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame<R> {
    pub(crate) n: Vec2<R>,
    pub(crate) t: Vec2<R>,
    pub(crate) r: Vec2<R>,
    pub(crate) turns: bool,
}

/// The directions of a contact that slides with sign s, both of length 1: f = (n - s mu_d t) cos(lambda), that of its reaction, and e = (t +
/// s mu_d n) cos(lambda), along which no load remains; e·f = 0. With cos(lambda), tan(lambda) = mu_d.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge<R> {
    pub(crate) f: Vec2<R>,
    pub(crate) e: Vec2<R>,
    pub(crate) cos: R,
}

/// The point c of a contact and its lever r.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot<R> {
    pub(crate) c: Vec2<R>,
    pub(crate) r: Vec2<R>,
}

impl<R: Real> Frame<R> {
    /// The rate at which the gap opens if the holding point moves at `g` and the body turns at `theta`.
    pub(crate) fn opening(&self, g: Vec2<R>, theta: R) -> R {
        self.n.dot(g + self.r.turned() * theta)
    }
    /// The rate at which the foot moves along t.
    pub(crate) fn advance(&self, g: Vec2<R>, theta: R) -> R {
        self.t.dot(g + self.r.turned() * theta)
    }
    /// The foot along t, with the holding point at `g`.
    pub(crate) fn foot(&self, g: Vec2<R>) -> R {
        if self.turns {
            -self.t.dot(self.r)
        } else {
            self.t.dot(g + self.r)
        }
    }
    /// The directions of a slide of sign s with this friction.
    pub(crate) fn edge(&self, friction: &Friction<R>, s: Sense) -> Edge<R> {
        let (cos, sin) = (friction.sliding.cos, s.along(friction.sliding.sin));
        Edge {
            f: self.n * cos - self.t * sin,
            e: self.t * cos + self.n * sin,
            cos,
        }
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The friction of a contact.
    pub(crate) fn friction(&self, contact: Contact) -> &Friction<R> {
        match contact.feature {
            Feature::Vertex { side, .. } => &self.side(side).friction,
            Feature::Corner { corner, .. } => &self.corner(corner).side.friction,
        }
    }
    /// The normal of a contact turns with the body. Where the world has no corners the compiler knows that none does.
    pub(crate) fn turns(&self, contact: Contact) -> bool {
        C > 0 && contact.is_corner()
    }
    /// n_b: the inward normal of the body's side that begins at a vertex, body frame, of length 1.
    pub(crate) fn inward(&self, body_side: u8) -> Vec2<R> {
        let normal = self.world.normals.get(usize::from(body_side));
        normal.copied().unwrap_or(Vec2::ZERO)
    }

    /// The frame of a contact of the body with this rotation and holding point.
    #[inline(never)]
    pub(crate) fn frame(&self, contact: Contact, rotation: Rotation<R>, g: Vec2<R>) -> Frame<R> {
        self.frame_inlined(contact, rotation, g)
    }
    /// [`Self::frame`], compiled into the caller.
    #[inline(always)]
    pub(crate) fn frame_inlined(
        &self,
        contact: Contact,
        rotation: Rotation<R>,
        g: Vec2<R>,
    ) -> Frame<R> {
        match contact.feature {
            Feature::Vertex { vertex, side } => {
                let side = self.side(side);
                Frame {
                    n: side.normal,
                    t: side.tangent,
                    r: rotation.apply(self.vertex(vertex)),
                    turns: false,
                }
            }
            Feature::Corner { corner, body_side } => {
                let n = rotation.apply(self.inward(body_side));
                Frame {
                    n,
                    t: Vec2::new(n.y, -n.x),
                    r: self.corner(corner).place - g,
                    turns: C > 0,
                }
            }
        }
    }
    /// The directions of a contact that slides with its sign.
    pub(crate) fn edge(&self, contact: Contact, frame: &Frame<R>) -> Edge<R> {
        frame.edge(self.friction(contact), contact.sense)
    }
    /// The contact point, and the lever to it, of a foot xi along t.
    #[inline(always)]
    pub(crate) fn foot(&self, contact: Contact, rotation: Rotation<R>, xi: R) -> Foot<R> {
        match contact.feature {
            Feature::Vertex { vertex, side } => {
                let side = self.side(side);
                Foot {
                    c: side.normal * side.offset + side.tangent * xi,
                    r: rotation.apply(self.vertex(vertex)),
                }
            }
            Feature::Corner { corner, body_side } => {
                let n = self.inward(body_side);
                let eta = n.dot(self.vertex(body_side));
                Foot {
                    c: self.corner(corner).place,
                    r: rotation.apply(n * eta - Vec2::new(n.y, -n.x) * xi),
                }
            }
        }
    }
    /// The foot of a contact along t.
    pub(crate) fn foot_of(&self, contact: Contact, rotation: Rotation<R>, g: Vec2<R>) -> R {
        self.frame(contact, rotation, g).foot(g)
    }
    /// The gap of a contact.
    pub(crate) fn gap(&self, contact: Contact, rotation: Rotation<R>, g: Vec2<R>) -> R {
        let frame = self.frame(contact, rotation, g);
        self.gap_of(contact, &frame, rotation, g)
    }
    /// The gap of a second contact where a first one is closed at a point: of two vertices by the way from one to the other, so that the
    /// rounding of a far holding point does not count.
    pub(crate) fn gap_beside(
        &self,
        [first, second]: [Contact; 2],
        c: Vec2<R>,
        rotation: Rotation<R>,
        g: Vec2<R>,
    ) -> R {
        match (first.feature, second.feature) {
            (Feature::Vertex { vertex: from, .. }, Feature::Vertex { vertex, side }) => {
                let side = self.side(side);
                let to = c + rotation.apply(self.way_between([from, vertex]));
                side.normal.dot(to) - side.offset
            }
            (Feature::Vertex { .. }, Feature::Corner { .. })
            | (Feature::Corner { .. }, Feature::Vertex { .. } | Feature::Corner { .. }) => {
                self.gap(second, rotation, g)
            }
        }
    }
    /// The gap of a contact whose frame is known. Its normal is its own: that of a frame may be levelled with another contact's, and its
    /// rounding would count times the distance from the origin of the line.
    pub(crate) fn gap_of(
        &self,
        contact: Contact,
        frame: &Frame<R>,
        rotation: Rotation<R>,
        g: Vec2<R>,
    ) -> R {
        match contact.feature {
            Feature::Vertex { side, .. } => {
                let side = self.side(side);
                side.normal.dot(g + frame.r) - side.offset
            }
            Feature::Corner { body_side, .. } => {
                let n = rotation.apply(self.inward(body_side));
                n.dot(rotation.apply(self.vertex(body_side)) - frame.r)
            }
        }
    }
}
