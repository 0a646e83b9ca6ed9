//! In front of which sides a point or rod is: where a thin wall is closed it is so on both sides, and gaps do not say on which (R36).

use super::Obstacle;
use super::axes::{At, Axis};
use super::flat::is_alike;
use crate::contact::{Contact, Feature};
use crate::geometry::{Rotation, Vec2};
use crate::real::Real;
use crate::state::{Body, HandPose};
use crate::step::Step;
use crate::thresholds::Thresholds;
use crate::world::Statics;

/// The most directions of sides that meet at one place and are told apart.
const DIRECTIONS: usize = 4;

impl<R: Real> Body<R> {
    /// A little in front of where it is.
    pub(crate) fn in_front(&self) -> At<R> {
        At {
            rotation: Rotation::by(self.front.angle),
            g: self.front.at,
        }
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// A point or rod remembers, where it is now, a place in front of all sides that it touches or has touched there.
    pub(crate) fn remember_front(&self, body: &mut Body<R>) {
        if !self.world.has_obstacles() || self.world.vertices.len() > 2 {
            return;
        }
        let at = body.at();
        // Each direction once: the sum of two normals is in front of both sides.
        let mut normals = heapless::Vec::<Vec2<R>, DIRECTIONS>::new();
        let mut add = |n: Vec2<R>| {
            if normals.iter().all(|&m| !is_alike(m, n)) {
                // Of more than four at one place the first ones count.
                let _ = normals.push(n);
            }
        };
        for contact in body.contacts.iter() {
            add(self.frame_here(contact, at).n);
        }
        for (index, o) in self.obstacles() {
            let mut held = body.contacts.iter();
            let is_held = held.any(|c| self.obstacle_of(c) == Some(index));
            if o.count > 2 || is_held || self.distance_bound(&o, at.g) > R::in_front() {
                continue;
            }
            for axis in self.axes(&o, at) {
                let front = body.in_front();
                let before = || self.along(&o, self.axis(&o, axis.normal, front), front).gap;
                if self.is_near_side(&o, &axis, at) && before() > R::ZERO {
                    add(axis.n);
                }
            }
        }
        let sum = normals.iter().fold(Vec2::ZERO, |sum, &n| sum + n);
        body.front = HandPose {
            at: body.holding + sum * R::in_front(),
            angle: body.angle,
        };
    }
    /// Something is so near along an axis that its gap does not tell the sides apart. At a corner where walls meet their sides count.
    fn is_near_side(&self, o: &Obstacle<R>, axis: &Axis<R>, at: At<R>) -> bool {
        let little = R::in_front();
        let mut features = self.compared(o, axis).filter_map(|k| self.feature(axis, k));
        features.any(|feature| {
            let is_met = match feature {
                Feature::Vertex { .. } => false,
                Feature::Corner { corner, .. } => self.is_joined(corner),
            };
            let contact = Contact::at(feature);
            let (xi, [a, b]) = (self.foot_of(contact, at.rotation, at.g), self.ends(contact));
            let is_there = xi >= a - little && xi <= b + little;
            let is_closed = self.gap_here(contact, at).abs() <= little;
            !is_met && is_there && is_closed && self.supports(contact, at)
        })
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Step<'_, R, V, S, C> {
    /// The body leaves all contacts.
    pub(crate) fn lift(&mut self) {
        self.statics.remember_front(self.body);
        self.body.lift();
    }
}
