//! The body that moves with the hand: its pose for a hand pose slightly further on, while its contacts keep sticking or
//! sliding. The balance of a slide is found by descending along the unbalanced wrench; rates are differences between small
//! displacements to both sides.

use super::Reference;
use super::cone::times;
use super::contact::Touch;
use super::mode::same_vertex;
use super::scene::{Pose, add, scale};
use super::search::{bisect, descend};
use super::statics::sign;
use super::walk::{End, SLIDE, SNAP};

/// Displacement of the hand to each side for a rate, in body sizes.
const REACH: f64 = 3e-5;

impl Reference {
    /// The pose for this hand with the contacts as they are; `None` if balance is lost.
    pub(super) fn followed(&self, hand: [f64; 3]) -> Option<Pose> {
        match (self.contacts.as_slice(), self.slide.as_deref()) {
            ([], _) => Some(self.free_pose(hand)),
            (&[touch], Some(&[way])) => self.slid_vertex((touch, way), hand),
            (&[a, b], Some(&[way, _])) if self.lined(&self.pose, [a, b]) => {
                Some(self.slid_foot(&self.pose, (a, way), hand))
            }
            (&[a, b], Some(&[first, second])) => self.slid_pair([a, b], [first, second], hand),
            ([first, rest @ ..], _) if rest.iter().all(|&touch| same_vertex(touch, *first)) => {
                let (pose, end) = self.turn(&self.pose, *first, hand, (SNAP, false));
                (end == End::Rest).then_some(pose)
            }
            _ => Some(self.pose),
        }
    }

    /// The pose shifted along the surface to where the friction equals dynamic friction against `way`.
    fn slid_foot(&self, pose: &Pose, (touch, way): (Touch, f64), hand: [f64; 3]) -> Pose {
        let shifted = |pose: &Pose, distance: f64| Pose {
            position: add(
                pose.position,
                scale(distance, self.scene.tangent(pose, touch)),
            ),
            angle: pose.angle,
        };
        let excess = |pose: &Pose| {
            let [normal, friction] = self.reaction(pose, touch, hand);
            friction + way * self.rubbing(pose, touch, hand) * normal
        };
        let mut pose = *pose;
        for _ in 0..2 {
            let (here, there) = (excess(&pose), excess(&shifted(&pose, self.size)));
            pose = shifted(&pose, self.size * here / (here - there));
        }
        pose
    }

    /// The balance of one contact that slides.
    fn slid_vertex(&self, (touch, way): (Touch, f64), hand: [f64; 3]) -> Option<Pose> {
        let held = self.scene.held(&self.pose, touch);
        let pin = add(
            self.pose.apply(held),
            scale(
                -self.scene.gap(&self.pose, touch),
                self.scene.normal(&self.pose, touch),
            ),
        );
        let at = |angle| self.slid_foot(&Pose::holding(held, pin, angle), (touch, way), hand);
        let moment = |angle| {
            let pose = at(angle);
            let about = self.scene.point(&pose, touch);
            self.scene.applied_moment(&pose, hand, about)
        };
        descend(self.pose.angle, SNAP, moment).map(at)
    }

    /// The balance of two contacts that slide on two surfaces.
    fn slid_pair(&self, pair: [Touch; 2], ways: [f64; 2], hand: [f64; 3]) -> Option<Pose> {
        let mut twist = self.motion(&self.pose, pair, ways)?;
        let drive = |pose: &Pose, twist| {
            let twist = self.onward(pose, pair, twist);
            let brake = self.brake(pose, pair, twist);
            Some(self.balanced(pose, pair, (ways, brake), hand)?.drive)
        };
        let way = sign(drive(&self.pose, twist)?);
        let at = |pose: &Pose, twist, distance: f64| {
            self.onto(pose.moved(times(distance * way, twist), self.size), &pair)
        };
        let mut pose = self.pose;
        let step = SLIDE * self.size;
        for _ in 0..(SNAP / SLIDE) as u32 {
            let rests = |distance: f64| {
                let drive = drive(&at(&pose, twist, distance), twist);
                drive.is_none_or(|drive| way * drive <= 0.0)
            };
            if rests(step) {
                let (_, after) = bisect(0.0, step, rests);
                let end = at(&pose, twist, after);
                return drive(&end, twist).map(|_| end);
            }
            pose = at(&pose, twist, step);
            twist = self.onward(&pose, pair, twist);
        }
        None
    }

    /// How far each contact moves in the direction of its slide if the hand moves on by a body size times `way`, extrapolated
    /// from a small part of that displacement; `None` if there is no balance on either side.
    pub(super) fn rates(&self, hand: [f64; 3], way: [f64; 3]) -> Option<Vec<f64>> {
        let at = |part: f64| self.followed(ahead(hand, way, part));
        let (low, high, width) = match (at(-REACH), at(REACH)) {
            (Some(low), Some(high)) => (low, high, 2.0 * REACH),
            (Some(low), None) => (low, at(0.0)?, REACH),
            (None, Some(high)) => (at(0.0)?, high, REACH),
            (None, None) => return None,
        };
        let ways = self.slide.as_deref().unwrap_or_default();
        let rate = |(&touch, way): (&Touch, &f64)| {
            way * (self.scene.place(&high, touch) - self.scene.place(&low, touch))
                / (width * self.size)
        };
        Some(self.contacts.iter().zip(ways).map(rate).collect())
    }
}

/// The hand pose after another fraction of the displacement.
pub(super) fn ahead(hand: [f64; 3], way: [f64; 3], part: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| hand[k] + part * way[k])
}
