//! The memory of the contacts: one bit of the body, *stiction*, and the load or slip length from which the bit stays.

use super::Reference;
use super::cone::{inner, norm, times};
use super::contact::Touch;
use super::scene::{Friction, Pose, Screw};

/// A shorter memory length counts as this, in body sizes.
const LEAST: f64 = 1.0 / 524_288.0;
/// A motion whose unit twist turns by less than this, in body sizes, is a translation.
const STRAIGHT: f64 = 1e-6;
/// Step for probing the stiffness against a joint slide, in body sizes.
const PROBE: f64 = 1e-5;

impl Reference {
    /// The coefficient of friction at rest.
    pub(super) fn grip(&self, friction: Friction) -> f64 {
        if self.stiction {
            friction.mu_s
        } else {
            friction.mu_d
        }
    }

    fn memory(&self, friction: Friction) -> f64 {
        friction.memory.max(LEAST * self.size)
    }

    /// N*, in N: pressed harder than this, one vertex or an edge sticks and slips.
    fn threshold(&self, friction: Friction) -> f64 {
        let drop = friction.mu_s - friction.mu_d;
        if drop > 1e-9 * friction.mu_s {
            self.scene.k_h * self.memory(friction) / drop
        } else {
            f64::INFINITY
        }
    }

    /// Whether there is a single contact or an edge.
    pub(super) fn on_one_surface(&self) -> bool {
        self.contacts.len() == 1 || self.flat()
    }

    /// Whether one vertex, or an edge, is pressed with N* or more.
    pub(super) fn pressed_hard(&self, pose: &Pose, hand: [f64; 3]) -> bool {
        self.on_one_surface() && {
            if let &[a, b] = self.contacts.as_slice()
                && self.scene.friction(a) != self.scene.friction(b)
            {
                let normals = self.edge_normals(pose, [a, b], hand);
                let part = |(normal, touch)| normal / self.threshold(self.scene.friction(touch));
                return normals.into_iter().zip([a, b]).map(part).sum::<f64>() >= 1.0;
            }
            let touch = self.contacts[0];
            self.reaction(pose, touch, hand)[0] >= self.threshold(self.scene.friction(touch))
        }
    }

    /// The two contacts, if they are at two places and not in one line.
    pub(super) fn pair(&self) -> Option<[Touch; 2]> {
        match *self.contacts.as_slice() {
            [a, b] if !self.corner() && !self.flat() => Some([a, b]),
            _ => None,
        }
    }

    /// The directions along the tangents of two contacts that slide on two surfaces.
    pub(super) fn pair_ways(&self) -> Option<[f64; 2]> {
        match (self.pair(), self.slide.as_deref()) {
            (Some(_), Some(&[first, second])) => Some([first, second]),
            _ => None,
        }
    }

    /// Whether neither of two contacts has more friction at rest than in motion.
    fn indifferent(&self, pair: [Touch; 2]) -> bool {
        pair.iter()
            .all(|&touch| self.threshold(self.scene.friction(touch)).is_infinite())
    }

    /// Whether a slip of two contacts along `ways`, from a pose, would be as long as the memory of one of them.
    pub(super) fn would_slip(
        &self,
        pose: &Pose,
        pair: [Touch; 2],
        ways: [f64; 2],
        hand: [f64; 3],
    ) -> bool {
        !self.indifferent(pair) && self.slip_length(pose, pair, ways, hand) >= 1.0
    }

    /// The motion of two contacts in which they move along `ways`; `None` if there is none.
    pub(super) fn motion(&self, pose: &Pose, pair: [Touch; 2], ways: [f64; 2]) -> Option<Screw> {
        let twist = self.free_twist(pose, pair);
        [twist, times(-1.0, twist)].into_iter().find(|&way| {
            let speeds = self.speeds(pose, pair, way);
            speeds[0] * ways[0] > 0.0 && speeds[1] * ways[1] > 0.0
        })
    }

    /// A wrench that brakes `twist` with unit power: a couple, or equal drag at both contacts if the body does not turn.
    pub(super) fn brake(&self, pose: &Pose, pair: [Touch; 2], twist: Screw) -> Screw {
        if twist[2].abs() > STRAIGHT * norm(twist) {
            return [0.0, 0.0, -1.0 / twist[2]];
        }
        let drag = self.drag(pose, pair, self.speeds(pose, pair, twist));
        times(-1.0 / inner(drag, twist), drag)
    }

    /// The normal forces of two contacts that slide along `ways` in balance.
    pub(super) fn pair_normals(
        &self,
        pose: &Pose,
        pair: [Touch; 2],
        ways: [f64; 2],
        hand: [f64; 3],
    ) -> Option<[f64; 2]> {
        let brake = self.brake(pose, pair, self.free_twist(pose, pair));
        Some(self.balanced(pose, pair, (ways, brake), hand)?.normals)
    }

    /// The length of a joint slip from here, with friction falling from static to dynamic, in memory lengths: the longer of
    /// the two feet's.
    fn slip_length(&self, pose: &Pose, pair: [Touch; 2], ways: [f64; 2], hand: [f64; 3]) -> f64 {
        let Some(twist) = self.motion(pose, pair, ways) else {
            return 0.0;
        };
        let brake = self.brake(pose, pair, twist);
        let Some(here) = self.balanced(pose, pair, (ways, brake), hand) else {
            return 0.0;
        };
        let speeds = self.speeds(pose, pair, twist);
        let drop = self.drive_of_yield(pose, pair, (ways, brake), here.normals);
        let power = |reach: f64| {
            let there = self.onto(
                pose.moved(times(reach * self.size, twist), self.size),
                &pair,
            );
            let ahead = self.onward(&there, pair, twist);
            let brake = self.brake(&there, pair, ahead);
            self.balanced(&there, pair, (ways, brake), hand)
                .map(|state| state.drive)
        };
        let (Some(before), Some(after)) = (power(-PROBE), power(PROBE)) else {
            return 0.0;
        };
        let stiffness = (before - after) / (2.0 * PROBE * self.size);
        if stiffness <= 0.0 {
            return f64::INFINITY;
        }
        let way = drop / stiffness;
        let lengths =
            [0, 1].map(|i| way * speeds[i].abs() / self.memory(self.scene.friction(pair[i])));
        lengths[0].max(lengths[1])
    }
}
