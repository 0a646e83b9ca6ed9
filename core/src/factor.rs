//! The factors of E = N (e·r): of a body whose angle nothing holds and whose single contact slides, one of them is followed (STATICS 11, R34).

use crate::contact::{Contact, Sense};
use crate::events::Watched;
use crate::frame::Frame;
use crate::geometry::Vec2;
use crate::motion::{Factor, Instant, Kind, Motion, Rates};
use crate::real::Real;
use crate::state::{Body, HandPose};
use crate::thresholds::Thresholds;
use crate::values::{Moving, Value};
use crate::world::Statics;

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// Nothing acts on the angle: it stays (R34).
    pub(crate) fn keep_angle(&self, m: &Motion<R>, i: &mut Instant<R>) {
        (i.e, i.e_u, i.e_p) = (m.angle - i.angle, -R::ONE, R::ZERO);
    }
    /// Nothing holds the angle, and the contact is a vertex at the holding point: it does not turn the body either.
    pub(crate) fn is_held_there(&self, m: &Motion<R>, i: &Instant<R>) -> bool {
        self.grip.swings && !self.turns(m.first()) && i.r.length_bound() <= R::TOUCH
    }
    /// One of the factors of E = N (e·r) of a contact, with the sign that E has with it, and its partial derivatives, along h_p.
    #[inline(never)]
    pub(crate) fn weigh_factor(
        &self,
        (contact, factor): (Contact, Factor),
        i: &Instant<R>,
        h_p: Vec2<R>,
    ) -> [R; 3] {
        let frame = self.frame(contact, i.rotation, i.g);
        let edge = self.edge(contact, &frame);
        let pull = i.force - i.r;
        let lever = edge.e.dot(i.r);
        let (e, e_u, e_p) = match factor {
            Factor::Both => (R::ZERO, R::ZERO, R::ZERO),
            // e·r = -e·P of a C
            Factor::Lever if frame.turns => (lever, -edge.e.turned().dot(pull), -edge.e.dot(h_p)),
            Factor::Lever => (lever, edge.e.dot(i.r.turned()), R::ZERO),
            Factor::Normal(s) => {
                let n = -frame.n * s.number::<R>();
                let n_u = if frame.turns {
                    n.turned().dot(pull)
                } else {
                    n.dot(i.r.turned())
                };
                (n.dot(i.force), n_u, n.dot(h_p))
            }
        };
        [e, e_u, e_p]
    }
    /// A slide of the first contact along the hand's displacement.
    #[inline(always)]
    pub(crate) fn sliding(&self, body: &Body<R>, hand_p: HandPose<R>) -> Motion<R> {
        let mut m = Motion::new(Kind::Slide, body, hand_p);
        if self.grip.swings {
            m.factor = self.factor(body, hand_p);
        }
        m
    }
    /// Of a slide of a body whose angle nothing holds, the factor that is zero; the lever if both are.
    #[inline(never)]
    fn factor(&self, body: &Body<R>, hand_p: HandPose<R>) -> Factor {
        let m = Motion::new(Kind::Slide, body, hand_p);
        let i = self.placed_at_start(&m);
        let frame = self.frame(m.first(), i.rotation, i.g);
        let lever = self.edge(m.first(), &frame).e.dot(i.r);
        let is_slack = lever.abs() > R::zero().max(frame.n.dot(i.force).abs());
        if is_slack {
            Factor::Normal(Sense::of(lever))
        } else {
            Factor::Lever
        }
    }
    /// E_uu of a factor: the second derivative of a direction times r, or P of a C, one of which turns.
    pub(crate) fn e_uu_factor(&self, m: &Motion<R>, i: &Instant<R>) -> R {
        let frame = self.frame(m.first(), i.rotation, i.g);
        let arm = if frame.turns { i.force - i.r } else { i.r };
        match m.factor {
            Factor::Both => R::ZERO,
            Factor::Lever if frame.turns => self.edge(m.first(), &frame).e.dot(arm),
            Factor::Lever => -self.edge(m.first(), &frame).e.dot(arm),
            Factor::Normal(s) => s.along(frame.n.dot(arm)),
        }
    }
    /// E_up of a factor.
    pub(crate) fn e_up_factor(&self, m: &Motion<R>, i: &Instant<R>) -> R {
        if !self.turns(m.first()) {
            return R::ZERO;
        }
        let frame = self.frame(m.first(), i.rotation, i.g);
        let along = match m.factor {
            Factor::Both => Vec2::ZERO,
            Factor::Lever => self.edge(m.first(), &frame).e,
            Factor::Normal(s) => frame.n * s.number::<R>(),
        };
        -along.turned().dot(m.hand_p.at)
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Watched<'_, R, V, S, C> {
    /// Of a contact that bears nothing: s e·r, halt, and how the hand presses it.
    pub(crate) fn trail_values(
        &self,
        i: &Instant<R>,
        rates: &Rates<R>,
        frame: &Frame<R>,
    ) -> [Value<R>; 3] {
        let m = self.motion;
        let e = self.statics.edge(m.first(), frame).e;
        let turned = |a: Vec2<R>| a.turned() * rates.theta;
        let (e_rate, r_rate) = if frame.turns {
            (turned(e), -rates.g)
        } else {
            (Vec2::ZERO, turned(i.r))
        };
        let edge = Moving {
            at: e,
            rate: e_rate,
        };
        let lever = edge.dot(Moving {
            at: i.r,
            rate: r_rate,
        });
        let lever = match m.factor {
            Factor::Normal(s) => lever.times(s.number()),
            Factor::Both | Factor::Lever => lever,
        };
        let size = m.hand_p.size();
        let presses = Value {
            v: (R::of_displacement(size) - frame.n.dot(m.hand_p.at)) / size,
            d: R::ZERO,
        };
        [lever, self.halt(i, rates), presses]
    }
}
