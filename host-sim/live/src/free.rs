//! The holding point in the world, and the pose the body would have if nothing blocked it: both follow from the springs'
//! wrench. World frame, SI units.

use stiction_judge::centroid;
use stiction_scene::SceneFile;

use crate::record::Frame;

/// Iterations of the search for the balance of weight and rotational spring.
const STEPS: usize = 8;

/// Holding point and free pose, while the body is held.
#[derive(Clone, Copy, Debug, Default)]
pub struct Springs {
    /// The point where the hand holds the body (m), in the world.
    pub holding: Option<[f64; 2]>,
    /// x, y (m), theta (rad).
    pub ghost: Option<[f64; 3]>,
}

impl Springs {
    /// Computes both from a record.
    pub fn of(scene: &SceneFile, frame: &Frame) -> Self {
        if !frame.held {
            return Self::default();
        }
        let ([hx, hy, _], [_, _, moment]) = (frame.hand, frame.wrench);
        let k_h = scene.stiffness_translation;
        let holding = frame.holding_point(k_h);
        let [x, y, theta] = frame.pose;
        // In the body's frame.
        let point = turned([holding[0] - x, holding[1] - y], -theta);
        let [cx, cy] = centroid(&scene.vertices);
        let balanced = balanced(scene, moment, theta, [cx - point[0], cy - point[1]]);
        let [ox, oy] = turned(point, balanced);
        Self {
            holding: Some(holding),
            ghost: Some([hx - ox, hy - scene.weight / k_h - oy, balanced]),
        }
    }
}

/// Returns the angle at which k_theta (phi - theta) and the weight at `arm` (body frame) balance about the holding point.
fn balanced(scene: &SceneFile, moment: f64, theta: f64, arm: [f64; 2]) -> f64 {
    let (k_theta, weight) = (scene.stiffness_rotation, scene.weight);
    if k_theta <= 0.0 {
        return theta;
    }
    let rest = theta + moment / k_theta;
    let mut angle = rest;
    for _ in 0..STEPS {
        let [x, y] = turned(arm, angle);
        let unbalanced = k_theta * (rest - angle) - weight * x;
        let slope = -k_theta + weight * y;
        let step = unbalanced / slope;
        if !step.is_finite() {
            return rest;
        }
        angle -= step;
    }
    angle
}

/// Returns a vector rotated by an angle (rad).
fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}
