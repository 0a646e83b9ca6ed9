//! The features of the body that touch obstacles at a pose, and which of these contacts can exist simultaneously.

use super::super::Placed;
use super::axes::{Beside, widest};
use super::tally::{Sizes, units};
use super::{beside, corners, line_of, sides, together};
use crate::contact::{Pair, Pairs};
use crate::geometry::Vec2;
use crate::list::gather;
use crate::motion::Instant;
use crate::obstacle::Round;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::world::World;

/// A side that starts from a point at which its obstacle has a corner.
#[derive(Clone, Copy)]
pub(super) struct Leaving<R> {
    pub(super) direction: Vec2<R>,
    /// Its outward normal; zero for a thin wall, which has two.
    pub(super) normal: Vec2<R>,
}

/// The sides of obstacles, except two, that start from a point, which is known to within some length.
pub(super) fn leaving<R: Real, W: World<R>>(
    scene: &W,
    (place, known_to): (Vec2<R>, R),
    but: [u8; 2],
) -> impl Iterator<Item = Leaving<R>> + Clone + '_ {
    let first = scene.surface_indices().end;
    let others = (first..).zip(scene.corners()).filter(move |(_, corner)| {
        let is_here = (corner.place - place).length_bound() <= known_to;
        is_here && !but.contains(&corner.obstacle)
    });
    others.flat_map(move |(index, corner)| {
        let own = corners(scene, usize::from(corner.obstacle));
        let (has_sides, has_inside) = (own.len() > 1, own.len() > 2);
        let [after, before] = [index, beside(&own, index, false)].map(|side| scene.surface(side));
        let both = [
            (-after.tangent, after.normal),
            (before.tangent, before.normal),
        ];
        let both = both.map(|(direction, normal)| Leaving {
            direction,
            normal: if has_inside { normal } else { Vec2::ZERO },
        });
        both.into_iter().filter(move |_| has_sides)
    })
}

impl<R: Real> Placed<R> {
    /// The rounding of a gap to an obstacle near the body.
    pub(crate) fn rounding(&self) -> R {
        R::of_coordinates() * (R::TWO + self.point.length_bound())
    }

    /// A feature closer than this to a point of the body counts as at that point, to the accuracy of a search.
    pub(super) fn here(&self) -> R {
        together::<R>() + self.rounding().doubled()
    }

    /// A lower bound of the distance of the point from a circle.
    pub(super) fn apart(&self, round: &Round<R>) -> R {
        let between = self.point - round.center;
        between.x.abs().max(between.y.abs()) - round.radius
    }

    /// The distance between the body and an obstacle, or minus the depth of one in the other.
    pub(crate) fn separation<W: World<R>>(&self, scene: &W, obstacle: usize) -> R {
        widest(
            scene,
            &Instant::at_rest(*self),
            obstacle,
            (&[], Beside::UNKNOWN),
        )
        .1
    }

    /// Returns whether the body is deeper in an obstacle than this.
    pub(crate) fn is_in_obstacle<W: World<R>>(&self, scene: &W, depth: R) -> bool {
        (0..scene.firsts().len()).any(|obstacle| self.separation(scene, obstacle) < -depth)
    }

    /// How far a contact is beyond the end of its side; negative on it.
    pub(crate) fn beyond<W: World<R>>(&self, scene: &W, contact: Pair) -> R {
        let [low, high] = scene.reach(contact);
        let foot = self.foot(scene, contact);
        (low - foot).max(foot - high)
    }

    /// The sides next to a vertex or corner lead away from the side that it touches, or go no deeper than this.
    pub(super) fn supports<W: World<R>>(&self, scene: &W, contact: Pair, depth: R) -> bool {
        let normal = scene.face(contact, self.orientation.rotation()).normal;
        if contact.is_corner() {
            let Some(corner) = scene.corner(contact.surface) else {
                return false;
            };
            let own = corners(scene, usize::from(corner.obstacle));
            [true, false].into_iter().all(|next| {
                let other = scene.corner(beside(&own, contact.surface, next));
                other.is_none_or(|other| normal.dot(other.place - corner.place) <= depth)
            })
        } else {
            let arm = self.arm(scene, contact.vertex);
            let others = scene.neighbours(contact.vertex).into_iter();
            let mut others = others.map(|other| self.arm(scene, other));
            others.all(|other| normal.dot(other - arm) >= -depth)
        }
    }

    /// Returns whether, where corners of several obstacles meet, the body is in front of the side that it touches there, with neither
    /// another obstacle nor a half-plane in between; a side of the body must have all of them behind it. The contact touches to within a
    /// tolerance.
    pub(super) fn meets<W: World<R>>(&self, scene: &W, contact: Pair, tolerance: R) -> bool {
        let own = scene.obstacle_of(contact);
        let arm = self.arm_to(scene, contact);
        let place = (self.point + arm, self.here().max(tolerance.doubled()));
        let surface = scene.face(contact, self.orientation.rotation());
        let leaving = own
            .into_iter()
            .flat_map(|own| leaving(scene, place, [own; 2]));
        if contact.is_corner() {
            return leaving
                .clone()
                .all(|side| surface.normal.dot(side.direction) <= R::MICRO);
        }
        // For a rod it is not known on which side of it a flat side in between is.
        let flat = if scene.vertices().len() > 2 {
            R::MICRO
        } else {
            -R::MICRO
        };
        // Seen along a direction of the side, nothing is in front of the body.
        let is_in_front = |along: Vec2<R>| {
            let angle = |side: Vec2<R>| surface.normal.dot(side).atan2(along.dot(side));
            let body = scene.neighbours(contact.vertex).into_iter();
            let body = body.filter(|&other| other != contact.vertex);
            let body = body.map(|other| angle(self.arm(scene, other) - arm));
            let nearest = body.reduce(R::min);
            leaving.clone().all(|side| {
                let rises = surface.normal.dot(side.direction);
                let is_ahead = rises > R::MICRO;
                // The side of another obstacle lies on this one.
                let is_shut = rises.abs() <= R::MICRO
                    && along.dot(side.direction) > R::ZERO
                    && surface.normal.dot(side.normal) < R::ZERO;
                let is_in_front = |nearest| angle(side.direction) > nearest + flat;
                !is_shut && (!is_ahead || nearest.is_none_or(is_in_front))
            })
        };
        // At an end of the side only the direction back along it remains.
        let [low, high] = scene.reach(contact);
        let foot = self.foot(scene, contact);
        let (to_low, to_high) = (foot - low, high - foot);
        let least = together::<R>().min(to_low.max(to_high));
        let ways = [(to_high, surface.tangent), (to_low, -surface.tangent)];
        let mut ways = ways.into_iter().filter(|&(room, _)| room >= least);
        // The side goes on behind a half-plane.
        let is_behind = |along: Vec2<R>| {
            let mut surfaces = scene.surface_indices();
            surfaces.any(|surface| self.goes_behind(scene, (surface, contact), along))
        };
        ways.any(|(_, along)| !is_behind(along) && is_in_front(along))
    }

    /// The cost of finding these contacts, in gaps.
    pub(super) fn work_of_touching<W: World<R>>(&self, scene: &W, tolerance: R) -> u32 {
        let radius = self.radius(scene, None) + tolerance;
        self.work_within(scene, radius, Sizes::touching)
    }

    /// The cost of finding the contacts that touch to within the tolerance of a closing gap, in units of work.
    pub(crate) fn touching_work<W: World<R>>(&self, scene: &W) -> u32 {
        units(self.work_of_touching(scene, R::TOUCH.doubled()))
    }

    /// The cost, in gaps, of processing each obstacle that may be nearer than a radius.
    fn work_within<W: World<R>>(&self, scene: &W, radius: R, work: fn(Sizes) -> u32) -> u32 {
        let each = scene.rounds().iter().enumerate().map(|(obstacle, round)| {
            if self.apart(round) > radius {
                1
            } else {
                work(Sizes::of_one(scene, obstacle))
            }
        });
        each.fold(0, u32::saturating_add)
    }

    /// All contacts with obstacles whose gap is below `tolerance`, in the order of obstacles, vertices first.
    pub(in crate::detect) fn touching_obstacles<W: World<R>>(
        &self,
        scene: &W,
        tolerance: R,
        list: &mut Pairs,
    ) {
        let radius = self.radius(scene, None) + tolerance;
        for (obstacle, round) in scene.rounds().iter().enumerate() {
            if self.apart(round) > radius || self.separation(scene, obstacle) > tolerance {
                continue;
            }
            let own = corners(scene, obstacle);
            let vertices = sides(own.clone()).flat_map(|side| {
                let surface = line_of(scene, side);
                scene
                    .vertex_indices()
                    .map(move |vertex| Pair { vertex, surface })
            });
            let is_bare = |&corner: &u8| scene.corner(corner).is_some_and(|c| !c.covered);
            let corners = own.filter(is_bare).flat_map(|corner| {
                sides(scene.vertex_indices()).map(move |side| Pair::of_corner(corner, side))
            });
            let pairs = vertices.chain(corners).filter(|&pair| {
                self.gap(scene, pair).abs() <= tolerance
                    && self.beyond(scene, pair) <= tolerance
                    && self.supports(scene, pair, tolerance)
                    && self.meets(scene, pair, tolerance)
            });
            for pair in pairs {
                if !list.contains(&pair) {
                    // Contacts that do not fit are not counted.
                    let _ = list.push(pair);
                }
            }
        }
    }

    /// Returns whether only one of two contacts with obstacles can exist. Contacts of one obstacle: at one place or facing away from each
    /// other, as convex shapes touch in one line at most; of two obstacles: where their corners meet in a tip, or as sides that face either
    /// side of a bent wall.
    pub(crate) fn are_one<W: World<R>>(&self, scene: &W, [a, b]: [Pair; 2]) -> bool {
        let (Some(of_a), Some(of_b)) = (scene.obstacle_of(a), scene.obstacle_of(b)) else {
            return false;
        };
        let [first, second] = [a, b].map(|pair| scene.face(pair, self.orientation.rotation()));
        let is_here = self.are_at_one_place(scene, [a, b]);
        if of_a == of_b {
            let apart = self.arm_to(scene, b) - self.arm_to(scene, a);
            // By the heights: the tilt of a body that lies flat to within a touch at either end is larger over a short side.
            let is_off = |normal: Vec2<R>| normal.dot(apart).abs() > R::from_int(4) * R::MICRO;
            let faces_away = first.normal.dot(second.normal) <= R::ZERO;
            return is_here || faces_away || is_off(first.normal) || is_off(second.normal);
        }
        if a.is_corner() || b.is_corner() {
            return is_here;
        }
        if !is_here {
            return self.ends_behind(scene, [a, b]) || self.ends_behind(scene, [b, a]);
        }
        let (Some(along_a), Some(along_b)) =
            (self.way_from_end(scene, a), self.way_from_end(scene, b))
        else {
            return false;
        };
        // Sides that end at one point bound the free region there if each is in front of the other, with nothing else in between.
        let place = (self.point + self.arm_to(scene, a), self.here());
        let is_between = |side: Vec2<R>| {
            let angle = |side: Vec2<R>| first.normal.dot(side).atan2(along_a.dot(side));
            first.normal.dot(side) > R::MICRO && angle(side) + R::MICRO < angle(along_b)
        };
        along_a.dot(second.normal) < -R::MICRO
            || along_b.dot(first.normal) < -R::MICRO
            || leaving(scene, place, [of_a, of_b]).any(|side| is_between(side.direction))
    }

    /// Returns whether the side of the second contact, which is at its end, ends on the side of the first and continues behind it.
    fn ends_behind<W: World<R>>(&self, scene: &W, [front, contact]: [Pair; 2]) -> bool {
        let goes_behind = |along| self.goes_behind(scene, (front.surface, contact), along);
        self.way_from_end(scene, contact).is_some_and(goes_behind)
    }

    /// Returns whether the vertex of a contact is on another surface, too, and a direction leads behind that surface.
    fn goes_behind<W: World<R>>(
        &self,
        scene: &W,
        (surface, contact): (u8, Pair),
        along: Vec2<R>,
    ) -> bool {
        let there = Pair { surface, ..contact };
        // It is located no more accurately than it lies on its own side.
        let off = (self.gap(scene, contact).abs()).max(self.beyond(scene, contact));
        let known_to = self.here().max(off.doubled());
        along.dot(scene.surface(surface).normal) < -R::MICRO
            && self.gap(scene, there).abs() <= known_to
            && self.beyond(scene, there) <= known_to
    }

    /// The direction in which the side of a contact continues from its end, if the contact is there.
    pub(super) fn way_from_end<W: World<R>>(&self, scene: &W, contact: Pair) -> Option<Vec2<R>> {
        let tangent = scene.face(contact, self.orientation.rotation()).tangent;
        let [low, high] = scene.reach(contact);
        let foot = self.foot(scene, contact);
        let along = if foot - low < high - foot {
            tangent
        } else {
            -tangent
        };
        (self.beyond(scene, contact) > -self.here()).then_some(along)
    }

    pub(super) fn are_at_one_place<W: World<R>>(&self, scene: &W, [a, b]: [Pair; 2]) -> bool {
        let apart = self.arm_to(scene, a) - self.arm_to(scene, b);
        apart.length_bound() <= together()
    }

    /// The outermost two of collinear contacts.
    pub(crate) fn outermost<W: World<R>>(&self, scene: &W, contacts: &Pairs) -> Pairs {
        let is_inner = |&pair: &Pair| {
            let tangent = scene.face(pair, self.orientation.rotation()).tangent;
            let arm = self.arm_to(scene, pair);
            let in_line = |&&other: &&Pair| other != pair && self.lie_in_line(scene, [pair, other]);
            let along = |other: &Pair| tangent.dot(self.arm_to(scene, *other) - arm);
            let others = || contacts.iter().filter(in_line).map(along);
            others().any(|x| x > R::ZERO) && others().any(|x| x < R::ZERO)
        };
        gather(contacts.iter().copied().filter(|pair| !is_inner(pair)))
    }
}
