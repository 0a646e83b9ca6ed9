//! F_z by Whitney's formulas for small angles, from the pose of the unloaded peg (m, rad, N). They ignore weight.

use super::Meter;
use super::plane::{cross, dot, left, placed, sub, turned};

/// The hand and its spring, world frame.
#[derive(Clone, Copy, Debug)]
pub struct Springs {
    /// K (N/m)
    pub translation: f64,
    /// K_t (N·m/rad)
    pub rotation: f64,
    /// x, y (m) of the hand.
    pub hand: [f64; 2],
    /// Force (N) and moment about the holding point (N·m) of the hand on the body.
    pub wrench: [f64; 3],
}

/// F_z (N) along the peg for one-point contact, and for two-point contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmallAngles {
    /// `None` if the unloaded peg would not touch the mouth.
    pub one_point: Option<f64>,
    /// `None` if one of the two contacts would pull according to the formula.
    pub two_points: Option<f64>,
}

impl Meter {
    /// The forces that the formulas give at depth l (m) for a peg in this pose under these springs.
    pub fn small_angles(&self, depth: f64, pose: [f64; 3], springs: &Springs) -> SmallAngles {
        let Springs {
            translation: k,
            rotation: k_t,
            ..
        } = *springs;
        if depth <= 0.0 || k_t <= 0.0 {
            return SmallAngles::default();
        }
        let holding = [0, 1].map(|axis| springs.hand[axis] - springs.wrench[axis] / k);
        let arm = turned(sub(holding, [pose[0], pose[1]]), -pose[2]);
        // The unloaded peg: the holding point is at the hand, and the rotational spring is at rest.
        let angle = pose[2] + springs.wrench[2] / k_t;
        let at_hand = sub(springs.hand, turned(arm, angle));
        let unloaded = [at_hand[0], at_hand[1], angle];
        let peg = self.peg.pointing(unloaded, self.inwards);
        let tip = sub(peg.middle(), self.mouth);
        let grip = length_along(placed(unloaded, arm), peg.middle(), peg.axis);
        // e_0 and t_0 as in OBSTACLES 11, or mirrored.
        let e = -dot(left(self.inwards), tip);
        let t = libm::asin(cross(self.inwards, peg.axis).clamp(-1.0, 1.0));
        let side = if e + depth * t < 0.0 { -1.0 } else { 1.0 };
        self.formulas(depth, grip, [side * e, side * t], [k, k_t])
    }

    /// L_g (m) from the tip to the holding point, e_0 (m) and t_0 (rad) of the unloaded peg, towards the touch.
    fn formulas(&self, l: f64, grip: f64, [e, t_0]: [f64; 2], [k, k_t]: [f64; 2]) -> SmallAngles {
        let (mu, r) = (self.friction, self.radius);
        let gap = 0.5 * self.width - r;
        let beyond = e + l * t_0 - gap;
        let one = mu * k * k_t * beyond / (k_t + k * (grip - l) * (grip - l - mu * r));
        let t = 2.0 * gap / l;
        let lateral = k * (-gap + (l - grip) * t + e + grip * t_0);
        let at_mouth = (lateral * (grip - mu * r) - k_t * (t - t_0)) / l;
        let at_tip = at_mouth - lateral;
        SmallAngles {
            one_point: (beyond > 0.0 && one > 0.0).then_some(one),
            two_points: (at_mouth >= 0.0 && at_tip >= 0.0).then_some(mu * (at_mouth + at_tip)),
        }
    }
}

/// Distance of a point above the tip, along the peg.
fn length_along(point: [f64; 2], tip: [f64; 2], axis: [f64; 2]) -> f64 {
    -dot(axis, sub(point, tip))
}
