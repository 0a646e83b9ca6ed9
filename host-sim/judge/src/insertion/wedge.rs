//! Wedging: two contacts on opposite walls that bear any load, because the line between them is inside both cones.

use super::plane::{cross, dot, sub};
use super::read::Reaction;

/// Whether the line between two contacts is within atan mu of both normals, which point towards each other.
pub(crate) fn is_wedged(friction: f64, a: &Reaction, b: &Reaction) -> bool {
    let line = sub(b.point, a.point);
    let within = |along: f64, across: f64| along > 0.0 && across.abs() <= friction * along;
    within(dot(line, a.direction), cross(line, a.direction))
        && within(-dot(line, b.direction), cross(line, b.direction))
}

/// The largest l/D_h at which friction mu wedges a peg of clearance c = (D_h - d)/D_h in two-point contact; `None` if nothing wedges it.
pub fn deepest_wedge(friction: f64, clearance: f64) -> Option<f64> {
    // 1/cos alpha, cos alpha = cos(atan mu)/(1 - c)
    let secant = (1.0 - clearance) * libm::hypot(1.0, friction);
    (secant >= 1.0).then(|| libm::sqrt(secant * secant - 1.0))
}

/// The smallest friction that can wedge a peg of clearance c: tan(acos(1 - c)), about sqrt(2c).
pub fn least_friction(clearance: f64) -> f64 {
    let cos = 1.0 - clearance;
    libm::sqrt(1.0 - cos * cos) / cos
}
