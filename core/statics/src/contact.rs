//! A contact: what touches what, whether it sticks or slides; and its frame, which is all that cones, shares, modes and pairs see of it.

use crate::geometry::{Rotation, Vec2};
use crate::real::Real;
use crate::world::{Friction, Statics};

/// At most this many contacts at a time; further ones are not reported.
pub const MAX_CONTACTS: usize = 8;

/// What touches what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Feature {
    /// V: a vertex of the body on a side of the world.
    Vertex { vertex: u8, side: u8 },
    /// C: a corner of the world on the side of the body that begins at a vertex.
    Corner { corner: u8, body_side: u8 },
}

/// Whether a contact sticks, or slides along its tangent t.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Sense {
    /// It sticks.
    #[default]
    Rests,
    /// It slides along t.
    Plus,
    /// It slides against t.
    Minus,
}

impl Sense {
    /// The sense of a number that is not zero.
    pub(crate) fn of<R: Real>(x: R) -> Self {
        if x > R::ZERO { Self::Plus } else { Self::Minus }
    }
    /// s: 0, 1 or -1
    pub(crate) fn number<R: Real>(self) -> R {
        self.along(R::ONE)
    }
    /// s x
    pub(crate) fn along<R: Real>(self, x: R) -> R {
        match self {
            Self::Rests => R::ZERO,
            Self::Plus => x,
            Self::Minus => -x,
        }
    }
    pub(crate) fn reversed(self) -> Self {
        match self {
            Self::Rests => Self::Rests,
            Self::Plus => Self::Minus,
            Self::Minus => Self::Plus,
        }
    }
    pub(crate) fn slides(self) -> bool {
        self != Self::Rests
    }
    /// Both slide, in different directions.
    pub(crate) fn opposes(self, other: Self) -> bool {
        self.slides() && other.slides() && self != other
    }
    /// 0, 1 or -1
    pub(crate) fn integer(self) -> i8 {
        match self {
            Self::Rests => 0,
            Self::Plus => 1,
            Self::Minus => -1,
        }
    }
}

/// A contact with its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Contact {
    pub(crate) feature: Feature,
    pub(crate) sense: Sense,
}

impl Contact {
    pub(crate) const NONE: Self = Self::at(Feature::Vertex {
        vertex: u8::MAX,
        side: u8::MAX,
    });
    /// One that sticks.
    pub(crate) const fn at(feature: Feature) -> Self {
        Self {
            feature,
            sense: Sense::Rests,
        }
    }
    pub(crate) const fn with(self, sense: Sense) -> Self {
        Self { sense, ..self }
    }
    /// The vertex, if it is one that touches.
    pub(crate) const fn vertex(self) -> Option<u8> {
        match self.feature {
            Feature::Vertex { vertex, .. } => Some(vertex),
            Feature::Corner { .. } => None,
        }
    }
    pub(crate) const fn is_corner(self) -> bool {
        match self.feature {
            Feature::Vertex { .. } => false,
            Feature::Corner { .. } => true,
        }
    }
    /// Two contacts of one vertex: the body can only turn about it.
    pub(crate) fn shares_vertex(self, other: Self) -> bool {
        self.vertex().is_some() && self.vertex() == other.vertex()
    }
    /// Two contacts in one line: on one side of the world, or of the body.
    pub(crate) fn is_in_line(self, other: Self) -> bool {
        match (self.feature, other.feature) {
            (Feature::Vertex { side, .. }, Feature::Vertex { side: of_other, .. }) => {
                side == of_other
            }
            (
                Feature::Corner { body_side, .. },
                Feature::Corner {
                    body_side: of_other,
                    ..
                },
            ) => body_side == of_other,
            (Feature::Vertex { .. }, Feature::Corner { .. })
            | (Feature::Corner { .. }, Feature::Vertex { .. }) => false,
        }
    }
}

/// The contacts of a body, the one that places it first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Contacts {
    list: [Contact; MAX_CONTACTS],
    count: u8,
}

impl Contacts {
    pub(crate) const NONE: Self = Self {
        list: [Contact::NONE; MAX_CONTACTS],
        count: 0,
    };
    pub(crate) fn len(&self) -> usize {
        usize::from(self.count)
    }
    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }
    pub(crate) fn as_slice(&self) -> &[Contact] {
        self.list.get(..self.len()).unwrap_or(&[])
    }
    pub(crate) fn iter(&self) -> impl Iterator<Item = Contact> + Clone + '_ {
        self.as_slice().iter().copied()
    }
    /// Contact i; none if there are fewer.
    pub(crate) fn get(&self, i: usize) -> Contact {
        self.as_slice().get(i).copied().unwrap_or(Contact::NONE)
    }
    pub(crate) fn first(&self) -> Contact {
        self.get(0)
    }
    /// The first two.
    pub(crate) fn pair(&self) -> [Contact; 2] {
        [self.get(0), self.get(1)]
    }
    pub(crate) fn contains(&self, feature: Feature) -> bool {
        self.iter().any(|c| c.feature == feature)
    }
    /// Adds a contact that sticks, if there is room for it.
    pub(crate) fn add(&mut self, feature: Feature) {
        if let Some(place) = self.list.get_mut(usize::from(self.count)) {
            *place = Contact::at(feature);
            self.count = self.count.saturating_add(1);
        }
    }
    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }
    /// Contact i becomes the first.
    pub(crate) fn lead(&mut self, i: usize) {
        if i < self.len() {
            self.list.swap(0, i);
        }
    }
    /// Only these remain, in this order.
    pub(crate) fn keep(&mut self, kept: &[Contact]) {
        self.count = 0;
        for (place, contact) in self.list.iter_mut().zip(kept) {
            *place = *contact;
            self.count = self.count.saturating_add(1);
        }
    }
    /// All stick.
    pub(crate) fn rest(&mut self) {
        for contact in &mut self.list {
            contact.sense = Sense::Rests;
        }
    }
    /// All slide in this sense.
    pub(crate) fn slide(&mut self, sense: Sense) {
        for contact in &mut self.list {
            contact.sense = sense;
        }
    }
    /// The first two get these senses.
    pub(crate) fn slide_pair(&mut self, senses: [Sense; 2]) {
        for (contact, sense) in self.list.iter_mut().zip(senses) {
            contact.sense = sense;
        }
    }
    /// One contact, or several of one vertex: the body can turn about the first.
    pub(crate) fn turn_about_first(&self) -> bool {
        let first = self.first();
        !self.is_empty() && self.iter().skip(1).all(|c| c.shares_vertex(first))
    }
    /// Two contacts in one line.
    pub(crate) fn are_edge(&self) -> bool {
        let [first, second] = self.pair();
        self.count == 2 && first.is_in_line(second)
    }
}

/// A contact in the world: normal to the free side, tangent t = -i n, lever from the holding point to the contact point, whether the normal
/// turns with the body.
#[derive(Clone, Copy, Debug)]
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
    pub(crate) fn friction(&self, contact: Contact) -> Friction<R> {
        match contact.feature {
            Feature::Vertex { side, .. } => self.side(side).friction,
            Feature::Corner { corner, .. } => {
                let corner = self.world.corners.get(usize::from(corner));
                corner.map_or(Friction::NONE, |corner| corner.friction)
            }
        }
    }
    /// The place of a corner of the world.
    fn corner(&self, corner: u8) -> Vec2<R> {
        let corner = self.world.corners.get(usize::from(corner));
        corner.map_or(Vec2::ZERO, |corner| corner.place)
    }
    /// n_b: the inward normal of the body's side that begins at a vertex, body frame, of length 1.
    fn inward(&self, body_side: u8) -> Vec2<R> {
        let last = body_side.saturating_add(1);
        let next = if usize::from(last) < self.world.vertices.len() {
            last
        } else {
            0
        };
        let side = self.vertex(next) - self.vertex(body_side);
        let length = side.length();
        Vec2::new(-side.y / length, side.x / length)
    }

    /// The frame of a contact of the body with this rotation and holding point.
    pub(crate) fn frame(&self, contact: Contact, rotation: Rotation<R>, g: Vec2<R>) -> Frame<R> {
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
                    r: self.corner(corner) - g,
                    turns: true,
                }
            }
        }
    }
    /// The directions of a contact that slides with its sign.
    pub(crate) fn edge(&self, contact: Contact, frame: &Frame<R>) -> Edge<R> {
        frame.edge(&self.friction(contact), contact.sense)
    }
    /// The contact point, and the lever to it, of a foot xi along t.
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
                    c: self.corner(corner),
                    r: rotation.apply(n * eta - Vec2::new(n.y, -n.x) * xi),
                }
            }
        }
    }
    /// The foot of a contact along t.
    pub(crate) fn foot_of(&self, contact: Contact, rotation: Rotation<R>, g: Vec2<R>) -> R {
        let frame = self.frame(contact, rotation, g);
        if frame.turns {
            -frame.t.dot(frame.r)
        } else {
            frame.t.dot(g + frame.r)
        }
    }
    /// The gap of a contact.
    pub(crate) fn gap(&self, contact: Contact, rotation: Rotation<R>, g: Vec2<R>) -> R {
        let frame = self.frame(contact, rotation, g);
        self.gap_of(contact, &frame, rotation, g)
    }
    /// The gap of a contact whose frame is known.
    pub(crate) fn gap_of(
        &self,
        contact: Contact,
        frame: &Frame<R>,
        rotation: Rotation<R>,
        g: Vec2<R>,
    ) -> R {
        match contact.feature {
            Feature::Vertex { side, .. } => frame.n.dot(g + frame.r) - self.side(side).offset,
            Feature::Corner { body_side, .. } => frame
                .n
                .dot(rotation.apply(self.vertex(body_side)) - frame.r),
        }
    }
}
