//! The holding point in the world, and where the body would be if nothing were in its way: both follow from the springs'
//! wrench. World frame, SI units.

use stiction_scene::SceneFile;

use crate::record::Frame;

/// Steps of the search for the balance of weight and rotational spring.
const STEPS: usize = 8;

/// Both, while the body is held.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Springs {
    pub(super) holding: Option<[f64; 2]>,
    /// x, y (m), theta (rad).
    pub(super) ghost: Option<[f64; 3]>,
}

impl Springs {
    /// Of a record.
    pub(super) fn of(scene: &SceneFile, frame: &Frame) -> Self {
        if !frame.held {
            return Self::default();
        }
        let ([hx, hy, _], [fx, fy, moment]) = (frame.hand, frame.wrench);
        let k_h = scene.stiffness_translation;
        // F = k_h (p_h - p_g)
        let (gx, gy) = (hx - fx / k_h, hy - fy / k_h);
        let [x, y, theta] = frame.pose;
        let (g_x, g_y) = back((gx - x, gy - y), theta);
        let weight = scene.weight;
        let (cx, cy) = centroid(&scene.vertices);
        let arm = (cx - g_x, cy - g_y);
        let turned = turned(scene, moment, theta, arm);
        let (ox, oy) = forth((g_x, g_y), turned);
        Self {
            holding: Some([gx, gy]),
            ghost: Some([hx - ox, hy - weight / k_h - oy, turned]),
        }
    }
}

/// The angle at which k_theta (phi - theta) and the weight at `arm` (body frame) balance about the holding point.
fn turned(scene: &SceneFile, moment: f64, theta: f64, arm: (f64, f64)) -> f64 {
    let (k_theta, weight) = (scene.stiffness_rotation, scene.weight);
    if k_theta <= 0.0 {
        return theta;
    }
    let rest = theta + moment / k_theta;
    let mut angle = rest;
    for _ in 0..STEPS {
        let (x, y) = forth(arm, angle);
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

fn forth((x, y): (f64, f64), theta: f64) -> (f64, f64) {
    let (sin, cos) = theta.sin_cos();
    (cos * x - sin * y, sin * x + cos * y)
}

fn back(a: (f64, f64), theta: f64) -> (f64, f64) {
    forth(a, -theta)
}

/// Of the area of a polygon; the mean of a rod and of a point.
fn centroid(vertices: &[[f64; 2]]) -> (f64, f64) {
    let (mut area, mut x, mut y) = (0.0, 0.0, 0.0);
    for (a, b) in vertices.iter().zip(vertices.iter().cycle().skip(1)) {
        let cross = a[0] * b[1] - a[1] * b[0];
        area += cross;
        x += (a[0] + b[0]) * cross;
        y += (a[1] + b[1]) * cross;
    }
    if vertices.len() > 2 && area != 0.0 {
        return (x / (3.0 * area), y / (3.0 * area));
    }
    let count = vertices.len().max(1) as f64;
    let mean = |i: usize| vertices.iter().map(|v| v[i]).sum::<f64>() / count;
    (mean(0), mean(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn centroid_of_an_area_and_of_a_rod() {
        let (x, y) = centroid(&[[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]]);
        assert!((x - 1.0).abs() < 1e-15 && (y - 1.0).abs() < 1e-15);
        assert_eq!(centroid(&[[0.0, 0.0], [2.0, 4.0]]), (1.0, 2.0));
    }
}
