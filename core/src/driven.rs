//! The slide of two contacts that a load drives, at first order.

use crate::contact::{Contact, Sense};
use crate::frame::Frame;
use crate::geometry::{Vec2, Wrench};
use crate::modes::Pressing;
use crate::motion::{Instant, Motion};
use crate::real::Real;
use crate::state::{Body, HandPose, gap_slope};
use crate::thresholds::Thresholds;
use crate::world::Statics;

/// A slide of two contacts that a load drives, at first order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Driven<R> {
    pub(crate) senses: [Sense; 2],
    /// G_u, theta_u
    pub(crate) velocity: Vec2<R>,
    pub(crate) turn: R,
    /// The direction of the twist: 1 or -1 times (g_y, -g_x).
    pub(crate) direction: R,
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The slide of two contacts that the load drives, at first order.
    pub(crate) fn driven(
        &self,
        body: &Body<R>,
        hand: &HandPose<R>,
        contacts: [usize; 2],
        pressing: Pressing,
    ) -> Option<Driven<R>> {
        let load = self.load(body, hand);
        let pair = contacts.map(|k| body.contacts.get(k));
        let frames = self.frames(pair, body.rotation, body.holding);
        let [first, second] = &frames;
        let g = gap_slope(&frames);
        let slope = g.length();
        if slope <= R::ahead() {
            // Straight across: no motion changes the second gap by more than a touch, none is theirs alone.
            return None;
        }
        let twist = Vec2::new(g.y, -g.x) * (R::ONE / slope);
        let velocity = first.t * twist.x - first.r.turned() * twist.y;
        let v = [twist.x, second.advance(velocity, twist.y)];
        let [v1, v2] = v;
        if v1.abs().min(v2.abs()) * slope < R::of_turn() {
            return self.driven_at_turn(body, hand, contacts, pressing);
        }
        let senses = v.map(Sense::of);
        let of_load = R::of_drive(load.force.length_bound());
        let of_normal = R::of_normal(load.size());
        let along = Wrench::at(first.r, first.t) * v1 + Wrench::at(second.r, second.t) * v2;
        for direction in [Sense::Plus, Sense::Minus] {
            let senses = match direction {
                Sense::Rests | Sense::Plus => senses,
                Sense::Minus => senses.map(Sense::reversed),
            };
            let [w1, w2] = self.edges_of(pair, &frames, senses);
            let x = w1.cross(w2);
            let full = x.dot(along);
            let little = of_load.min(of_load * x.size() + of_normal);
            if direction.along(x.dot(load) * full.sign()) <= little {
                continue;
            }
            let shares = [w2.cross(along).dot(load), along.cross(w1).dot(load)];
            let mut normal = shares.iter().map(|&share| -(share / full));
            let known = of_load * along.size() / full.abs();
            let is_pressed = normal.all(|n| n >= -(R::TOUCH + known));
            if pressing == Pressing::AtBalance || is_pressed {
                return Some(Driven {
                    senses,
                    velocity: velocity * direction.number(),
                    turn: direction.along(twist.y),
                    direction: direction.number(),
                });
            }
        }
        None
    }
    /// The reactions of two contacts that slide, as wrenches.
    fn edges_of(
        &self,
        [c1, c2]: [Contact; 2],
        [first, second]: &[Frame<R>; 2],
        [s1, s2]: [Sense; 2],
    ) -> [Wrench<R>; 2] {
        [
            Wrench::at(first.r, self.edge(c1.with(s1), first).f),
            Wrench::at(second.r, self.edge(c2.with(s2), second).f),
        ]
    }
    /// Where a foot turns back the friction just ahead of either direction decides.
    #[inline(never)]
    fn driven_at_turn(
        &self,
        body: &Body<R>,
        hand: &HandPose<R>,
        contacts: [usize; 2],
        pressing: Pressing,
    ) -> Option<Driven<R>> {
        let mut leading = *body;
        leading.hand = *hand;
        let pair = contacts.map(|k| body.contacts.get(k));
        let [i, _] = contacts;
        self.lead(&mut leading, i);
        leading.contacts.keep(&pair);
        for direction in [R::ONE, -R::ONE] {
            let m = self.pair(&leading, HandPose::REST, direction);
            let i = self.placed_at_start(&m);
            if self.drives(&m, &i, pressing) {
                let [c1, c2] = m.contacts;
                return Some(Driven {
                    senses: [c1.sense, c2.sense],
                    velocity: i.g_u,
                    turn: i.theta_u,
                    direction,
                });
            }
        }
        None
    }
    /// The load drives a pair along, and its contacts press.
    fn drives(&self, m: &Motion<R>, i: &Instant<R>, pressing: Pressing) -> bool {
        let little = R::of_drive(i.force.length_bound());
        let shares = self.shares(m, i);
        let is_pressed = pressing == Pressing::AtBalance || shares.press();
        i.e > little && shares.drag > R::ZERO && is_pressed
    }
}
