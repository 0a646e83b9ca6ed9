//! An independent implementation of the pantograph's mechanics, in f64.

use stiction_core::Wrench;
use stiction_firmware::pantograph::{Geometry, HandleMount};

/// The forward kinematics in f64: the hand by the cosine rule, its orientation.
pub fn reference(g: &Geometry, [q1, q2, q3]: [f64; 3]) -> [f64; 3] {
    let [ox, oy] = g.origin.map(f64::from);
    let half = f64::from(g.base) / 2.0;
    let ([l1, l2], [r1, r2]) = (g.proximal.map(f64::from), g.distal.map(f64::from));
    let (x1, y1) = (ox - half + l1 * q1.cos(), oy + l1 * q1.sin());
    let (x2, y2) = (ox + half + l2 * q2.cos(), oy + l2 * q2.sin());
    let apart = (x2 - x1).hypot(y2 - y1);
    let at_left = ((r1 * r1 + apart * apart - r2 * r2) / (2.0 * r1 * apart)).acos();
    let link = (y2 - y1).atan2(x2 - x1) + at_left;
    let (x, y) = (x1 + r1 * link.cos(), y1 + r1 * link.sin());
    let phi = match g.handle {
        HandleMount::Base => q3,
        HandleMount::LeftLink => q3 + link,
        HandleMount::RightLink => q3 + (y - y2).atan2(x - x2),
    };
    [x, y, phi]
}

/// The torques of a wrench by finite differences of the kinematics: J^T F.
pub fn transposed(g: &Geometry, q: [f64; 3], wrench: &Wrench<f32>) -> [f64; 3] {
    let [fx, fy] = wrench.force.map(f64::from);
    std::array::from_fn(|joint| {
        let at = |h: f64| {
            let mut q = q;
            q[joint] += h;
            reference(g, q)
        };
        let ([x0, y0, p0], [x1, y1, p1]) = (at(-1e-6), at(1e-6));
        (fx * (x1 - x0) + fy * (y1 - y0) + f64::from(wrench.moment) * (p1 - p0)) / 2e-6
    })
}
