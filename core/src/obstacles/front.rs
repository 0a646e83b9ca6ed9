//! In front of which sides a point or rod is: where a thin wall is closed it is so on both sides, and gaps do not say on which (R36).

use super::axes::At;
use super::flat::is_alike;
use crate::contact::{Contact, Feature};
use crate::geometry::Vec2;
use crate::motion::Instant;
use crate::real::Real;
use crate::state::Body;
use crate::step::Step;
use crate::thresholds::Thresholds;
use crate::world::Statics;

/// The most directions of sides that meet at one place and are distinguished.
const DIRECTIONS: usize = 4;

impl<R: Real> Body<R> {
    /// A little in front of where it is.
    pub(crate) fn in_front(&self) -> At<R> {
        At {
            rotation: self.rotation,
            g: self.holding + self.front,
        }
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The body goes to an instant of a motion of its own; where that is no place it stays.
    #[inline]
    pub(crate) fn bring(&self, body: &mut Body<R>, i: &Instant<R>, room: R) {
        if i.is_finite() {
            self.stay_in_front(body, i.at());
        }
        body.go_to(i, room);
    }
    /// A point or rod goes to a pose, and remembers a place in front of all sides that it touches there, or is as near to.
    pub(crate) fn stay_in_front(&self, body: &mut Body<R>, to: At<R>) {
        if !self.world.has_obstacles() || self.world.vertices.len() > 2 {
            return;
        }
        // Each direction once: the sum of two normals is in front of both sides.
        let mut normals = heapless::Vec::<Vec2<R>, DIRECTIONS>::new();
        let mut add = |contact: Contact| {
            let n = self.frame_here(contact, to).n;
            if normals.iter().all(|&m| !is_alike(m, n)) {
                // Of more than four at one place the first ones count.
                let _ = normals.push(n);
            }
        };
        body.contacts.iter().for_each(&mut add);
        let from = body.in_front();
        for (index, o) in self.obstacles() {
            let mut held = body.contacts.iter();
            let is_held = held.any(|c| self.obstacle_of(c) == Some(index));
            if !self.are_thin(&o) || is_held || self.distance_bound(&o, to.g) > R::in_front() {
                continue;
            }
            self.features_of(&o, to, |_| true)
                .filter(|&c| self.is_near(c, to) && self.gap_here(c, from) > R::ZERO)
                .for_each(&mut add);
        }
        body.front = normals.iter().fold(Vec2::ZERO, |sum, &n| sum + n) * R::in_front();
    }
    /// What would touch is so near that its gap does not tell the sides apart. At a corner where walls meet their sides count.
    #[inline(never)]
    fn is_near(&self, contact: Contact, at: At<R>) -> bool {
        let is_met = match contact.feature {
            Feature::Vertex { .. } => false,
            Feature::Corner { corner, .. } => self.is_joined(corner),
        };
        let (little, [a, b]) = (R::in_front(), self.ends(contact));
        let xi = self.foot_of(contact, at.rotation, at.g);
        let is_there = !is_met && xi >= a - little && xi <= b + little;
        is_there && self.gap_here(contact, at).abs() <= little && self.supports(contact, at)
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Step<'_, R, V, S, C> {
    /// The body leaves all contacts.
    pub(crate) fn lift(&mut self) {
        self.statics.stay_in_front(self.body, self.body.at());
        self.body.lift();
    }
}
