//! The contact that follows another at the end of a side: past the end of a slide, at the other end of an edge, and where a body has turned
//! about a corner on which one of its vertices stands.

use super::super::Placed;
use super::{beside, corners, line_of, together};
use crate::contact::{Pair, Pairs};
use crate::obstacle::Corner;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::world::World;

/// A vertex and a corner that coincide: what supports their contact, and what it becomes where that support ends.
pub(crate) struct Tip<R> {
    /// The contact that lies flat there and reaches no farther: that of a neighbour of the vertex, or of the corner.
    pub(crate) neighbour: Pair,
    /// How far it is beyond the end.
    off: R,
    /// The contact at the same place whose normal comes next.
    pub(crate) next: Pair,
}

impl<R: Real> Placed<R> {
    /// If a contact is at the end of its side, the body that turns about it comes to lie flat beyond that end without touching anything
    /// new: there the normal begins to turn with the body, or stops turning with it (STATICS 12.4). Also returns the direction in which it
    /// turns there.
    pub(crate) fn tips<W: World<R>>(&self, scene: &W, contact: Pair) -> (R, [Option<Tip<R>>; 2]) {
        let [low, high] = scene.reach(contact);
        let foot = self.foot(scene, contact);
        let (to_low, to_high) = (foot - low, high - foot);
        if to_low > together() && to_high > together() {
            return (R::ZERO, [None, None]);
        }
        let surface = scene.face(contact, self.orientation.rotation());
        let is_high = to_high < to_low;
        let arm = self.arm_to(scene, contact);
        // Beyond the end, as seen by a vertex and by a corner.
        let (beyond, turn) = if is_high == contact.is_corner() {
            (-surface.tangent, R::ONE)
        } else {
            (surface.tangent, -R::ONE)
        };
        let off = |neighbour| beyond.dot(self.arm_to(scene, neighbour) - arm);
        let tips = if contact.is_corner() {
            let obstacle = scene.obstacle_of(contact);
            let own = corners(scene, usize::from(obstacle.unwrap_or_default()));
            let side = contact.body_side();
            let [after, _] = scene.neighbours(side);
            let vertex = if is_high { side } else { after };
            [true, false].map(|ahead| {
                let other = beside(&own, contact.surface, ahead);
                let neighbour = Pair::of_corner(other, side);
                let line = if ahead { contact.surface } else { other };
                let surface = line_of(scene, line);
                (own.len() > 1).then(|| Tip {
                    neighbour,
                    off: off(neighbour),
                    next: Pair { vertex, surface },
                })
            })
        } else {
            let is_here = |corner: &Corner<R>| {
                let apart = corner.place - (self.point + arm);
                !corner.covered && apart.length_bound() <= together()
            };
            let first = scene.surface_indices().end;
            let mut here = (first..)
                .zip(scene.corners())
                .filter(|(_, corner)| is_here(corner));
            let corner = here.next().map(|(corner, _)| corner);
            let [after, before] = scene.neighbours(contact.vertex);
            [(after, contact.vertex), (before, before)].map(|(other, side)| {
                let neighbour = Pair {
                    vertex: other,
                    ..contact
                };
                let next = Pair::of_corner(corner?, side);
                (other != contact.vertex).then(|| Tip {
                    neighbour,
                    off: off(neighbour),
                    next,
                })
            })
        };
        (turn, tips)
    }

    /// The contact that comes next if a body has turned to the end of what supports the present one.
    pub(crate) fn next_at_tip<W: World<R>>(&self, scene: &W, contact: Pair) -> Option<Pair> {
        let (_, tips) = self.tips(scene, contact);
        let tips = (tips.into_iter().flatten()).filter(|tip| tip.off > R::ZERO);
        let gap = |tip: &Tip<R>| self.gap(scene, tip.neighbour);
        let next = tips.reduce(|least, tip| if gap(&tip) < gap(&least) { tip } else { least });
        next.map(|tip| tip.next)
    }

    /// The contact that replaces one that has left its side along sign·t: the one at the same place whose normal comes next as the normal
    /// turns towards the slide.
    pub(crate) fn next_contact<W: World<R>>(
        &self,
        scene: &W,
        (left, sign): (Pair, R),
        contacts: &[Pair],
    ) -> Option<Pair> {
        let rotation = self.orientation.rotation();
        let surface = scene.face(left, rotation);
        let (normal, ahead) = (surface.normal, surface.tangent * sign);
        let turn = |pair: Pair| {
            let next = scene.face(pair, rotation).normal;
            next.dot(ahead).atan2(next.dot(normal))
        };
        // The contact is beyond the end by a touch.
        let near = together::<R>() + R::TOUCH;
        let mut list = Pairs::new();
        self.touching_obstacles(scene, near, &mut list);
        let mut found: Option<(R, Pair)> = None;
        for &pair in &list {
            let apart = self.arm_to(scene, pair) - self.arm_to(scene, left);
            let least = if scene.obstacle_of(pair) == scene.obstacle_of(left) {
                R::in_plane()
            } else {
                -R::in_plane()
            };
            let turn = turn(pair);
            let is_taken = |&other: &Pair| {
                other == pair || other != left && self.are_one(scene, [other, pair])
            };
            let is_here = apart.length_bound() <= near && !contacts.iter().any(is_taken);
            if is_here && turn > least && found.is_none_or(|(first, _)| turn < first) {
                found = Some((turn, pair));
            }
        }
        found.map(|(_, pair)| pair)
    }

    /// The end of an edge that slides along sign·t after one of its contacts has left its side: the contact farthest away that is collinear
    /// with the one that lasts and does not leave its side as well.
    pub(crate) fn next_end<W: World<R>>(
        &self,
        scene: &W,
        (left, sign): (Pair, R),
        lasting: &[Pair],
    ) -> Option<Pair> {
        let &base = lasting.first()?;
        let tangent = scene.face(base, self.orientation.rotation()).tangent;
        let along = |pair: Pair| tangent.dot(self.arm_to(scene, pair) - self.arm_to(scene, base));
        let way = along(left).sign();
        let mut list = Pairs::new();
        self.touching_obstacles(scene, together(), &mut list);
        let is_end = |&pair: &Pair| {
            let [low, high] = scene.reach(pair);
            let foot = self.foot(scene, pair);
            let ahead = if sign < R::ZERO {
                foot - low
            } else {
                high - foot
            };
            let differs = pair != left && pair != base;
            differs && ahead > together() && self.lie_in_line(scene, [base, pair])
        };
        let ends = list.iter().copied().filter(is_end);
        let mut found: Option<(R, Pair)> = None;
        for pair in ends {
            let far = along(pair) * way;
            if far > together() && found.is_none_or(|(farthest, _)| far > farthest) {
                found = Some((far, pair));
            }
        }
        found.map(|(_, pair)| pair)
    }
}
