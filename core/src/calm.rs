//! Calm frames: the balance at their end proves that nothing happens before; and calm places, where friction gives way or a slip ends within
//! one window (STATICS 7).

use crate::bounds::{Bound, Pace};
use crate::contact::{Feature, Sense};
use crate::geometry::Vec2;
use crate::motion::{Factor, Instant, Kind, Motion, Spot};
use crate::real::Real;
use crate::state::{Body, HandPose};
use crate::thresholds::Thresholds;
use crate::window::Residual;
use crate::world::Statics;

/// What is known of a frame by its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Calm {
    /// Nothing happens; the body has followed the hand.
    End,
    /// Friction gives way on this side; the body has followed the hand so far.
    Yields(Sense),
    /// It has not moved.
    Unsure,
}

/// Where an event function q·F is known to be zero.
struct Zero<R> {
    p: R,
    /// How fast it falls there, per p.
    fall: R,
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The body along the hand's displacement, if nothing happens before its end, or friction gives way.
    #[inline(always)]
    pub(crate) fn follows_calmly(&self, body: &mut Body<R>, to: &HandPose<R>) -> Calm {
        match body.contacts.as_slice() {
            [] => self.flies_calmly(body, to),
            [only] if self.turns(*only) => Calm::Unsure,
            [only] if only.sense.slides() => self.slides_calmly(body, to),
            [_] => self.turns_calmly(body, to),
            [first, _] if first.sense.slides() && self.is_edge(&body.contacts) => {
                self.edge_slides_calmly(body, to)
            }
            [_, _, ..] => Calm::Unsure,
        }
    }
    /// A body without contact.
    #[inline(never)]
    fn flies_calmly(&self, body: &mut Body<R>, to: &HandPose<R>) -> Calm {
        let way = body.hand.to(to);
        let m = Motion::new(Kind::Free, body, way.per_p).to(*to, way.whole);
        let end = if self.world.weight == R::ZERO && !self.grip.swings {
            // The angle is the hand's.
            let (mut i, turn) = (Instant::ZERO, (to.angle - body.angle).abs());
            let (u, p) = (to.angle, way.whole);
            self.place(&m, Spot { u, p }, None, &mut i);
            let bound = self.bound(&m, &i, &Pace::linear(turn, p), None);
            Some((i, bound))
        } else {
            self.calm_end(body, &m, way.whole)
        };
        match end {
            Some((i, bound)) => self.arrives(body, to, (&m, &i), &bound),
            None => Calm::Unsure,
        }
    }
    /// A body about a contact that sticks.
    #[inline(never)]
    fn turns_calmly(&self, body: &mut Body<R>, to: &HandPose<R>) -> Calm {
        let way = body.hand.to(to);
        let m = Motion::new(Kind::Pin, body, way.per_p).to(*to, way.whole);
        let Some((i, bound)) = self.calm_end(body, &m, way.whole) else {
            return Calm::Unsure;
        };
        let friction = self.friction(m.first());
        let frame = self.frame_inlined(m.first(), i.rotation, i.g);
        let (n, pull) = (-frame.n.dot(i.force), frame.t.dot(i.force));
        let cone = friction.cone(body.stiction);
        let half = bound.holding.halved();
        let margin = n * cone.sin - pull.abs() * cone.cos;
        let may_press = !body.stiction && friction.threshold - n < half;
        if n < half || may_press {
            return Calm::Unsure;
        }
        if margin < R::ZERO {
            return self.yields_calmly(body, to, Sense::of(pull), (&{ i }, &{ bound }));
        }
        if margin < half {
            return Calm::Unsure;
        }
        self.arrives(body, to, (&m, &i), &bound)
    }
    /// A contact that slides.
    #[inline(never)]
    fn slides_calmly(&self, body: &mut Body<R>, to: &HandPose<R>) -> Calm {
        let way = body.hand.to(to);
        let m = self.sliding(body, way.per_p).to(*to, way.whole);
        if matches!(m.factor, Factor::Normal(_)) {
            return Calm::Unsure;
        }
        let Some((i, bound)) = self.calm_end(body, &m, way.whole) else {
            return Calm::Unsure;
        };
        let friction = self.friction(m.first());
        let n = -self
            .frame_inlined(m.first(), i.rotation, i.g)
            .n
            .dot(i.force);
        let half = bound.holding.halved();
        let advance = i.xi_p - i.xi_u * i.e_p / i.e_u;
        let [_, xi2] = bound.foot;
        let may_press = friction.threshold - n < half;
        let may_halt = m.first().sense.along(advance) * way.whole < xi2;
        if n < half || may_press || may_halt || !self.is_short_of_end(m.first(), i.foot) {
            return Calm::Unsure;
        }
        self.arrives(body, to, (&m, &i), &bound)
    }

    /// An edge that slides.
    #[inline(never)]
    fn edge_slides_calmly(&self, body: &mut Body<R>, to: &HandPose<R>) -> Calm {
        if !self.has_pairs() {
            return Calm::Unsure;
        }
        let first = body.contacts.first();
        let n = self.frame(first, body.rotation, body.holding).n;
        let friction = self.friction(first);
        let may_press = |hand: &HandPose<R>| {
            let load = self.load(body, hand);
            friction.threshold + n.dot(load.force) < R::of_balance(load.size())
        };
        let may_press = may_press(&body.hand) || may_press(to);
        if may_press || !self.slides_straight(body, first.sense, to) {
            return Calm::Unsure;
        }
        body.hand = *to;
        Calm::End
    }

    /// The balance at the end of a displacement of a motion in the angle, with the bounds of the window in between, if that is certified.
    // Compiled once for a page, which is loaded over a line: there few bytes count more than few instructions. So is what it is made of.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn calm_end(&self, body: &Body<R>, m: &Motion<R>, p: R) -> Option<(Instant<R>, Bound<R>)> {
        let mut i = Instant::ZERO;
        let u = body.angle;
        self.place_inlined(m, Spot { u, p }, Some(body.rotation), &mut i);
        let pace = self
            .certified_inlined(m, &i, self.residual_after(m, &i, p), &mut None)
            .ok()?;
        let u = u + self.first_step(m, &i);
        self.place_inlined(m, Spot { u, p }, None, &mut i);
        let step = -i.e / i.e_u;
        if R::is_last(step) {
            self.nudge(m, &mut i, step);
        } else {
            // A copy, and the motion made again, so that what mostly happens needs neither in memory.
            let mut on = i;
            let again = Motion {
                factor: m.factor,
                ..Motion::new(m.kind, body, m.hand_p).to(m.hand, m.whole)
            };
            self.balance(&again, Spot { u, p }, step, &mut on);
            i = on;
        }
        let bound = self.bound_inlined(m, &i, &pace);
        Some((i, bound))
    }
    /// Nothing else happens: the body goes to the end, unless a gap may close.
    #[inline(always)]
    fn arrives(
        &self,
        body: &mut Body<R>,
        to: &HandPose<R>,
        (m, i): (&Motion<R>, &Instant<R>),
        bound: &Bound<R>,
    ) -> Calm {
        let mut room = body.room - bound.way;
        if room <= self.rounding_at(i) {
            match self.least_gap(body, &{ *m }, &{ *i }, &{ *bound }) {
                Some(gap) => room = gap,
                None => return Calm::Unsure,
            }
        }
        self.bring(body, i, room);
        body.hand = *to;
        Calm::End
    }
    /// The least gap at the end of a window; none if one may close on it.
    #[inline(never)]
    pub(crate) fn least_gap(
        &self,
        body: &Body<R>,
        m: &Motion<R>,
        i: &Instant<R>,
        bound: &Bound<R>,
    ) -> Option<R> {
        let mut room = R::HUGE;
        for (vertex, a) in self.vertices() {
            let arm = i.rotation.apply(a);
            let sag = self.gap_bound(m, bound, arm - i.r).halved();
            let at = i.g + arm;
            for (side, surface) in self.sides() {
                let gap = surface.normal.dot(at) - surface.offset;
                if gap > sag {
                    room = room.min(gap);
                } else if !self.holds(&body.contacts, Feature::Vertex { vertex, side }) {
                    return None;
                }
            }
        }
        if C > 0 {
            for (index, _) in self.obstacles() {
                room = room.min(self.room_before(body, m, i, bound, index)?);
            }
        }
        Some(room)
    }

    /// Where the friction of a stick gives way before the end, if that is certainly the first place and no gap can close before the end.
    #[inline(never)]
    fn yields_calmly(
        &self,
        body: &mut Body<R>,
        to: &HandPose<R>,
        sense: Sense,
        (end, whole): (&Instant<R>, &Bound<R>),
    ) -> Calm {
        let way = body.hand.to(to);
        let m = &Motion::new(Kind::Pin, body, way.per_p).to(*to, way.whole);
        let left = body.room - whole.way;
        if left <= self.rounding_at(end) && self.least_gap(body, m, end, whole).is_none() {
            return Calm::Unsure;
        }
        let frame = self.frame(m.first(), end.rotation, end.g);
        let cone = self.friction(m.first()).cone(body.stiction);
        let q = -(frame.n * cone.sin + frame.t * sense.along(cone.cos));
        let mut i = *end;
        // What is near at the end says nothing about the place.
        body.room = left.max(R::ZERO);
        let Some(place) = self.calm_place(m, q, end.p, &mut i) else {
            return Calm::Unsure;
        };
        // The known balance is the one of this branch; up to the place the margin bends by its part of the window, squared.
        let part = place.p / end.p;
        let is_known = part < R::ONE && (i.u - body.angle).abs() <= whole.theta;
        if !is_known || place.fall.doubled() * place.p < whole.holding * (part * part) {
            return Calm::Unsure;
        }
        self.bring(body, &i, body.room);
        body.hand = m.hand_at(place.p);
        Calm::Yields(sense)
    }
    /// A slip of one vertex, from its beginning, that certainly ends at mu_d N, in balance: the body is there.
    #[inline(never)]
    pub(crate) fn slips_shortly(
        &self,
        body: &mut Body<R>,
        sense: Sense,
        (m, begin): (&Motion<R>, &Instant<R>),
    ) -> bool {
        if self.turns(m.first()) {
            return false;
        }
        let frame = self.frame(m.first(), begin.rotation, begin.g);
        let cone = self.friction(m.first()).sliding;
        let q = frame.n * cone.sin + frame.t * sense.along(cone.cos);
        let mut i = *begin;
        let Some(place) = self.calm_place(m, q, R::HUGE, &mut i) else {
            return false;
        };
        let Some(bound) = self.certified_back(m, &i, body.angle) else {
            return false;
        };
        let half = bound.holding.halved();
        let normals = [begin, &i].map(|i| -frame.n.dot(i.force));
        let is_pressed = normals.iter().all(|&n| n >= half);
        let stays = is_pressed && self.is_short_of_end(m.first(), i.foot);
        if !stays || place.fall.doubled() * place.p < bound.holding {
            return false;
        }
        let mut room = body.room - bound.way;
        if room <= self.rounding_at(&i) {
            let Some(gap) = self.least_gap(body, m, &i, &bound) else {
                return false;
            };
            room = gap;
        }
        self.bring(body, &i, room);
        true
    }
    /// Newton's iteration for u and p in balance where q·F = 0, from an instant; at most six steps.
    fn calm_place(
        &self,
        m: &Motion<R>,
        q: Vec2<R>,
        whole: R,
        i: &mut Instant<R>,
    ) -> Option<Zero<R>> {
        for round in 0..7 {
            let f = q.dot(i.force);
            let (f_u, f_p) = (-q.dot(i.g_u), q.dot(m.hand_p.at - i.g_p));
            let det = R::difference_of_products(i.e_u, f_p, i.e_p, f_u);
            if R::is_fixed() && det.abs() < R::divisor() {
                // Known to too few places.
                return None;
            }
            let u = R::difference_of_products(i.e_p, f, f_p, i.e) / det;
            let p = R::difference_of_products(f_u, i.e, i.e_u, f) / det;
            if round > 0 && u * u + p * p <= R::EPSILON {
                self.nudge(m, i, u);
                i.p = i.p + p;
                i.foot = i.foot + i.xi_p * p;
                i.g = i.g + i.g_p * p;
                i.force = i.force + (m.hand_p.at - i.g_p) * p;
                let fall = -(f_p - f_u * i.e_p / i.e_u);
                let is_place = i.e_u < R::ZERO && i.p > R::ZERO && i.p <= whole && fall > R::ZERO;
                return is_place.then_some(Zero { p: i.p, fall });
            }
            if round < 6 {
                let spot = Spot {
                    u: i.u + u,
                    p: i.p + p,
                };
                self.place(m, spot, None, i);
            }
        }
        None
    }
    /// (E9) from an instant in balance back to p = 0, where the angle is known: the bounds of the window in between.
    fn certified_back(&self, m: &Motion<R>, i: &Instant<R>, angle: R) -> Option<Bound<R>> {
        let residual = Residual {
            way: i.p,
            e1: i.e_p * i.p,
            s0: -i.e_u,
            s1: self.e_up(m, i) * i.p - i.e_u,
        };
        let pace = self.certified(m, i, residual, &mut None).ok()?;
        // The known balance is the one of this branch.
        if (i.u - angle).abs() > pace.extent.strip {
            return None;
        }
        Some(self.bound(m, i, &pace, None))
    }
}
