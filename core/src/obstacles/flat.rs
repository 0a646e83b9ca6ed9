//! What lies in one line: where the body is flat on something, its two outermost contacts bear (R38).

use super::Obstacle;
use super::axes::At;
use crate::contact::{Contact, Feature};
use crate::frame::Frame;
use crate::geometry::{Rotation, Vec2};
use crate::real::Real;
use crate::state::Body;
use crate::thresholds::Thresholds;
use crate::world::Statics;

impl<R: Real> Body<R> {
    /// Where it is.
    pub(crate) fn at(&self) -> At<R> {
        At {
            rotation: self.rotation,
            g: self.holding,
        }
    }
}

/// The outermost of some contacts along a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span<R> {
    pub(crate) low: Option<Contact>,
    pub(crate) high: Option<Contact>,
    from: R,
    to: R,
}

impl<R: Real> Span<R> {
    pub(crate) const NONE: Self = Self {
        low: None,
        high: None,
        from: R::HUGE,
        to: R::LEAST,
    };
    /// Takes a contact at x if it is farther out by more than `little`.
    pub(crate) fn take(&mut self, contact: Contact, x: R, little: R) {
        if self.low.is_none() || x < self.from - little {
            (self.low, self.from) = (Some(contact), x);
        }
        if self.high.is_none() || x > self.to + little {
            (self.high, self.to) = (Some(contact), x);
        }
    }
    /// Both ends; the first alone if they are one contact, or at one place.
    pub(crate) fn ends(&self, least: R) -> [Option<Contact>; 2] {
        let same = |c: Contact| self.high.is_some_and(|high| high.feature == c.feature);
        if self.low.is_some_and(same) || self.to - self.from <= least {
            return [self.low, None];
        }
        [self.low, self.high]
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    pub(crate) fn frame_here(&self, contact: Contact, at: At<R>) -> Frame<R> {
        self.frame(contact, at.rotation, at.g)
    }
    pub(crate) fn gap_here(&self, contact: Contact, at: At<R>) -> R {
        self.gap(contact, at.rotation, at.g)
    }
    /// The point of a contact.
    pub(crate) fn point(&self, contact: Contact, at: At<R>) -> Vec2<R> {
        match contact.feature {
            Feature::Vertex { vertex, .. } => at.g + at.rotation.apply(self.vertex(vertex)),
            Feature::Corner { corner, .. } => self.corner(corner).place,
        }
    }
    /// All pairs of features that may touch near the body, with a normal not farther than 60 degrees from a direction.
    fn near_features(&self, n: Vec2<R>, at: At<R>) -> impl Iterator<Item = Contact> {
        let vertices = 0..u8::try_from(self.world.vertices.len()).unwrap_or(u8::MAX);
        let alike = move |m: Vec2<R>| m.dot(n) >= R::HALF;
        let planes = self.sides().filter(move |(_, side)| alike(side.normal));
        let of_planes = planes.flat_map(move |(side, _)| {
            let on = move |vertex: u8| Contact::at(Feature::Vertex { vertex, side });
            vertices.clone().map(on)
        });
        let near = self
            .obstacles()
            .filter(move |(_, o)| self.distance_bound(o, at.g) <= R::ZERO);
        of_planes.chain(near.flat_map(move |(_, o)| self.features_of(&o, at, alike)))
    }
    /// All pairs of features of the body and an obstacle that may touch, with a normal of some.
    pub(super) fn features_of<F: Fn(Vec2<R>) -> bool + Copy>(
        &self,
        o: &Obstacle<R>,
        at: At<R>,
        is_one: F,
    ) -> impl Iterator<Item = Contact> + use<'_, R, V, S, C, F> {
        let vertices = 0..u8::try_from(self.world.vertices.len()).unwrap_or(u8::MAX);
        let (corners, sides) = (o.corners(), if o.has_sides() { o.corners() } else { 0..0 });
        let sides = sides.filter(move |&k| {
            let side = self.corner(k);
            !side.hidden && is_one(side.side.normal)
        });
        let of_sides = sides.flat_map(move |k| {
            let side = self.side_at(k);
            let on = move |vertex: u8| Contact::at(Feature::Vertex { vertex, side });
            vertices.clone().map(on)
        });
        let body_sides = self.body_sides();
        let body_sides = body_sides.filter(move |&j| is_one(at.rotation.apply(self.inward(j))));
        let of_corners = body_sides.flat_map(move |body_side| {
            corners.clone().map(move |k| {
                let corner = self.corner(k).first;
                Contact::at(Feature::Corner { corner, body_side })
            })
        });
        of_sides.chain(of_corners)
    }
    /// What touches in one line with a contact, on its side or not: the outermost contacts along its tangent.
    pub(crate) fn flat(&self, contact: Contact, at: At<R>, tol: R) -> [Option<Contact>; 2] {
        let frame = self.frame_here(contact, at);
        let along = |c: Contact| frame.t.dot(self.point(c, at));
        let mut span = Span::NONE;
        if self.is_on_side(contact, at) {
            span.take(contact, along(contact), R::ZERO);
        }
        for c in self.near_features(frame.n, at) {
            let is_closed = self.gap_here(c, at).abs() <= tol;
            if is_closed && self.is_on_side(c, at) && self.is_level(contact, c, at, tol) {
                span.take(c, along(c), tol);
            }
        }
        span.ends(R::MICRO.max(tol))
    }
    /// At the place of a contact one of the other kind in its line: the corner there on a side of the body, or the vertex there on a side.
    pub(crate) fn between(&self, contact: Contact, at: At<R>) -> Option<Contact> {
        let tol = R::TOUCH.doubled();
        let (n, place) = (self.frame_here(contact, at).n, self.point(contact, at));
        let mut all = self.near_features(n, at);
        all.find(|&c| {
            c.is_corner() != contact.is_corner()
                && (self.point(c, at) - place).length_bound() <= R::MICRO
                && self.gap_here(c, at).abs() <= tol
                && self.is_on_side(c, at)
                && self.is_level(contact, c, at, tol)
        })
    }
    /// Two contacts in one line where the body is, to within `tol`.
    pub(crate) fn is_level(&self, a: Contact, b: Contact, at: At<R>, tol: R) -> bool {
        let (f, n) = (self.frame_here(a, at), self.frame_here(b, at).n);
        let way = self.point(b, at) - self.point(a, at);
        let turn = n.cross(f.n).abs();
        let reach = turn * f.t.dot(way).abs();
        is_alike(f.n, n)
            && f.n.dot(way).abs() <= tol.doubled()
            && (reach <= tol * R::from_int(4) || self.is_in_line(a, b))
    }
    /// The frames of two contacts; those of a vertex and a corner in one line have one normal, whatever the rounding of the body's angle.
    pub(crate) fn frames(
        &self,
        [a, b]: [Contact; 2],
        rotation: Rotation<R>,
        g: Vec2<R>,
    ) -> [Frame<R>; 2] {
        let frames = [self.frame(a, rotation, g), self.frame(b, rotation, g)];
        self.levelled([a, b], frames)
    }
    pub(crate) fn levelled(&self, [a, b]: [Contact; 2], frames: [Frame<R>; 2]) -> [Frame<R>; 2] {
        let [first, second] = frames;
        if C == 0 || first.turns == second.turns || !self.is_in_line(a, b) {
            return frames;
        }
        let (n, t) = (first.n, first.t);
        [first, Frame { n, t, ..second }]
    }
    /// Two contacts of nearly one normal on one side of the body, or in one line.
    pub(crate) fn is_flat(&self, a: Contact, b: Contact, at: At<R>) -> bool {
        let on = |side: u8, c: Contact| match c.feature {
            Feature::Vertex { vertex, .. } => vertex == side || vertex == self.next_vertex(side),
            Feature::Corner { body_side, .. } => body_side == side,
        };
        let is_one_side = || self.body_sides().any(|side| on(side, a) && on(side, b));
        is_alike(self.frame_here(a, at).n, self.frame_here(b, at).n)
            && (self.is_in_line(a, b) || is_one_side())
    }
}

/// Two normals at an angle of at most 2^-10.
pub(super) fn is_alike<R: Real>(a: Vec2<R>, b: Vec2<R>) -> bool {
    a.dot(b) >= R::HALF && a.cross(b).abs() <= R::one_line()
}
