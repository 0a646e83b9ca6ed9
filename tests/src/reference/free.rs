//! Motion out of contact with the hand frozen: the pose in which only hand and weight act, and the way there, looked at for
//! the first touch.

use super::contact::Touch;
use super::scene::{Pose, add, scale, sub};
use super::search::{bisect, descend};
use super::walk::End;
use super::{CLEARANCE, Reference};

/// Looks at the gaps on the way.
const LOOKS: u32 = 2000;

impl Reference {
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
        at(descend(self.pose.angle, f64::INFINITY, moment).unwrap_or(self.pose.angle))
    }

    /// Moves straight, holding point and orientation, to the free pose, or to the first touch if that pose is blocked. The
    /// contacts in `left` count again once they are open.
    pub(super) fn sweep(&self, left: &[Touch], hand: [f64; 3]) -> (Pose, End) {
        let target = self.free_pose(hand);
        if !self.enters(&target, CLEARANCE) {
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
                return (at(before), End::Touch);
            }
            closed.retain(|&(touch, _)| self.still_closed(&at(next), touch));
            seer.pose = at(next);
            seer.look();
        }
        (self.pose, End::Lost)
    }
}
