//! Obstacles on a window of a search: each is apart from the body along one axis, that of a contact first; and the ends of the sides on which
//! contacts slide (R36, R39).

use super::Obstacle;
use super::axes::{At, Axis, Normal, speed};
use crate::bounds::Bound;
use crate::contact::Feature;
use crate::events::{Ending, Judging};
use crate::found::Found;
use crate::geometry::Vec2;
use crate::judge::Track;
use crate::motion::{Instant, Kind, Motion};
use crate::real::Real;
use crate::search::{Ended, Run, WindowEnd};
use crate::state::Body;
use crate::thresholds::Thresholds;
use crate::values::Value;
use crate::world::Statics;

/// What a window did with an obstacle: how far it is at the end, or what is touched where the window begins.
pub(super) type Left<R> = Result<R, Feature>;

impl<R: Real> Instant<R> {
    /// Where the body is.
    pub(crate) fn at(&self) -> At<R> {
        At {
            rotation: self.rotation,
            g: self.g,
        }
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// What a place is known to, and its gaps: it follows from the hand, which is as far as the load is large, and from u, where E is zero to
    /// its rounding. On half-planes a gap that was missed is closed later; a thin wall has two sides.
    pub(crate) fn rounding_at(&self, i: &Instant<R>) -> R {
        if !self.world.has_obstacles() {
            return R::ZERO;
        }
        let little = R::of_balance(i.force.length_bound());
        // A line has no balance.
        if i.e_u == R::ZERO {
            little
        } else {
            little + little / i.e_u.abs()
        }
    }
    /// The bound of the second derivative of a gap along an axis, with the lever of what it compares at the end of a window.
    fn bend_along(&self, m: &Motion<R>, i: &Instant<R>, b: &Bound<R>, axis: &Axis<R>, k: u8) -> R {
        let lever = self.lever(axis, k, i.at());
        if !axis.turns() {
            return self.gap_bound(m, b, lever - i.r);
        }
        self.corner_bound(m, b, lever - i.r)
    }
    /// The room that a window leaves before an obstacle, by its end alone; none if it may be touched.
    pub(crate) fn room_before(
        &self,
        body: &Body<R>,
        m: &Motion<R>,
        i: &Instant<R>,
        b: &Bound<R>,
        index: u8,
    ) -> Option<R> {
        let (o, at) = (self.obstacle(index), i.at());
        let axis = match self.own_axis(body, index) {
            Some(normal) => self.axis(&o, normal, at),
            None => {
                if let Some(room) = self.out_of_reach(body, &o, i.g, b) {
                    return Some(room);
                }
                self.widest(&o, at)?.axis
            }
        };
        let was = body.at();
        let before = self.axis(&o, axis.normal, was);
        let mut room = R::HUGE;
        for k in self.compared(&o, &axis) {
            if let Some(feature) = self.feature(&axis, k)
                && self.holds(&body.contacts, feature)
            {
                continue;
            }
            let gap = self.gap_along(&axis, self.lever(&axis, k, at), at);
            let begin = self.gap_along(&before, self.lever(&before, k, was), was);
            let least = self.bend_along(m, i, b, &axis, k).halved();
            if gap <= least + R::TOUCH || begin < R::ZERO {
                return None;
            }
            room = room.min(self.room_of(&axis, k, at, gap));
        }
        Some(room)
    }
    /// The path of the body up to which a gap remains open. What moves with the body comes nearer to a corner beyond it by the path of a
    /// vertex and the turn at the distance from there; the turn is at most twice the path, since one end of the body is at half its size from
    /// where it turns, or farther.
    fn room_of(&self, axis: &Axis<R>, k: u8, at: At<R>, gap: R) -> R {
        match axis.normal {
            Normal::Side(_) | Normal::Wall(_) => gap,
            Normal::Body(vertex) | Normal::Rod(vertex) => {
                let lever = self.lever(axis, k, at) - at.rotation.apply(self.vertex(vertex));
                gap / (R::ONE + lever.length_bound().doubled())
            }
        }
    }
    /// The axis of a contact with an obstacle. Its line may go on in sides of other obstacles (R35), so the body may be far from the obstacle.
    fn own_axis(&self, body: &Body<R>, index: u8) -> Option<Normal> {
        let own = body
            .contacts
            .iter()
            .filter(|&c| self.obstacle_of(c) == Some(index));
        own.last().and_then(|c| self.normal_of(c))
    }
    /// The room before an obstacle that the body does not touch, if it needs no axis: it is farther away than a window leads, or behind the side
    /// of a contact, and so as far as that side lets the body come.
    fn out_of_reach(&self, body: &Body<R>, o: &Obstacle<R>, g: Vec2<R>, b: &Bound<R>) -> Option<R> {
        let far = self.distance_bound(o, g);
        if far > b.way.doubled() {
            return Some(far);
        }
        let is_behind = body.contacts.iter().any(|c| match c.feature {
            Feature::Vertex { side, .. } => self.is_behind(o, side),
            Feature::Corner { .. } => false,
        });
        is_behind.then_some(R::HUGE)
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Run<'_, R, V, S, C> {
    /// All obstacles; the least gap of those that are apart.
    pub(crate) fn judge_obstacles(
        &mut self,
        on: &Judging<R>,
        room: &mut R,
        found: &mut Found<R>,
    ) -> Option<Ended<R>> {
        let statics = self.watched.statics;
        for (index, o) in statics.obstacles() {
            let body = self.watched.body;
            let left = match statics.own_axis(body, index) {
                Some(normal) => self.judge_own(on, found, &o, normal),
                None => match statics.out_of_reach(body, &o, self.hi.instant.g, &on.bound) {
                    Some(room) => Ok(room),
                    None => self.judge_other(on, found, &o),
                },
            };
            match left {
                Ok(gap) => *room = room.min(gap),
                Err(feature) => return Some(self.ended_low(Ending::Touch(feature), R::ZERO)),
            }
        }
        None
    }
    /// The gap along an axis at an end of the window.
    pub(super) fn value_along(
        &self,
        o: &Obstacle<R>,
        normal: Normal,
        k: u8,
        end: &WindowEnd<R>,
    ) -> Value<R> {
        let (statics, at) = (self.watched.statics, end.instant.at());
        let axis = statics.axis(o, normal, at);
        let lever = statics.lever(&axis, k, at);
        Value {
            v: statics.gap_along(&axis, lever, at),
            d: axis.n.dot(end.rates.g + lever.turned() * end.rates.theta),
        }
    }
    pub(super) fn bend(&self, on: &Judging<R>, axis: &Axis<R>, k: u8) -> R {
        self.watched
            .statics
            .bend_along(self.watched.motion, &self.hi.instant, &on.bound, axis, k)
    }
    pub(super) fn is_held(&self, axis: &Axis<R>, k: u8) -> bool {
        let (statics, contacts) = (self.watched.statics, &self.watched.body.contacts);
        statics
            .feature(axis, k)
            .is_some_and(|feature| statics.holds(contacts, feature))
    }
    /// An obstacle that is in contact: what else its axis compares is touched where the body comes to lie flat.
    fn judge_own(
        &mut self,
        on: &Judging<R>,
        found: &mut Found<R>,
        o: &Obstacle<R>,
        normal: Normal,
    ) -> Left<R> {
        let (statics, motion) = (self.watched.statics, self.watched.motion);
        let [first, second] = motion.contacts;
        // Along one line nothing comes nearer.
        if motion.kind == Kind::Pair && statics.is_in_line(first, second) {
            return Ok(R::HUGE);
        }
        self.know_low();
        let at = self.hi.instant.at();
        let axis = statics.axis(o, normal, at);
        let still = R::zero() * speed(&self.lo.rates);
        let mut room = R::HUGE;
        for k in statics.compared(o, &axis) {
            let Some(feature) = statics.feature(&axis, k) else {
                continue;
            };
            if statics.holds(&self.watched.body.contacts, feature) {
                continue;
            }
            let begin = self.value_along(o, normal, k, self.lo);
            let end = self.value_along(o, normal, k, self.hi);
            room = room.min(statics.room_of(&axis, k, at, end.v.max(R::ZERO)));
            let bend = self.bend(on, &axis, k);
            if end.v > R::zero().max(bend.halved()) {
                continue;
            }
            // In one line with contacts: flat as far as the motion keeps it so.
            let is_closed = begin.v <= R::zero();
            if is_closed && end.v >= -R::zero() && begin.d >= -still && bend <= R::zero() {
                continue;
            }
            let is_first = self.bracket.certain == R::ZERO;
            if is_first && is_closed && end.v < begin.v.max(R::ZERO) && begin.d < R::ZERO {
                return Err(feature);
            }
            self.judge(
                found,
                &Track::gap(Ending::Touch(feature), [begin, end], bend),
            );
        }
        Ok(room)
    }
}
