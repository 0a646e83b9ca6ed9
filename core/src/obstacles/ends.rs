//! The ends of sides: where a foot may be, which contact supports, and to which one is handed on that leaves its side (R37, R39).

use super::Corner;
use super::axes::At;
use crate::contact::{Contact, Feature, Sense};
use crate::errand::Next;
use crate::event::Event;
use crate::geometry::Vec2;
use crate::real::Real;
use crate::step::Step;
use crate::thresholds::Thresholds;
use crate::world::Statics;

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// Where the foot of a contact may be along its tangent; a half-plane has no ends.
    pub(crate) fn ends(&self, contact: Contact) -> [R; 2] {
        match contact.feature {
            Feature::Vertex { side, .. } => match self.corner_of_side(side) {
                Some(corner) => self.corner(corner).ends,
                None => [R::LEAST, R::HUGE],
            },
            Feature::Corner { body_side, .. } => {
                let n = self.inward(body_side);
                let t = Vec2::new(n.y, -n.x);
                let [a, b] =
                    [body_side, self.next_vertex(body_side)].map(|k| -t.dot(self.vertex(k)));
                [a.min(b), a.max(b)]
            }
        }
    }
    /// A foot has not left its side by a touch; before that it is handed on nowhere.
    pub(crate) fn is_short_of_end(&self, contact: Contact, foot: R) -> bool {
        if C == 0 {
            return true;
        }
        let [a, b] = self.ends(contact);
        foot > a - R::TOUCH && foot < b + R::TOUCH
    }
    /// The foot of a contact is on its finite side, up to half a touch beyond, and it supports.
    pub(crate) fn is_on_side(&self, contact: Contact, at: At<R>) -> bool {
        let (xi, [a, b]) = (self.foot_of(contact, at.rotation, at.g), self.ends(contact));
        let is_within = xi >= a - R::TOUCH.halved() && xi <= b + R::TOUCH.halved();
        let is_covered = match contact.feature {
            Feature::Vertex { .. } => false,
            Feature::Corner { corner, .. } => self.corner(corner).covered,
        };
        is_within && !is_covered && self.supports(contact, at)
    }
    /// Neither of the neighbours of what touches reaches through the line of the contact.
    pub(crate) fn supports(&self, contact: Contact, at: At<R>) -> bool {
        let n = self.frame_here(contact, at).n;
        let is_beside = |way: Vec2<R>| n.dot(way) >= -R::beside();
        match contact.feature {
            Feature::Vertex { vertex, .. } => {
                let v = self.vertex(vertex);
                let to = |k: u8| at.rotation.apply(self.vertex(k) - v);
                is_beside(to(self.next_vertex(vertex))) && is_beside(to(self.vertex_before(vertex)))
            }
            Feature::Corner { corner, .. } => self.corners_at(corner).all(|(corner, own)| {
                let o = self.obstacle(own.obstacle);
                let k = corner.saturating_sub(o.from);
                let from = |k: u8| own.place - self.corner(o.corner(k)).place;
                let before = k.saturating_add(o.count).saturating_sub(1);
                is_beside(from(k.saturating_add(1))) && is_beside(from(before))
            }),
        }
    }

    /// The contact to which one is handed on that leaves its side in a sense along its tangent: where a vertex and a corner are at one place.
    pub(crate) fn handed_on(&self, contact: Contact, sense: Sense, at: At<R>) -> Option<Contact> {
        let place = self.point(contact, at);
        let (vertex, corner) = match contact.feature {
            Feature::Corner { corner, body_side } => {
                let next = self.next_vertex(body_side);
                let way = |k: u8| (at.g + at.rotation.apply(self.vertex(k)) - place).length_bound();
                let vertex = if way(body_side) < way(next) {
                    body_side
                } else {
                    next
                };
                (vertex, corner)
            }
            Feature::Vertex { vertex, side } => {
                self.corner_of_side(side)?;
                if let Some(side) = self.goes_on(contact, side, sense, at) {
                    return Some(Contact::at(Feature::Vertex { vertex, side }));
                }
                (vertex, self.corner_near(place)?)
            }
        };
        // Clockwise around the obstacles there along t: the side of an obstacle that follows, the side of the body that trails.
        let of_obstacles = self.sides_after(corner, sense);
        let of_obstacles = of_obstacles.map(|side| Feature::Vertex { vertex, side });
        let body_side = if sense == Sense::Plus {
            self.vertex_before(vertex)
        } else {
            vertex
        };
        let of_body =
            (!self.body_sides().is_empty()).then_some(Feature::Corner { corner, body_side });
        let n = self.frame_here(contact, at).n;
        let mut best: Option<(R, Contact)> = None;
        for feature in of_obstacles.chain(of_body) {
            let next = Contact::at(feature);
            if feature == contact.feature {
                continue;
            }
            let m = self.frame_here(next, at).n;
            // The angle by which the normal turns forwards, as 1 - cos, or beyond half a turn.
            let (sine, cosine) = (sense.along(m.cross(n)), m.dot(n));
            let angle = if sine < -R::TOUCH {
                R::from_int(3) + cosine
            } else {
                R::ONE - cosine
            };
            if best.is_none_or(|(least, _)| angle < least) {
                best = Some((angle, next));
            }
        }
        best.map(|(_, next)| next)
    }
    /// All corners at the place of one, with their indices.
    pub(crate) fn corners_at(&self, corner: u8) -> impl Iterator<Item = (u8, &Corner<R>)> {
        let first = self.corner(corner).first;
        let all = (0_u8..).zip(&self.world.corners);
        all.filter(move |(_, other)| other.first == first)
    }
    /// The sides that begin at the place of a corner, of all obstacles that have one there, along t in a sense.
    fn sides_after(&self, corner: u8, sense: Sense) -> impl Iterator<Item = u8> {
        self.corners_at(corner).filter_map(move |(k, other)| {
            let o = self.obstacle(other.obstacle);
            let before = k.saturating_sub(o.from).saturating_add(o.count);
            let side = if sense == Sense::Plus {
                o.corner(before.saturating_sub(1))
            } else {
                k
            };
            let is_side = o.has_sides() && !self.corner(side).hidden;
            is_side.then(|| self.side_at(side))
        })
    }
    /// In the line of a side another one goes on where a foot leaves it.
    fn goes_on(&self, contact: Contact, side: u8, sense: Sense, at: At<R>) -> Option<u8> {
        let xi = self.foot_of(contact, at.rotation, at.g) + sense.along(R::MICRO);
        let own = self.corner(self.corner_of_side(side)?);
        let mut all = self.world.corners.iter();
        let next = all.find(|corner| {
            let [a, b] = corner.ends;
            corner.line == own.line && corner.one != own.one && xi >= a && xi <= b
        });
        next.map(|corner| corner.one)
    }
    /// The corner at a place, of any obstacle; none where it is covered: what covers it is touched there.
    fn corner_near(&self, place: Vec2<R>) -> Option<u8> {
        let mut best: Option<(R, u8)> = None;
        for corner in self.world.corners.iter().filter(|corner| !corner.covered) {
            let way = (corner.place - place).length_bound();
            if way <= R::beside() && best.is_none_or(|(least, _)| way < least) {
                best = Some((way, corner.first));
            }
        }
        best.map(|(_, corner)| corner)
    }
    /// Beyond which end of its side a contact is nearest to be.
    pub(crate) fn beyond(&self, contact: Contact, at: At<R>) -> Sense {
        let (xi, [a, b]) = (self.foot_of(contact, at.rotation, at.g), self.ends(contact));
        Sense::of(xi - a - (b - xi))
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Step<'_, R, V, S, C> {
    /// A contact leaves its side in a sense: it is handed on, in one line to where what touches ends now. Returns whether the load on it has
    /// changed.
    pub(crate) fn hand_on(&mut self, k: usize, sense: Sense) -> bool {
        if C == 0 {
            return false;
        }
        let (at, statics) = (self.body.at(), self.statics);
        let left = self.body.contacts.get(k);
        self.body.forget();
        let next = statics.handed_on(left, sense, at);
        let n = statics.frame_here(left, at).n;
        let is_turned = next.is_none_or(|next| {
            let m = statics.frame_here(next, at).n;
            m.cross(n).abs() > R::ahead() || m.dot(n) < R::ZERO
        });
        if is_turned {
            // Where others lie in the same line it ends there now, with the outermost on that side.
            let flat = statics.flat(left, at, R::TOUCH.doubled());
            let way = |c: Contact| (statics.point(c, at) - statics.point(left, at)).length_bound();
            let nearer = |a: Contact, b: Contact| if way(b) < way(a) { b } else { a };
            let ends = flat.into_iter().flatten();
            let others = ends.filter(|end| !self.body.contacts.contains(end.feature));
            if let Some(end) = others.reduce(nearer) {
                self.replace(k, end.with(left.sense));
                return false;
            }
        }
        let Some(next) = next else {
            self.let_go(k);
            return true;
        };
        let ends_here = |c: Contact| {
            let way = statics.point(c, at) - statics.point(left, at);
            c.feature != left.feature
                && statics.is_in_line(c, left)
                && way.length_bound() <= R::beside()
        };
        let other = self.body.contacts.iter().position(ends_here);
        self.replace(k, next.with(left.sense));
        if is_turned {
            self.statics.stay_in_front(self.body, at);
            if let Some(other) = other {
                // Both ends of what lay in one line are here: the line is left.
                self.let_go(other);
            }
        }
        // On ground of another friction the slide is not in balance.
        is_turned || statics.friction(left) != statics.friction(next)
    }
    /// A contact becomes another one at its place.
    fn replace(&mut self, k: usize, contact: Contact) {
        self.body.contacts.replace(k, contact);
        self.statics.find_foot(self.body);
        self.statics.seat(self.body);
    }
    /// A contact opens.
    fn let_go(&mut self, k: usize) {
        let before = self.statics.kind(&self.body.contacts);
        if self.body.contacts.len() == 1 {
            self.log.event(Event::Lift);
            return self.lift();
        }
        self.body.contacts.remove(k);
        self.statics.find_foot(self.body);
        let after = self.statics.kind(&self.body.contacts);
        self.log.open(before, after);
    }
    /// What follows where a contact was handed on at the frozen hand: it slips on if it is pressed, otherwise the body is free.
    pub(crate) fn handed(&mut self, sense: Sense) -> Next {
        if self.body.contacts.len() == 1 {
            let [normal, _] = self.statics.reaction(self.body);
            if normal <= R::ZERO {
                self.log.event(Event::Lift);
                self.lift();
            }
        }
        if self.body.contacts.is_empty() {
            Next::Relax(Sense::Rests)
        } else {
            Next::Relax(sense)
        }
    }
    /// On the hand's path a contact that slides leaves its side.
    pub(crate) fn leaves_side(&mut self, k: usize) {
        let sense = self.body.contacts.get(k).sense;
        if self.hand_on(k, sense) {
            let next = self.handed(self.body.contacts.first().sense);
            self.errand.settle(next);
        }
    }
}
