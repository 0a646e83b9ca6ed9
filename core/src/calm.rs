//! Calm frames: the balance at their end proves that nothing happens before; and calm places, where friction gives way or a slip ends within
//! one window (STATICS 7).

use crate::bounds::Bound;
use crate::contact::{Feature, Sense};
use crate::geometry::Vec2;
use crate::motion::{Instant, Kind, Motion, Spot};
use crate::real::Real;
use crate::state::{Body, HandPose};
use crate::window::{Begin, Residual};
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
    /// A body without contact, or about contacts that stick.
    #[inline(never)]
    pub(crate) fn turns_calmly(&self, body: &mut Body<R>, to: &HandPose<R>) -> Calm {
        let way = body.hand.to(to);
        let count = body.contacts.len();
        if count > 1 {
            return Calm::Unsure;
        }
        let kind = if count == 0 { Kind::Free } else { Kind::Pin };
        let m = Motion::new(kind, body, way.per_p).to(*to, way.whole);
        if count == 1 && m.first().is_corner() {
            return Calm::Unsure;
        }
        let mut i = Instant::ZERO;
        let Ok(pace) = self.window(&m, begin(body), way.whole, &mut i) else {
            return Calm::Unsure;
        };
        let bound = self.bound(&m, &i, &pace);
        let mut yields = None;
        if count == 1 {
            let friction = self.friction(m.first());
            let frame = self.frame(m.first(), i.rotation, i.g);
            let (n, pull) = (-frame.n.dot(i.force), frame.t.dot(i.force));
            let cone = friction.cone(body.stiction);
            let half = bound.holding.halved();
            let margin = n * cone.sin - pull.abs() * cone.cos;
            let may_press = !body.stiction && friction.threshold - n < half;
            if n < half || may_press {
                return Calm::Unsure;
            }
            if margin < R::ZERO {
                yields = Some(Sense::of(pull));
            } else if margin < half {
                return Calm::Unsure;
            }
        }
        let Some(room) = self.room_after(body, &m, &i, &bound) else {
            return Calm::Unsure;
        };
        match yields {
            Some(sense) => {
                // What is near at the end says nothing about the place.
                body.room = (body.room - bound.way).max(R::ZERO);
                self.yields_calmly(body, &m, sense, &i)
            }
            None => {
                body.go_to(&i, room);
                body.hand = *to;
                Calm::End
            }
        }
    }
    /// A contact that slides.
    #[inline(never)]
    pub(crate) fn slides_calmly(&self, body: &mut Body<R>, to: &HandPose<R>) -> Calm {
        let way = body.hand.to(to);
        let m = Motion::new(Kind::Slide, body, way.per_p).to(*to, way.whole);
        if m.first().is_corner() {
            return Calm::Unsure;
        }
        let mut i = Instant::ZERO;
        let Ok(pace) = self.window(&m, begin(body), way.whole, &mut i) else {
            return Calm::Unsure;
        };
        let bound = self.bound(&m, &i, &pace);
        let friction = self.friction(m.first());
        let n = -self.frame(m.first(), i.rotation, i.g).n.dot(i.force);
        let half = bound.holding.halved();
        let advance = i.xi_p - i.xi_u * i.e_p / i.e_u;
        let [_, xi2] = bound.foot;
        let may_press = !body.stiction && friction.threshold - n < half;
        let may_halt = m.first().sense.along(advance) * way.whole < xi2;
        if n < half || may_press || may_halt || !self.is_short_of_end(m.first(), i.foot) {
            return Calm::Unsure;
        }
        match self.room_after(body, &m, &i, &bound) {
            Some(room) => {
                body.go_to(&i, room);
                body.hand = *to;
                Calm::End
            }
            None => Calm::Unsure,
        }
    }

    /// The room that is left after a window whose end is known; none if a gap may close on it.
    fn room_after(
        &self,
        body: &Body<R>,
        m: &Motion<R>,
        i: &Instant<R>,
        bound: &Bound<R>,
    ) -> Option<R> {
        let left = body.room - bound.way;
        if left > R::ZERO {
            return Some(left);
        }
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

    /// Where the friction of a stick gives way before the end, if that is certainly the first place.
    fn yields_calmly(
        &self,
        body: &mut Body<R>,
        m: &Motion<R>,
        sense: Sense,
        end: &Instant<R>,
    ) -> Calm {
        let frame = self.frame(m.first(), end.rotation, end.g);
        let cone = self.friction(m.first()).cone(body.stiction);
        let q = -(frame.n * cone.sin + frame.t * sense.along(cone.cos));
        let mut i = *end;
        let Some(place) = self.calm_place(m, q, end.p, &mut i) else {
            return Calm::Unsure;
        };
        let Some(bound) = self.certified_back(m, &i, body.angle) else {
            return Calm::Unsure;
        };
        if place.p >= end.p || place.fall.doubled() * place.p < bound.holding {
            return Calm::Unsure;
        }
        body.go_to(&i, body.room);
        body.hand = m.hand_at(place.p);
        Calm::Yields(sense)
    }
    /// A slip of one vertex that certainly ends at mu_d N, in balance: the body is there.
    #[inline(never)]
    pub(crate) fn slips_shortly(&self, body: &mut Body<R>, sense: Sense) -> bool {
        let m = Motion::slip(body, sense.number());
        if m.first().is_corner() {
            return false;
        }
        let begin = self.placed_at_start(&m);
        let frame = self.frame(m.first(), begin.rotation, begin.g);
        let cone = self.friction(m.first()).sliding;
        let q = frame.n * cone.sin + frame.t * sense.along(cone.cos);
        let mut i = begin;
        let Some(place) = self.calm_place(&m, q, R::HUGE, &mut i) else {
            return false;
        };
        let Some(bound) = self.certified_back(&m, &i, body.angle) else {
            return false;
        };
        let half = bound.holding.halved();
        let normals = [&begin, &i].map(|i| -frame.n.dot(i.force));
        let is_pressed = normals.iter().all(|&n| n >= half);
        let stays = is_pressed && self.is_short_of_end(m.first(), i.foot);
        if !stays || place.fall.doubled() * place.p < bound.holding {
            return false;
        }
        match self.room_after(body, &m, &i, &bound) {
            Some(room) => {
                body.go_to(&i, room);
                true
            }
            None => false,
        }
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
        let pace = self.certified(m, i, residual).ok()?;
        // The known balance is the one of this branch.
        if (i.u - angle).abs() > pace.extent.strip {
            return None;
        }
        Some(self.bound(m, i, &pace))
    }
}

/// The present balance of a body whose u is the angle.
fn begin<R: Real>(body: &Body<R>) -> Begin<'static, R> {
    Begin::Spot {
        spot: Spot {
            u: body.angle,
            p: R::ZERO,
        },
        rotation: body.rotation,
    }
}
