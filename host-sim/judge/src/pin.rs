//! A point of the body that is pinned while the body turns about it in balance of moments (STATICS 3.1): the balance that continues
//! the previous one, and the friction in it.

use crate::model::{Grip, Model, borne};
use crate::pairs::Facing;
use crate::vector::{Vec2, add, cross, dot, length, scaled, sub, turned};

/// The largest turn (rad) in one step.
const STEP: f64 = 0.05;
/// The finest subdivision of a path, as a number of halvings.
const FINEST: u32 = 24;

/// A contact, and the grip on the body.
#[derive(Clone, Copy)]
pub(crate) struct Foot<'a> {
    pub(crate) model: &'a Model,
    pub(crate) grip: &'a Grip,
    /// The normal of the touched side.
    pub(crate) facing: Facing,
    /// Levers up to this length are treated as zero (m).
    pub(crate) shortest: f64,
}

/// A point of the body (body frame) at a point of the world: the position of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) held: Vec2,
    pub(crate) at: Vec2,
}

impl Spot {
    /// The spot at a fraction of the straight path to another one: for a vertex that moves along a side, or a corner along
    /// which the body moves.
    pub(crate) fn towards(self, other: Self, part: f64) -> Self {
        let between = |a: Vec2, b: Vec2| add(a, scaled(sub(b, a), part));
        Self {
            held: between(self.held, other.held),
            at: between(self.at, other.at),
        }
    }
}

/// A contact at a spot, with the hand at a pose.
#[derive(Clone, Copy)]
pub(crate) struct Pin<'a> {
    foot: Foot<'a>,
    spot: Spot,
    hand: [f64; 3],
    /// For a contact that slides along its face: mu_d, negative against the tangent.
    slide: Option<f64>,
}

impl<'a> Foot<'a> {
    pub(crate) const fn pinned(self, spot: Spot, hand: [f64; 3]) -> Pin<'a> {
        Pin {
            foot: self,
            spot,
            hand,
            slide: None,
        }
    }

    /// The pin for a contact that slides with the hand along the face through a spot that is fixed in the world (E10).
    pub(crate) const fn sliding(self, spot: Spot, hand: [f64; 3], friction: f64) -> Pin<'a> {
        Pin {
            foot: self,
            spot,
            hand,
            slide: Some(friction),
        }
    }
}

impl Pin<'_> {
    /// Rd and the lever of the weight.
    fn levers(&self, theta: f64) -> (Vec2, Vec2) {
        let model = self.foot.model;
        let lever = |to: Vec2| turned(sub(to, self.spot.held), theta);
        (lever(self.foot.grip.point), lever(model.centroid()))
    }

    /// The moment (N·m), the left side of (E1) about the foot or of (E10) about the holding point, and its decrease with theta: the
    /// resistance to turning.
    fn moment(&self, theta: f64) -> (f64, f64) {
        match self.slide {
            None => self.moment_pinned(theta),
            Some(friction) => self.moment_sliding(theta, friction),
        }
    }

    fn moment_sliding(&self, theta: f64, friction: f64) -> (f64, f64) {
        let (scene, weight) = (&self.foot.model.scene, self.foot.model.weight());
        let (lever, heavy) = self.levers(theta);
        let beside = sub(heavy, lever);
        let normal = self.foot.facing.at(theta);
        let [n_x, n_y] = normal;
        let along = sub(normal, scaled([n_y, -n_x], friction));
        let k = scene.stiffness_translation;
        let ahead = sub(sub([self.hand[0], self.hand[1]], self.spot.at), lever);
        let pressed = -dot(normal, add(scaled(ahead, k), weight));
        // Change of N with the angle, and of its moment.
        let grows = k * cross(lever, normal);
        let couple = scene.stiffness_rotation * (self.hand[2] - self.foot.grip.offset - theta);
        (
            couple - pressed * cross(lever, along) + cross(beside, weight),
            scene.stiffness_rotation + grows * cross(lever, along) - pressed * dot(lever, along)
                + dot(beside, weight),
        )
    }

    fn moment_pinned(&self, theta: f64) -> (f64, f64) {
        let (scene, weight) = (&self.foot.model.scene, self.foot.model.weight());
        let (lever, heavy) = self.levers(theta);
        let pull = scaled(
            sub([self.hand[0], self.hand[1]], self.spot.at),
            scene.stiffness_translation,
        );
        let k = scene.stiffness_rotation;
        let couple = k * (self.hand[2] - self.foot.grip.offset - theta);
        (
            couple + cross(lever, pull) + cross(heavy, weight),
            k + dot(lever, pull) + dot(heavy, weight),
        )
    }

    /// N and T on the body (N).
    pub(crate) fn reaction(&self, theta: f64) -> (f64, f64) {
        let (lever, _) = self.levers(theta);
        let model = self.foot.model;
        let way = sub(sub([self.hand[0], self.hand[1]], self.spot.at), lever);
        let spring = scaled(way, model.scene.stiffness_translation);
        borne(add(spring, model.weight()), self.foot.facing.at(theta))
    }

    /// Whether nothing holds or turns the angle.
    fn is_neutral(&self) -> bool {
        let scene = &self.foot.model.scene;
        let (lever, heavy) = self.levers(0.0);
        scene.stiffness_rotation == 0.0
            && length(lever) <= self.foot.shortest
            && (scene.weight == 0.0 || length(heavy) <= self.foot.shortest)
    }

    /// The balance close to an angle, on the same stable branch.
    fn near(&self, theta: f64) -> Option<f64> {
        if self.is_neutral() {
            return Some(theta);
        }
        let mut at = theta;
        for _ in 0..12 {
            let (moment, stiffness) = self.moment(at);
            if stiffness <= 0.0 {
                return None;
            }
            let step = moment / stiffness;
            at += step;
            if (at - theta).abs() > STEP {
                return None;
            }
            if step.abs() <= 4.0 * f64::EPSILON * at.abs().max(1.0) {
                break;
            }
        }
        (self.moment(at).1 > 0.0).then_some(at)
    }

    /// Whether two angles are on one stable branch.
    pub(crate) fn on_one_branch(&self, a: f64, b: f64) -> bool {
        self.is_neutral()
            || (b - a).abs() <= STEP * STEP
            || (0..=16).all(|i| self.moment(a + (b - a) * f64::from(i) / 16.0).1 > 0.0)
    }
}

/// Follows the balance along a path from its start (part 0) to `part`: returns the angle there, `None` if the branch folds.
pub(crate) fn follow<'a>(pin: impl Fn(f64) -> Pin<'a>, theta: f64, part: f64) -> Option<f64> {
    if let Some(balance) = pin(part).near(theta) {
        return Some(balance);
    }
    let (mut at, mut balance, mut step) = (0.0, theta, part / 2.0);
    let finest = part / f64::from(1 << FINEST);
    while at < part {
        let to = (at + step).min(part);
        match pin(to).near(balance) {
            Some(found) => {
                (at, balance) = (to, found);
                step *= 2.0;
            }
            None if step <= finest => return None,
            None => step /= 2.0,
        }
    }
    Some(balance)
}
