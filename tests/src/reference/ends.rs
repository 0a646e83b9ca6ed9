//! Which pairs touch, and what follows when one of them reaches the end of its side. A flat contact is represented by two contacts
//! in one line, at the ends of the interval in which the sides touch. A single contact is replaced by the pair at the same place
//! whose normal comes next in the direction of the slide.

use super::cone::times;
use super::contact::{Touch, sides};
use super::relax::{Carry, Driven};
use super::scene::{Pose, dot, length, scale, sub};
use super::statics::sign;
use super::{BESIDE, Reference};

/// Pairs that close within this distance of the first one touch simultaneously, in body sizes.
const TOGETHER: f64 = 1e-10;
/// The first pair that touches is closer than this, in body sizes: the accuracy of a motion that ends with a touch.
const FIRST: f64 = 1e-6;
/// Contacts on one obstacle that are closer than this are one, in body sizes.
const OVERLAP: f64 = 1.0 / 524_288.0;
/// Lines closer than this are one, in rad and body sizes.
pub(super) const LINE: f64 = 1e-6;
/// Normals closer than this are equal, rad.
const NORMAL: f64 = 1e-9;

impl Reference {
    /// All pairs of the body with an obstacle that could ever touch.
    fn obstacle_pairs(&self) -> Vec<Touch> {
        let body = &self.scene.vertices;
        let mut pairs = Vec::new();
        for (obstacle, shape) in self.scene.obstacles.iter().enumerate() {
            let shape = &shape.vertices;
            let first = |&side: &usize| self.scene.run(obstacle, side).0 == (obstacle, side);
            for side in (0..sides(shape)).filter(first) {
                pairs.extend((0..body.len()).map(|vertex| Touch::Side {
                    vertex,
                    obstacle,
                    side,
                }));
            }
            for corner in (0..shape.len()).filter(|&k| !self.scene.covered(obstacle, k)) {
                pairs.extend((0..sides(body)).map(|body_side| Touch::Corner {
                    obstacle,
                    corner,
                    body_side,
                }));
            }
        }
        pairs
    }

    /// Whether the sides next to the vertex or corner lead away from the side that it touches, or into it by at most
    /// `depth`, m.
    fn supports(&self, pose: &Pose, touch: Touch, depth: f64) -> bool {
        let (index, shape) = match touch {
            Touch::Surface { .. } => return true,
            Touch::Side { vertex, .. } => {
                let world = self.scene.vertices.iter().map(|&v| pose.apply(v));
                (vertex, world.collect::<Vec<_>>())
            }
            Touch::Corner {
                obstacle, corner, ..
            } => (corner, self.scene.obstacles[obstacle].vertices.clone()),
        };
        let way = if touch.vertex().is_some() { 1.0 } else { -1.0 };
        let count = shape.len();
        let outwards = scale(way, self.scene.normal(pose, touch));
        [index + 1, index + count - 1]
            .iter()
            .all(|next| dot(outwards, sub(shape[next % count], shape[index])) >= -depth)
    }

    /// The pairs that touch within `tolerance` body sizes, except those already in contact.
    pub(super) fn touching(&self, pose: &Pose, tolerance: f64) -> Vec<Touch> {
        let near = tolerance * self.size;
        let obstacles = self.obstacle_pairs().into_iter().filter(|&touch| {
            self.scene.gap(pose, touch).abs() <= near
                && self.scene.beyond(pose, touch) <= BESIDE * self.size
                && !self.on_far_side(touch)
                && !self.goes_behind(pose, touch)
                && self.supports(pose, touch, near)
        });
        self.surface_pairs()
            .filter(|&touch| self.scene.gap(pose, touch) <= near)
            .chain(obstacles)
            .filter(|touch| !self.contacts.contains(touch))
            .collect()
    }

    /// Whether a vertex meets the end of a side at a contact with a side of another obstacle, behind which the first side continues:
    /// where two thin walls meet, a body on one side of both does not touch the other side of either.
    fn goes_behind(&self, pose: &Pose, touch: Touch) -> bool {
        let (Touch::Side { obstacle, .. }, Some([low, high])) = (touch, self.scene.reach(touch))
        else {
            return false;
        };
        let at = self.scene.point(pose, touch);
        let place = self.scene.place(pose, touch);
        let inwards = if place - low < high - place {
            1.0
        } else {
            -1.0
        };
        let onwards = scale(inwards, self.scene.tangent(pose, touch));
        let is_at_end = (place - low).min(high - place) <= OVERLAP * self.size;
        is_at_end
            && self.contacts.iter().any(|&other| {
                matches!(other, Touch::Side { .. })
                    && other.obstacle() != Some(obstacle)
                    && length(sub(self.scene.point(pose, other), at)) <= OVERLAP * self.size
                    && dot(self.scene.normal(pose, other), onwards) < -LINE
            })
    }

    /// Adds the pairs that have come into contact; returns whether the contacts have changed.
    pub(super) fn take_up(&mut self) -> bool {
        let mut new = self.touching(&self.pose, TOGETHER);
        if new.is_empty() {
            let first = if self.scene.obstacles.is_empty() {
                f64::INFINITY
            } else {
                FIRST
            };
            let gap = |touch: &Touch| self.scene.gap(&self.pose, *touch);
            let near = self.touching(&self.pose, first);
            new.extend(near.into_iter().min_by(|a, b| gap(a).total_cmp(&gap(b))));
        }
        let before = self.contacts.clone();
        self.contacts.extend(new);
        self.reduce(before.len());
        self.pose = self.onto(self.pose, &self.contacts);
        self.look();
        self.contacts != before
    }

    /// Keeps one contact of an obstacle at one place, and two in one line. The first `old` contacts give way to new ones: a body
    /// that turns about such a short overlap continues about its other end. Of several new ones at one place, the one that closed
    /// last stays.
    pub(super) fn reduce(&mut self, old: usize) {
        let new = self.contacts.split_off(old);
        let mut new: Vec<_> = new
            .into_iter()
            .map(|touch| (self.scene.gap(&self.before, touch), touch))
            .collect();
        new.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let together = |a: Touch, b: Touch| {
            let [a_at, b_at] = [a, b].map(|touch| self.scene.point(&self.pose, touch));
            a.obstacle().is_some()
                && a.obstacle() == b.obstacle()
                && length(sub(b_at, a_at)) <= OVERLAP * self.size
        };
        let mut found: Vec<Touch> = Vec::new();
        for (_, touch) in new {
            if !found.iter().any(|&other| together(touch, other)) {
                found.push(touch);
            }
        }
        let mut staying = self.contacts.clone();
        staying.retain(|&touch| !found.iter().any(|&other| together(touch, other)));
        staying.extend(found);
        let inner = |&touch: &Touch| {
            let tangent = self.scene.tangent(&self.pose, touch);
            let way = |&other: &Touch| {
                let apart = sub(
                    self.scene.point(&self.pose, other),
                    self.scene.point(&self.pose, touch),
                );
                let in_line = other != touch && self.lined(&self.pose, [touch, other]);
                in_line.then(|| dot(tangent, apart))
            };
            let ways: Vec<_> = staying.iter().filter_map(way).collect();
            ways.iter().any(|&x| x > 0.0) && ways.iter().any(|&x| x < 0.0)
        };
        let mut ends: Vec<_> = staying
            .iter()
            .copied()
            .filter(|touch| !inner(touch))
            .collect();
        ends.sort();
        self.contacts = ends;
    }

    /// Whether two contacts lie on one line.
    pub(super) fn lined(&self, pose: &Pose, pair: [Touch; 2]) -> bool {
        self.scene.in_line(pose, pair, (self.size, LINE))
    }

    /// Whether the contacts are the two ends of a flat contact.
    pub(super) fn flat(&self) -> bool {
        matches!(*self.contacts.as_slice(), [a, b] if self.lined(&self.pose, [a, b]))
    }

    /// The contact that has left its side.
    pub(super) fn off_side(&self, pose: &Pose, contacts: &[Touch]) -> Option<usize> {
        contacts
            .iter()
            .position(|&touch| self.scene.beyond(pose, touch) > BESIDE * self.size)
    }

    /// The pair at the place of a contact at the end of its side whose normal comes next as the body moves along `way` times the tangent.
    fn next_pair(&self, touch: Touch, way: f64) -> Option<Touch> {
        let scene = &self.scene;
        let near = OVERLAP * self.size;
        let (normal, at) = (
            scene.normal(&self.pose, touch),
            scene.point(&self.pose, touch),
        );
        let ahead = scale(way, scene.tangent(&self.pose, touch));
        let turn = |&next: &Touch| {
            let next = scene.normal(&self.pose, next);
            dot(next, ahead).atan2(dot(next, normal))
        };
        let here = |next: &Touch| {
            let least = if next.obstacle() == touch.obstacle() {
                NORMAL
            } else {
                -NORMAL
            };
            length(sub(scene.point(&self.pose, *next), at)) <= near
                && scene.gap(&self.pose, *next).abs() <= near
                && scene.beyond(&self.pose, *next) <= near
                && turn(next) > least
        };
        self.obstacle_pairs()
            .into_iter()
            .filter(|next| !self.contacts.contains(next) && here(next))
            .min_by(|a, b| turn(a).total_cmp(&turn(b)).then(a.cmp(b)))
    }

    /// Handles a contact that slides along `way` and has left its side. If it was an end of a flat contact, the new end is
    /// found, and the motion goes on if the contact is still flat: then this returns true. Any other contact is replaced by
    /// the next pair, and a slip in the same direction or free motion follows.
    pub(super) fn pass_on(
        &mut self,
        (index, way): (usize, f64),
        hand: [f64; 3],
        carry: &mut Carry,
    ) -> bool {
        let flat = self.flat();
        let touch = self.contacts.remove(index);
        if flat {
            self.refit(touch);
            return self.contacts.len() == 2;
        }
        let next = self.next_pair(touch, way);
        carry.began = None;
        if let Some(next) = next {
            self.contacts.push(next);
            self.contacts.sort();
            self.pose = self.onto(self.pose, &self.contacts);
            if let Touch::Side { obstacle, side, .. } = next {
                self.sees(obstacle, side);
            }
        }
        match (next, self.contacts.as_slice()) {
            (Some(next), [_]) => {
                let normal = self.reaction(&self.pose, next, hand)[0];
                if normal > self.force_tolerance(&self.pose, hand) {
                    carry.driven = Some(Driven::Vertex(next, way));
                } else {
                    self.contacts.clear();
                }
            }
            (Some(next), &[a, b]) => self.pair_goes_on(([a, b], next, way), hand, carry),
            _ => carry.slipping = true,
        }
        false
    }

    /// One of two slipping contacts has a new normal: it opens if nothing presses on it any more; otherwise both continue to slip if
    /// the load drives them.
    fn pair_goes_on(
        &mut self,
        (pair, new, way): ([Touch; 2], Touch, f64),
        hand: [f64; 3],
        carry: &mut Carry,
    ) {
        carry.slipping = true;
        let index = usize::from(pair[1] == new);
        let twist = self.free_twist(&self.pose, pair);
        let onward = sign(way * self.speeds(&self.pose, pair, twist)[index]);
        let twist = times(onward, twist);
        let Some(state) = self.sliding(&self.pose, pair, twist, hand) else {
            return;
        };
        if state.normals[index] <= self.force_tolerance(&self.pose, hand) {
            self.contacts.remove(index);
        } else if state.drive > 0.0 {
            carry.driven = Some(Driven::Pair(pair, twist));
        }
    }

    /// Determines the ends of a flat contact again, without the pair that was one of them.
    fn refit(&mut self, lost: Touch) {
        let staying = self.contacts.clone();
        let mut new = self.touching(&self.pose, TOGETHER);
        new.retain(|&touch| {
            touch != lost
                && staying
                    .iter()
                    .all(|&other| self.lined(&self.pose, [other, touch]))
        });
        self.contacts.extend(new);
        self.reduce(staying.len());
        self.pose = self.onto(self.pose, &self.contacts);
    }
}
