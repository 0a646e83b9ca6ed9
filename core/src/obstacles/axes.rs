//! Axes along which a body and an obstacle may be apart: the outward normals of both, and the directions in which a thin wall or a rod ends
//! (R36).

use super::Obstacle;
use crate::contact::{Contact, Feature};
use crate::geometry::{Rotation, Vec2};
use crate::motion::Rates;
use crate::real::Real;
use crate::state::Body;
use crate::thresholds::Thresholds;
use crate::world::Statics;

/// What an axis is normal to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Normal {
    /// The side of the obstacle that begins at a corner.
    Side(u8),
    /// A side of the body.
    Body(u8),
    /// The end of a thin wall at a corner.
    Wall(u8),
    /// The end of a rod at a vertex.
    Rod(u8),
}

/// Where a body is: R, and the holding point G.
#[derive(Clone, Copy, Debug)]
pub(crate) struct At<R> {
    pub(crate) rotation: Rotation<R>,
    pub(crate) g: Vec2<R>,
}

/// An axis with the body in a place: n towards the body, and the level of the shape that it is fixed to. The gap of a vertex of the body is
/// n·(G + R a) - level; if the axis turns with the body, that of a corner c is level - n·(c - G).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis<R> {
    pub(crate) normal: Normal,
    pub(crate) n: Vec2<R>,
    level: R,
}

/// The least gap along an axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Widest<R> {
    pub(crate) axis: Axis<R>,
    pub(crate) gap: R,
}

/// The axis whose gap closes most slowly: of all, and the contact that this makes, with its rate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slowest<R> {
    pub(crate) axis: Axis<R>,
    pub(crate) rate: R,
    /// What touches, by an axis that can make a contact.
    pub(crate) contact: Option<(Feature, R)>,
}

impl<R: Real> Axis<R> {
    /// It is fixed to the body: corners are compared.
    pub(crate) fn turns(&self) -> bool {
        match self.normal {
            Normal::Side(_) | Normal::Wall(_) => false,
            Normal::Body(_) | Normal::Rod(_) => true,
        }
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// All axes of the body and an obstacle.
    pub(crate) fn axes(&self, o: &Obstacle<R>, at: At<R>) -> impl Iterator<Item = Axis<R>> {
        let sides = if o.has_sides() { o.corners() } else { 0..0 };
        let ends = if o.count == 2 { o.corners() } else { 0..0 };
        let rod = if self.world.vertices.len() == 2 {
            0..2
        } else {
            0..0
        };
        let own = sides
            .map(Normal::Side)
            .chain(self.body_sides().map(Normal::Body));
        let ends = ends.map(Normal::Wall).chain(rod.map(Normal::Rod));
        own.chain(ends).map(move |normal| self.axis(o, normal, at))
    }
    /// An axis with the body in a place.
    pub(crate) fn axis(&self, o: &Obstacle<R>, normal: Normal, at: At<R>) -> Axis<R> {
        let (n, level) = match normal {
            Normal::Side(corner) => {
                let side = self.corner(corner).side;
                (side.normal, side.offset)
            }
            Normal::Wall(corner) => {
                let end = self.corner(corner);
                // The side that begins here runs against its tangent.
                let n = if corner == o.from {
                    end.side.tangent
                } else {
                    -self.corner(o.from).side.tangent
                };
                (n, n.dot(end.place))
            }
            Normal::Body(side) => {
                let n = self.inward(side);
                (at.rotation.apply(n), n.dot(self.vertex(side)))
            }
            Normal::Rod(vertex) => {
                let n = self.inward(0);
                let along = Vec2::new(n.y, -n.x);
                // Against the first side's direction at its beginning; towards the body.
                let n = if vertex == 0 { along } else { -along };
                (at.rotation.apply(n), n.dot(self.vertex(vertex)))
            }
        };
        Axis { normal, n, level }
    }
    /// What an axis compares, in its place: vertices of the body, or corners of the obstacle.
    pub(crate) fn compared(&self, o: &Obstacle<R>, axis: &Axis<R>) -> core::ops::Range<u8> {
        if axis.turns() {
            o.corners()
        } else {
            0..u8::try_from(self.world.vertices.len()).unwrap_or(u8::MAX)
        }
    }
    /// The lever from the holding point to what an axis compares.
    pub(crate) fn lever(&self, axis: &Axis<R>, k: u8, at: At<R>) -> Vec2<R> {
        if axis.turns() {
            self.corner(k).place - at.g
        } else {
            at.rotation.apply(self.vertex(k))
        }
    }
    /// The gap of what an axis compares, by its lever.
    pub(crate) fn gap_along(&self, axis: &Axis<R>, lever: Vec2<R>, at: At<R>) -> R {
        if axis.turns() {
            axis.level - axis.n.dot(lever)
        } else {
            axis.n.dot(at.g + lever) - axis.level
        }
    }
    /// The contact that it would make; the ends of walls and rods make none, nor does a side with another obstacle before it.
    pub(crate) fn feature(&self, axis: &Axis<R>, k: u8) -> Option<Feature> {
        match axis.normal {
            Normal::Side(corner) => (!self.corner(corner).hidden).then(|| Feature::Vertex {
                vertex: k,
                side: self.side_at(corner),
            }),
            Normal::Body(body_side) => Some(Feature::Corner {
                corner: self.corner(k).first,
                body_side,
            }),
            Normal::Wall(_) | Normal::Rod(_) => None,
        }
    }
    /// The axis of a contact with an obstacle.
    pub(crate) fn normal_of(&self, contact: Contact) -> Option<Normal> {
        match contact.feature {
            Feature::Vertex { side, .. } => self.corner_of_side(side).map(Normal::Side),
            Feature::Corner { body_side, .. } => Some(Normal::Body(body_side)),
        }
    }
    /// The least gap along an axis.
    pub(crate) fn along(&self, o: &Obstacle<R>, axis: Axis<R>, at: At<R>) -> Widest<R> {
        let gaps = self
            .compared(o, &axis)
            .map(|k| self.gap_along(&axis, self.lever(&axis, k, at), at));
        let gap = gaps.fold(R::HUGE, R::min);
        Widest { axis, gap }
    }
    /// The axis with the largest gap; none of a point and a pin.
    pub(crate) fn widest(&self, o: &Obstacle<R>, at: At<R>) -> Option<Widest<R>> {
        let all = self.axes(o, at).map(|axis| self.along(o, axis, at));
        all.reduce(|best, next| if next.gap > best.gap { next } else { best })
    }
    /// A lower bound of the distance from an obstacle, by its circle.
    pub(crate) fn distance_bound(&self, o: &Obstacle<R>, g: Vec2<R>) -> R {
        let way = o.middle - g;
        way.x.abs().max(way.y.abs()) - o.radius - self.grip.size
    }
    /// Body and obstacle are a point, a rod, a pin or a wall.
    pub(crate) fn are_thin(&self, o: &Obstacle<R>) -> bool {
        self.world.vertices.len() < 3 && o.count < 3
    }
    /// How far behind an axis counts as a step that is none: 2^-19 L; of a thin body and a thin obstacle nothing, since both sides of a wall
    /// are nearer to each other.
    pub(crate) fn step_behind(&self, o: &Obstacle<R>) -> R {
        if self.are_thin(o) {
            R::zero()
        } else {
            R::MICRO
        }
    }
    /// At a place where they touch: the axis whose gap closes most slowly, of those with a gap of at least -`step`, now and before; of two
    /// thin shapes only those in front of which the body was. Rates before levels.
    pub(crate) fn slowest(
        &self,
        o: &Obstacle<R>,
        body: &Body<R>,
        [before, at]: [At<R>; 2],
        rates: &Rates<R>,
        step: R,
    ) -> Option<Slowest<R>> {
        let little = R::zero() * speed(rates);
        let is_thin = self.are_thin(o);
        let behind = if is_thin { self.step_behind(o) } else { step };
        let mut best: Option<Slowest<R>> = None;
        for axis in self.axes(o, at) {
            let holds = self.holds_in_front(o, body, &axis, at);
            let along = |place| self.along(o, self.axis(o, axis.normal, place), place);
            let was_in_front = holds.unwrap_or_else(|| {
                let (mut from, mut then) = (before, along(before));
                if is_thin && then.gap.abs() <= R::in_front().halved() {
                    from = body.in_front();
                    then = along(from);
                }
                let is_closed = || then.gap >= -behind && !self.is_pinched(o, &then.axis, from);
                then.gap > R::zero() || is_closed()
            });
            let is_behind = self.along(o, axis, at).gap < -step;
            if !was_in_front || is_behind || self.is_hollow(o, &axis, at) {
                continue;
            }
            let Some((rate, feature)) = self.closing(o, &axis, at, rates) else {
                continue;
            };
            let contact = feature.map(|feature| (feature, rate));
            let Some(best) = &mut best else {
                best = Some(Slowest {
                    axis,
                    rate,
                    contact,
                });
                continue;
            };
            if rate > best.rate + little {
                (best.axis, best.rate) = (axis, rate);
            }
            if let Some((_, of_best)) = best.contact {
                if contact.is_some() && rate > of_best + little {
                    best.contact = contact;
                }
            } else {
                best.contact = contact;
            }
        }
        best
    }
    /// Of a point or rod with a contact at a corner of an obstacle at which another one goes on, its normal along an axis: the body is in front
    /// of the axis, or behind, and the axis keeps nothing apart. Where it is closed, gaps do not say so.
    pub(crate) fn holds_in_front(
        &self,
        o: &Obstacle<R>,
        body: &Body<R>,
        axis: &Axis<R>,
        at: At<R>,
    ) -> Option<bool> {
        if self.world.vertices.len() > 2 {
            return None;
        }
        body.contacts.iter().find_map(|contact| {
            let (place, n) = (self.point(contact, at), self.frame_here(contact, at).n);
            let is_here = |k: u8| {
                let way = self.corner(k).place - place;
                way.length_bound() <= R::MICRO && self.is_joined(k)
            };
            let is_along = n.cross(axis.n).abs() <= R::one_line() && o.corners().any(is_here);
            is_along.then(|| n.dot(axis.n) > R::ZERO)
        })
    }
    /// Along an axis that is closed what keeps apart is a corner at which another obstacle goes on: nothing passes between them, however thin
    /// it is.
    pub(super) fn is_pinched(&self, o: &Obstacle<R>, axis: &Axis<R>, at: At<R>) -> bool {
        match axis.normal {
            Normal::Side(_) => false,
            Normal::Wall(corner) => self.is_joined(corner),
            Normal::Body(_) | Normal::Rod(_) => {
                let is_closed = |k: u8| {
                    let gap = self.gap_along(axis, self.lever(axis, k, at), at);
                    gap <= R::zero() && self.is_joined(k)
                };
                self.are_thin(o) && o.corners().any(is_closed)
            }
        }
    }
    /// At a corner another obstacle goes on.
    pub(super) fn is_joined(&self, corner: u8) -> bool {
        self.corner(corner).covered || self.corners_at(corner).count() > 1
    }
    /// What closes along a side of the body is a corner in the hollow between two walls: there the walls are touched.
    fn is_hollow(&self, o: &Obstacle<R>, axis: &Axis<R>, at: At<R>) -> bool {
        let Normal::Body(body_side) = axis.normal else {
            return false;
        };
        o.corners().any(|corner| {
            let gap = self.gap_along(axis, self.lever(axis, corner, at), at);
            let contact = Contact::at(Feature::Corner { corner, body_side });
            gap <= R::zero() && self.is_joined(corner) && !self.supports(contact, at)
        })
    }
    /// Of what is closed along an axis what closes fastest: its rate, and the contact that it makes, on its side if there is one.
    fn closing(
        &self,
        o: &Obstacle<R>,
        axis: &Axis<R>,
        at: At<R>,
        rates: &Rates<R>,
    ) -> Option<(R, Option<Feature>)> {
        let mut least: Option<(R, Option<Feature>)> = None;
        let mut on: Option<(R, Feature)> = None;
        for k in self.compared(o, axis) {
            let lever = self.lever(axis, k, at);
            if self.gap_along(axis, lever, at) > R::zero() {
                continue;
            }
            let rate = axis.n.dot(rates.g + lever.turned() * rates.theta);
            let feature = self.feature(axis, k);
            if least.is_none_or(|(of_least, _)| rate < of_least) {
                least = Some((rate, feature));
            }
            let Some(feature) = feature else { continue };
            let is_first = on.is_none_or(|(of_on, _)| rate < of_on);
            if is_first && self.is_on_side(Contact::at(feature), at) {
                on = Some((rate, feature));
            }
        }
        let (rate, feature) = least?;
        Some((rate, on.map(|(_, feature)| feature).or(feature)))
    }
    /// An obstacle lies behind the line of a side.
    pub(crate) fn is_behind(&self, o: &Obstacle<R>, side: u8) -> bool {
        let side = self.side(side);
        let behind = |k: u8| side.normal.dot(self.corner(k).place) - side.offset <= R::MICRO;
        o.corners().all(behind)
    }
}

/// The size of a velocity: of the holding point, and of a turn at a lever of one body size.
pub(crate) fn speed<R: Real>(rates: &Rates<R>) -> R {
    rates.g.length_bound() + rates.theta.abs()
}
