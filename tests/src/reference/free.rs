//! Motion out of contact with the hand frozen: the pose in which only hand and weight act, and the path to it, searched for
//! the first touch.

use super::contact::Touch;
use super::scene::{Pose, add, scale, sub};
use super::search::{bisect, descend};
use super::walk::End;
use super::{CLEARANCE, Reference};

/// Number of points on the path at which the gaps are evaluated.
const LOOKS: u32 = 2000;
/// A path that ends within this fraction of its length is blocked from the start: some thousand roundings.
const AT_ONCE: f64 = 1e-12;

impl Reference {
    /// The pose in which only hand and weight act, reached from the current pose: the orientation follows the moment.
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
        at(descend(self.pose.angle, f64::INFINITY, moment).unwrap_or(self.pose.angle))
    }

    /// Moves straight, in holding point and orientation, to the free pose, or to the first touch if the path to it is blocked. If
    /// a contact that was just left blocks it immediately, the holding point moves first and the body turns afterwards.
    pub(super) fn sweep(&self, left: &[Touch], hand: [f64; 3]) -> (Pose, End) {
        let target = self.free_pose(hand);
        if self.scene.obstacles.is_empty() && !self.enters(&target, CLEARANCE) {
            return (target, End::Rest);
        }
        let both = |part: f64| [part, part];
        let in_turn = |part: f64| [(2.0 * part).min(1.0), (2.0 * part - 1.0).max(0.0)];
        let (part, pose, end) = self.along(&target, left, both);
        if end == End::Touch && part <= AT_ONCE && !left.is_empty() {
            let (_, pose, end) = self.along(&target, left, in_turn);
            return (pose, end);
        }
        (pose, end)
    }

    /// Moves to `target`; `parts` gives the fractions of shift and turn at each point of the path. Returns how far the body comes.
    /// The contacts in `left` count again once they are open; until then, those on obstacles must not close further.
    fn along(
        &self,
        target: &Pose,
        left: &[Touch],
        parts: impl Fn(f64) -> [f64; 2],
    ) -> (f64, Pose, End) {
        let held = self.scene.holding_point;
        let from = self.pose.apply(held);
        let shift = sub(target.apply(held), from);
        let turn = target.angle - self.pose.angle;
        let at = |part: f64| {
            let [shifted, turned] = parts(part);
            Pose::holding(
                held,
                add(from, scale(shifted, shift)),
                self.pose.angle + turned * turn,
            )
        };
        let least = |touch: Touch| match touch {
            Touch::Surface { .. } => f64::NEG_INFINITY,
            _ => self.scene.gap(&self.pose, touch).min(0.0),
        };
        let mut closed: Vec<_> = left.iter().map(|&touch| (touch, least(touch))).collect();
        let mut seer = self.clone();
        for look in 0..LOOKS {
            let (now, next) = (
                f64::from(look) / f64::from(LOOKS),
                f64::from(look + 1) / f64::from(LOOKS),
            );
            if seer.enters_beside(&at(next), &closed, CLEARANCE) {
                let (before, _) = bisect(now, next, |part| {
                    seer.enters_beside(&at(part), &closed, 0.0)
                });
                return (before, at(before), End::Touch);
            }
            closed.retain(|&(touch, _)| self.still_closed(&at(next), touch));
            seer.pose = at(next);
            seer.look();
        }
        if seer.enters(target, CLEARANCE) {
            (0.0, self.pose, End::Lost)
        } else {
            (1.0, *target, End::Rest)
        }
    }
}
