//! Motion in contact with the hand frozen, in tiny steps, each checked for an event that ends it: turning about a pinned
//! vertex, sliding on one vertex and sliding on two. The first step with such an event is bisected.

use super::cone::{inner, norm, normal_to, times};
use super::contact::Touch;
use super::scene::{Pose, Screw, add, scale};
use super::search::{bisect, dip};
use super::statics::sign;
use super::{BESIDE, CLEARANCE, Reference, TURN};

/// During another motion, a turn by more than this in one step is a snap, rad.
pub(super) const SNAP: f64 = 0.03;
/// Largest step of a slide, in body sizes.
pub(super) const SLIDE: f64 = 1e-3;
/// Smallest step of a slide, in body sizes: a snap is not resolved more finely.
pub(super) const SMALLEST: f64 = 1e-13;
/// Steps after which a slide is abandoned.
const MANY: u32 = 200_000;

/// Rounds in which three or more contacts are brought to gap zero, one after the other: contacts with a short overlap
/// converge slowly.
const ROUNDS: u32 = 100_000;

/// What ended a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// The load is balanced (in a slide: by dynamic friction).
    Rest,
    /// Other vertices have come into contact: the pose shows which.
    Touch,
    /// The contact with this index no longer presses.
    Lift(usize),
    /// The contact with this index has left its side.
    Off(usize),
    /// The body turns by a finite angle without a displacement.
    Snap,
    /// No end was found.
    Lost,
}

impl End {
    /// How deep a vertex may be inside a surface, in body sizes, while the position of this end is bisected.
    fn depth(self) -> f64 {
        match self {
            Self::Touch => 0.0,
            _ => CLEARANCE,
        }
    }
}

impl Reference {
    /// Whether a contact that was left has not opened yet.
    pub(super) fn still_closed(&self, pose: &Pose, touch: Touch) -> bool {
        self.scene.gap(pose, touch) < CLEARANCE * self.size
            && self.scene.beyond(pose, touch) <= BESIDE * self.size
    }

    /// Turns about a sticking contact in the direction of the moment until the moment is balanced, another vertex
    /// touches (if `watched`), or, with `Snap`, the turn exceeds `limit`.
    pub(super) fn turn(
        &self,
        pose: &Pose,
        touch: Touch,
        hand: [f64; 3],
        (limit, watched): (f64, bool),
    ) -> (Pose, End) {
        let held = self.scene.held(pose, touch);
        let pin = self.scene.point(pose, touch);
        let at = |angle| Pose::holding(held, pin, angle);
        let moment = |angle| self.scene.applied_moment(&at(angle), hand, pin);
        let way = sign(moment(pose.angle));
        if way == 0.0 {
            return (*pose, End::Rest);
        }
        let mut angle = pose.angle;
        loop {
            if (angle - pose.angle).abs() > limit {
                return (at(angle), End::Snap);
            }
            let next = dip(angle, angle + way * TURN, |x| way * moment(x));
            let enters = watched && self.enters(&at(next), CLEARANCE);
            if !enters && way * moment(next) > 0.0 {
                angle = next;
                continue;
            }
            let inside = |x| enters && self.enters(&at(x), 0.0);
            let (before, after) = bisect(angle, next, |x| inside(x) || way * moment(x) <= 0.0);
            if inside(after) {
                return (at(before), End::Touch);
            }
            return (at(after), End::Rest);
        }
    }

    /// The pose with the body moved along `way` times the tangent of a contact.
    pub(super) fn shifted(&self, pose: &Pose, (touch, way): (Touch, f64), distance: f64) -> Pose {
        let shift = scale(way * distance, self.scene.tangent(pose, touch));
        Pose {
            position: add(pose.position, shift),
            angle: pose.angle,
        }
    }

    /// Slides the contact along `way` times the tangent, with the moment balanced at every position, until dynamic
    /// friction holds it. The contacts in `left` must not close further; they count again once they are open.
    pub(super) fn slide_vertex(
        &self,
        (touch, way): (Touch, f64),
        left: &[Touch],
        hand: [f64; 3],
    ) -> (Pose, End) {
        let mu_d = self.scene.friction(touch).mu_d;
        let mut pose = self.pose;
        let mut step = SLIDE * self.size;
        let at = |pose: &Pose, distance: f64| {
            let moved = self.shifted(pose, (touch, way), distance);
            self.turn(&moved, touch, hand, (SNAP, false))
        };
        let start = at(&pose, 0.0).0;
        let mut closed: Vec<_> = left
            .iter()
            .map(|&touch| (touch, self.scene.gap(&start, touch).min(0.0)))
            .collect();
        let end = |(pose, turned): &(Pose, End), closed: &[(Touch, f64)], depth: f64| {
            let [normal, friction] = self.reaction(pose, touch, hand);
            if *turned == End::Snap {
                Some(End::Snap)
            } else if self.off_side(pose, &[touch]).is_some() {
                Some(End::Off(0))
            } else if self.enters_beside(pose, closed, depth) {
                Some(End::Touch)
            } else if normal < 0.0 {
                Some(End::Lift(0))
            } else {
                (-way * friction <= mu_d * normal).then_some(End::Rest)
            }
        };
        for _ in 0..MANY {
            let next = at(&pose, step);
            match end(&next, &closed, CLEARANCE) {
                None => {
                    pose = next.0;
                    closed.retain(|&(touch, _)| self.still_closed(&pose, touch));
                    step = (2.0 * step).min(SLIDE * self.size);
                }
                Some(End::Snap) if step > SMALLEST * self.size => step /= 2.0,
                Some(first) => {
                    let depth = first.depth();
                    let (before, after) = bisect(0.0, step, |distance| {
                        end(&at(&pose, distance), &closed, depth).is_some()
                    });
                    let last = at(&pose, after);
                    return match end(&last, &closed, depth) {
                        Some(End::Touch) => (at(&pose, before).0, End::Touch),
                        Some(End::Snap) | None => (pose, End::Snap),
                        Some(found) => (last.0, found),
                    };
                }
            }
        }
        (pose, End::Lost)
    }

    /// The unit twist that keeps both gaps of the pair.
    pub(super) fn free_twist(&self, pose: &Pose, pair: [Touch; 2]) -> Screw {
        let twist = normal_to(
            self.normal_line(pose, pair[0]),
            self.normal_line(pose, pair[1]),
        );
        times(1.0 / norm(twist), twist)
    }

    /// The unit twist that keeps both gaps, in the direction of `way`.
    pub(super) fn onward(&self, pose: &Pose, pair: [Touch; 2], way: Screw) -> Screw {
        let twist = self.free_twist(pose, pair);
        times(sign(inner(twist, way)), twist)
    }

    /// Slides two contacts along the motion that keeps both gaps, starting along `way`, until dynamic friction holds them;
    /// returns the direction at the end as well. A contact that no longer presses ends the slide only if it is `watched`.
    pub(super) fn slide_pair(
        &self,
        pair: [Touch; 2],
        way: Screw,
        hand: [f64; 3],
        watched: bool,
    ) -> (Pose, Screw, End) {
        let (mut pose, mut way) = (self.pose, way);
        let Some(start) = self.sliding(&pose, pair, way, hand) else {
            return (pose, way, End::Lost);
        };
        let at = |pose: &Pose, way: Screw, distance: f64| {
            self.onto(pose.moved(times(distance, way), self.size), &pair)
        };
        let end = |pose: &Pose, way: Screw, depth: f64| {
            if let Some(index) = self.off_side(pose, &pair) {
                return Some(End::Off(index));
            }
            if self.enters(pose, depth) {
                return Some(End::Touch);
            }
            let Some(now) = self.sliding(pose, pair, self.onward(pose, pair, way), hand) else {
                return Some(End::Rest);
            };
            if now.excess * start.whole <= 0.0 {
                return Some(End::Rest);
            }
            let lifts = |&normal: &f64| watched && normal < -self.force_tolerance(pose, hand);
            now.normals.iter().position(lifts).map(End::Lift)
        };
        let step = SLIDE * self.size;
        for _ in 0..MANY {
            let next = at(&pose, way, step);
            let Some(first) = end(&next, way, CLEARANCE) else {
                way = self.onward(&next, pair, way);
                pose = next;
                continue;
            };
            let depth = first.depth();
            let (before, after) = bisect(0.0, step, |distance| {
                end(&at(&pose, way, distance), way, depth).is_some()
            });
            let last = at(&pose, way, after);
            let found = end(&last, way, depth);
            let (pose, end) = match found {
                Some(End::Touch) | None => (at(&pose, way, before), End::Touch),
                Some(found) => (last, found),
            };
            return (pose, self.onward(&pose, pair, way), end);
        }
        (pose, way, End::Lost)
    }

    /// The nearest pose at which all `contacts` have gap zero.
    pub(super) fn onto(&self, mut pose: Pose, contacts: &[Touch]) -> Pose {
        let rounds = match (contacts.len(), self.scene.obstacles.is_empty()) {
            (..3, _) => 6,
            (_, true) => 60,
            (_, false) => ROUNDS,
        };
        for _ in 0..rounds {
            let gap = |touch| -self.scene.gap(&pose, touch);
            let correction = if let [a, b] = *contacts {
                let (first, second) = (self.normal_line(&pose, a), self.normal_line(&pose, b));
                let (aa, ab, bb) = (
                    inner(first, first),
                    inner(first, second),
                    inner(second, second),
                );
                let whole = aa * bb - ab * ab;
                let (wa, wb) = (
                    (gap(a) * bb - gap(b) * ab) / whole,
                    (gap(b) * aa - gap(a) * ab) / whole,
                );
                [0, 1, 2].map(|k| wa * first[k] + wb * second[k])
            } else {
                let Some(worst) = contacts
                    .iter()
                    .copied()
                    .max_by(|&a, &b| gap(a).abs().total_cmp(&gap(b).abs()))
                else {
                    break;
                };
                if rounds == ROUNDS && gap(worst).abs() <= 1e-3 * CLEARANCE * self.size {
                    break;
                }
                let line = self.normal_line(&pose, worst);
                times(gap(worst) / inner(line, line), line)
            };
            pose = pose.moved(correction, self.size);
        }
        pose
    }
}
