//! Motion with the hand frozen, in tiny steps, each looked at for what ends it: turning about a pinned vertex, sliding on one
//! vertex, sliding on two, and moving freely. The first step with an end is bisected.

use super::Reference;
use super::cone::{inner, norm, normal_to, times};
use super::scene::{Pose, Screw, Touch, add, scale, sub};
use super::statics::sign;

/// Largest turn in one look at the moment, rad.
const TURN: f64 = 1e-3;
/// A turn by more than this in one step of something else is a snap, rad.
pub(super) const SNAP: f64 = 0.03;
/// Largest step of a slide, in body sizes.
const SLIDE: f64 = 1e-3;
/// Smallest step of a slide, in body sizes: below, a snap is not resolved further.
const SMALLEST: f64 = 1e-13;
/// Looks at the gaps during a free move.
const LOOKS: u32 = 2000;
/// Steps after which a slide is given up.
const MANY: u32 = 200_000;

/// What ended a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// The load is balanced (in a slide: by dynamic friction).
    Rest,
    /// Other vertices have come into contact: see the pose.
    Touch,
    /// The contact of this index no longer presses.
    Lift(usize),
    /// The body turns by a finite angle without moving on.
    Snap,
    /// No end was found.
    Lost,
}

impl Reference {
    /// Whether a vertex that is not in contact is deeper inside a surface than `depth` body sizes.
    pub(super) fn enters(&self, pose: &Pose, depth: f64) -> bool {
        self.others()
            .any(|touch| self.scene.gap(pose, touch) < -depth * self.size)
    }

    /// The same where the vertices and surfaces in `closed` may have a gap down to the one given with each.
    fn enters_beside(&self, pose: &Pose, closed: &[(Touch, f64)], depth: f64) -> bool {
        let least = |touch| {
            closed
                .iter()
                .find(|(other, _)| *other == touch)
                .map_or(0.0, |&(_, gap)| gap)
        };
        self.others()
            .any(|touch| self.scene.gap(pose, touch) < least(touch) - depth * self.size)
    }

    /// The vertices and surfaces that are not in contact.
    pub(super) fn others(&self) -> impl Iterator<Item = Touch> + '_ {
        self.scene
            .touches()
            .filter(|touch| !self.contacts.contains(touch))
    }

    /// Turns about the pinned `vertex` in the direction of the moment until it is balanced, another vertex touches (if
    /// `watched`), or, with `Snap`, by more than `limit`.
    pub(super) fn turn(
        &self,
        pose: &Pose,
        vertex: usize,
        hand: [f64; 3],
        (limit, watched): (f64, bool),
    ) -> (Pose, End) {
        let held = self.scene.vertices[vertex];
        let pin = pose.apply(held);
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
            let enters = watched && self.enters(&at(next), super::CLEARANCE);
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

    /// Slides the vertex of `touch` along `way` times the tangent, the moment balanced at every position, until dynamic
    /// friction holds it. The contacts in `left` may close no further; they count again once they are open.
    pub(super) fn slide_vertex(
        &self,
        (touch, way): (Touch, f64),
        left: &[Touch],
        hand: [f64; 3],
    ) -> (Pose, End) {
        let surface = &self.scene.surfaces[touch.surface];
        let mut pose = self.pose;
        let mut step = SLIDE * self.size;
        let at = |pose: &Pose, distance: f64| {
            let shift = scale(way * distance, surface.tangent());
            let moved = Pose {
                position: add(pose.position, shift),
                angle: pose.angle,
            };
            self.turn(&moved, touch.vertex, hand, (SNAP, false))
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
            } else if self.enters_beside(pose, closed, depth) {
                Some(End::Touch)
            } else if normal < 0.0 {
                Some(End::Lift(0))
            } else {
                (-way * friction <= surface.mu_d * normal).then_some(End::Rest)
            }
        };
        for _ in 0..MANY {
            let next = at(&pose, step);
            match end(&next, &closed, super::CLEARANCE) {
                None => {
                    pose = next.0;
                    closed.retain(|&(touch, _)| {
                        self.scene.gap(&pose, touch) < super::CLEARANCE * self.size
                    });
                    step = (2.0 * step).min(SLIDE * self.size);
                }
                Some(End::Snap) if step > SMALLEST * self.size => step /= 2.0,
                Some(first) => {
                    let depth = if first == End::Touch {
                        0.0
                    } else {
                        super::CLEARANCE
                    };
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

    /// Slides two contacts along the motion that keeps both gaps, starting along `way`, until dynamic friction holds them.
    pub(super) fn slide_pair(&self, pair: [Touch; 2], way: Screw, hand: [f64; 3]) -> (Pose, End) {
        let (mut pose, mut way) = (self.pose, way);
        let Some(start) = self.sliding(&pose, pair, way, hand) else {
            return (pose, End::Lost);
        };
        let at = |pose: &Pose, way: Screw, distance: f64| {
            self.onto(pose.moved(times(distance, way), self.size), &pair)
        };
        let ahead = |pose: &Pose, way: Screw| {
            let twist = self.free_twist(pose, pair);
            times(sign(inner(twist, way)), twist)
        };
        let end = |pose: &Pose, way: Screw, depth: f64| {
            if self.enters(pose, depth) {
                return Some(End::Touch);
            }
            let Some(now) = self.sliding(pose, pair, ahead(pose, way), hand) else {
                return Some(End::Rest);
            };
            if now.excess * start.excess <= 0.0 {
                return Some(End::Rest);
            }
            now.normals
                .iter()
                .position(|&normal| normal < -self.force_tolerance(pose, hand))
                .map(End::Lift)
        };
        let step = SLIDE * self.size;
        for _ in 0..MANY {
            let next = at(&pose, way, step);
            let Some(first) = end(&next, way, super::CLEARANCE) else {
                way = ahead(&next, way);
                pose = next;
                continue;
            };
            let depth = if first == End::Touch {
                0.0
            } else {
                super::CLEARANCE
            };
            let (before, after) = bisect(0.0, step, |distance| {
                end(&at(&pose, way, distance), way, depth).is_some()
            });
            let last = at(&pose, way, after);
            return match end(&last, way, depth) {
                Some(End::Touch) | None => (at(&pose, way, before), End::Touch),
                Some(found) => (last, found),
            };
        }
        (pose, End::Lost)
    }

    /// The nearest pose at which all `contacts` have gap zero.
    pub(super) fn onto(&self, mut pose: Pose, contacts: &[Touch]) -> Pose {
        let rounds = if contacts.len() > 2 { 60 } else { 6 };
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
                let line = self.normal_line(&pose, worst);
                times(gap(worst) / inner(line, line), line)
            };
            pose = pose.moved(correction, self.size);
        }
        pose
    }

    /// The pose in which only hand and weight act, from where the body is: the orientation follows the moment.
    pub(super) fn free_pose(&self, hand: [f64; 3]) -> Pose {
        let scene = &self.scene;
        let grip = sub([hand[0], hand[1]], [0.0, scene.weight / scene.k_h]);
        let at = |angle| Pose::holding(scene.holding_point, grip, angle);
        if scene.weight == 0.0 {
            return at(if scene.k_theta > 0.0 {
                hand[2]
            } else {
                self.pose.angle
            });
        }
        let moment = |angle| scene.applied_moment(&at(angle), hand, grip);
        let way = sign(moment(self.pose.angle));
        let mut angle = self.pose.angle;
        if way == 0.0 {
            return at(angle);
        }
        loop {
            let next = dip(angle, angle + way * TURN, |x| way * moment(x));
            if way * moment(next) <= 0.0 {
                return at(bisect(angle, next, |x| way * moment(x) <= 0.0).1);
            }
            angle = next;
        }
    }

    /// Moves straight, holding point and orientation, to the free pose, or to the first touch if that pose is blocked. The
    /// contacts in `left` count again once they are open.
    pub(super) fn sweep(&self, left: &[Touch], hand: [f64; 3]) -> (Pose, End) {
        let target = self.free_pose(hand);
        if !self.enters(&target, super::CLEARANCE) {
            return (target, End::Rest);
        }
        let held = self.scene.holding_point;
        let from = self.pose.apply(held);
        let shift = sub(target.apply(held), from);
        let turn = target.angle - self.pose.angle;
        let at = |part: f64| {
            Pose::holding(
                held,
                add(from, scale(part, shift)),
                self.pose.angle + part * turn,
            )
        };
        let mut closed: Vec<_> = left
            .iter()
            .map(|&touch| (touch, f64::NEG_INFINITY))
            .collect();
        for look in 0..LOOKS {
            let (now, next) = (
                f64::from(look) / f64::from(LOOKS),
                f64::from(look + 1) / f64::from(LOOKS),
            );
            if self.enters_beside(&at(next), &closed, super::CLEARANCE) {
                let (before, _) = bisect(now, next, |part| {
                    self.enters_beside(&at(part), &closed, 0.0)
                });
                return (at(before), End::Touch);
            }
            closed.retain(|&(touch, _)| {
                self.scene.gap(&at(next), touch) < super::CLEARANCE * self.size
            });
        }
        (self.pose, End::Lost)
    }
}

/// The lowest point between `from` and `to` if `height` falls at the one and rises at the other and is not positive there;
/// `to` otherwise.
fn dip(from: f64, to: f64, height: impl Fn(f64) -> f64) -> f64 {
    let at = |part: f64| from + part * (to - from);
    let rises = |part: f64| height(at(part + 1e-3)) > height(at(part));
    if height(to) <= 0.0 || rises(0.0) || !rises(1.0) {
        return to;
    }
    let (bottom, _) = bisect(0.0, 1.0, rises);
    if height(at(bottom)) <= 0.0 {
        at(bottom)
    } else {
        to
    }
}

/// The last point before and the first point after `crossed` becomes true between `low` (false) and `high` (true).
pub(super) fn bisect(mut low: f64, mut high: f64, crossed: impl Fn(f64) -> bool) -> (f64, f64) {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            break;
        }
        if crossed(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    (low, high)
}
