//! An edge, two contacts in one line with one friction. While its ends press it is one contact that cannot turn: all is linear in the load, and
//! along its slip.

use crate::bounds::Bound;
use crate::contact::Sense;
use crate::frame::{Foot, Frame};
use crate::geometry::Wrench;
use crate::motion::{Instant, Kind, Motion};
use crate::real::Real;
use crate::state::{Body, HandPose};
use crate::thresholds::Thresholds;
use crate::world::Statics;

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// Both ends press beyond doubt under a load: each bears the moment about the other.
    fn ends_press(&self, [first, second]: &[Frame<R>; 2], load: Wrench<R>) -> bool {
        let side = (second.r - first.r).cross(first.n).sign();
        let [m1, m2] = [first, second].map(|at| load.moment - at.r.cross(load.force));
        [-m1, m2]
            .iter()
            .all(|&m| m * side > R::of_release(load.size()))
    }
    /// The part of the hand's displacement to another pose after which the friction of an edge with stiction gives way, if it does and both
    /// ends press on all of it; and the sense of the slip.
    #[inline(never)]
    pub(crate) fn edge_yields(&self, body: &Body<R>, to: &HandPose<R>) -> Option<(R, Sense)> {
        if !body.stiction || !self.is_edge(&body.contacts) {
            return None;
        }
        let frames = self.frames(body.contacts.pair(), body.rotation, body.holding);
        let loads = [self.present_load(body), self.load(body, to)];
        let ([first, _], [_, end]) = (&frames, loads);
        let cone = self.friction(body.contacts.first()).fixed;
        let sense = Sense::of(first.t.dot(end.force));
        let [v0, v1] = loads.map(|load| {
            let (n, pull) = (-first.n.dot(load.force), first.t.dot(load.force));
            n * cone.sin - sense.along(pull) * cone.cos
        });
        let yields = v1 < -R::of_balance(end.size());
        if !yields || !loads.iter().all(|&load| self.ends_press(&frames, load)) {
            return None;
        }
        let v0 = v0.max(R::ZERO);
        Some((v0 / (v0 - v1), sense))
    }
    /// An edge slides in a sense to its balance at a pose of the hand, where e·F = 0, if certainly both ends press and no gap closes on the way:
    /// the body is there, the hand where it was.
    #[inline(never)]
    pub(crate) fn slides_straight(
        &self,
        body: &mut Body<R>,
        sense: Sense,
        to: &HandPose<R>,
    ) -> bool {
        let contacts = body.contacts.pair();
        let [c1, c2] = contacts;
        let frames = self.frames(contacts, body.rotation, body.holding);
        let ([first, _], begin, load) = (&frames, self.present_load(body), self.load(body, to));
        let edge = self.edge(c1.with(sense), first);
        let delta = edge.e.dot(load.force) / edge.cos;
        let foot = body.foot + delta;
        let Foot { c, r } = self.foot(c1, body.rotation, foot);
        let i = Instant {
            rotation: body.rotation,
            angle: body.angle,
            foot,
            g: c - r,
            r,
            force: load.force - (c - r - body.holding),
            ..Instant::ZERO
        };
        let end = Wrench {
            force: i.force,
            ..load
        };
        let frames_there = self.frames(contacts, i.rotation, i.g);
        let [_, second] = &frames_there;
        let ends = [(&frames, begin), (&frames_there, end)];
        let is_pressed = ends.into_iter().all(|(f, load)| self.ends_press(f, load));
        let stays = self.is_short_of_end(c1, foot) && self.is_short_of_end(c2, second.foot(i.g));
        let way = sense.along(delta);
        if way <= R::ZERO || !is_pressed || !stays {
            return false;
        }
        let mut room = body.room - way;
        if room <= self.rounding_at(&i) {
            let m = Motion::frozen(Kind::Line, body);
            let bound = Bound { way, ..Bound::ZERO };
            match self.least_gap(body, &m, &i, &bound) {
                Some(gap) => room = gap,
                None => return false,
            }
        }
        self.leave_behind(body, i.at());
        body.go_to(&i, room);
        true
    }
}
