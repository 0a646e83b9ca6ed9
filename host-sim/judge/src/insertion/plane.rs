//! Vectors of the plane. Roots and angles are computed by libm, with the same bits on every machine.

use libm::{hypot, sincos};

pub(crate) use crate::vector::{Vec2, add, cross, dot, scaled, sub};

pub(crate) fn length([x, y]: Vec2) -> f64 {
    hypot(x, y)
}

pub(crate) fn middle([a, b]: [Vec2; 2]) -> Vec2 {
    scaled(add(a, b), 0.5)
}

/// A quarter turn counter-clockwise.
pub(crate) fn left([x, y]: Vec2) -> Vec2 {
    [-y, x]
}

/// A vector turned by an angle (rad).
pub(crate) fn turned([x, y]: Vec2, angle: f64) -> Vec2 {
    let (sin, cos) = sincos(angle);
    [cos * x - sin * y, sin * x + cos * y]
}

pub(crate) fn placed([x, y, theta]: [f64; 3], point: Vec2) -> Vec2 {
    add([x, y], turned(point, theta))
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) from: Vec2,
    pub(crate) to: Vec2,
    /// The outward unit normal.
    pub(crate) normal: Vec2,
}

/// The sides of a polygon: two for a segment, none for a point.
pub(crate) fn sides(vertices: &[Vec2]) -> impl Iterator<Item = Side> + '_ {
    let next = vertices.iter().cycle().skip(1);
    let side = |(&from, &to): (&Vec2, &Vec2)| {
        let way = sub(to, from);
        let normal = scaled(left(way), -1.0 / length(way));
        Side { from, to, normal }
    };
    let count = if vertices.len() < 2 {
        0
    } else {
        vertices.len()
    };
    vertices.iter().zip(next).take(count).map(side)
}
