//! An edge, two contacts in one line with one friction. While its ends press it is one contact that cannot turn: all is linear in the load, and
//! along its slip.

use crate::bounds::Bound;
use crate::cone::Borne;
use crate::contact::Sense;
use crate::frame::{Foot, Frame};
use crate::geometry::Wrench;
use crate::motion::{Instant, Kind, Motion};
use crate::real::Real;
use crate::state::{Body, HandPose};
use crate::thresholds::Thresholds;
use crate::world::Statics;

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// How much the load has to change until an end does not press: each bears the moment about the other.
    fn ends_press(&self, [first, second]: &[Frame<R>; 2], load: Wrench<R>) -> R {
        let side = (second.r - first.r).cross(first.n).sign();
        let [of_second, of_first] = [first, second].map(|about| {
            let moment = (load.moment - about.r.cross(load.force)) * side;
            (moment, about.r.length_bound().max(R::ONE))
        });
        let ((m2, size2), (m1, size1)) = (of_second, of_first);
        (-m2 / size2).min(m1 / size1)
    }
    /// How long an edge with stiction bears the load along the hand's displacement to another pose, if both ends press beyond doubt on all of
    /// it: two ends and the friction of both are the facets of its cone.
    #[inline(never)]
    pub(crate) fn borne_by_edge(&self, body: &Body<R>, to: &HandPose<R>) -> Option<Borne<R>> {
        if !body.stiction || !self.is_edge(&body.contacts) {
            return None;
        }
        let frames = self.frames(body.contacts.pair(), body.rotation, body.holding);
        let (begin, end) = (self.present_load(body), self.load(body, to));
        let released = R::of_release(end.size());
        let slack = self.ends_press(&frames, end);
        if slack <= released || self.ends_press(&frames, begin) <= released {
            return None;
        }
        let [first, _] = &frames;
        let cone = self.friction(body.contacts.first()).fixed;
        let sense = Sense::of(first.t.dot(end.force));
        let [v0, v1] = [begin, end].map(|load| {
            let (n, pull) = (-first.n.dot(load.force), first.t.dot(load.force));
            n * cone.sin - sense.along(pull) * cone.cos
        });
        if v1 >= -R::of_balance(end.size()) {
            return Some(Borne::All(slack.min(v1.max(R::ZERO))));
        }
        let v0 = v0.max(R::ZERO);
        Some(Borne::Slips(v0 / (v0 - v1), sense))
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
        let released = R::of_release(begin.size());
        let mut ends = [(&frames, begin), (&frames_there, end)].into_iter();
        let is_pressed = ends.all(|(frames, load)| self.ends_press(frames, load) > released);
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
        self.bring(body, &i, room);
        true
    }
}
