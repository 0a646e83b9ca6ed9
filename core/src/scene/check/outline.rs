//! The outline of a body or of an obstacle: finite, no corner twice, strictly convex, counter-clockwise. The first fault ends the checks
//! and is reported with its corner.

use super::{Checked, larger, require};
use crate::geometry::Vec2;
use crate::real::Real;
use crate::scene::{Parameter, SceneError};

/// The ends of each side, beginning with the side at the first corner; for a point the point twice.
pub(in crate::scene) fn sides<P: Copy>(outline: &[P]) -> impl Iterator<Item = (P, P)> {
    let ends = outline.iter().skip(1).chain(outline.first());
    outline.iter().copied().zip(ends.copied())
}

/// The largest distance between two corners, 0 for a point; in the unit of the corners.
pub(super) fn spread<F: Real>(
    corners: &[[F; 2]],
    name: impl Fn(usize) -> Parameter,
) -> Result<F, SceneError<F>> {
    for (i, v) in corners.iter().enumerate() {
        for &value in v {
            require(true, name(i), value, "finite numbers")?;
        }
    }
    let at = |[x, y]: [F; 2]| Vec2::new(x, y);
    let mut length = F::ZERO;
    for (i, &v) in corners.iter().enumerate() {
        for &u in corners.iter().take(i) {
            let distance = (at(v) - at(u)).length();
            require(
                distance > F::ZERO && distance.is_finite(),
                name(i),
                larger(v),
                "a place of its own: no vertex twice, none too far",
            )?;
            length = length.max(distance);
        }
    }
    Ok(length)
}

/// Every corner lies to the left of every side, except the two that the side joins, and not too close to it: `thinnest` in body sizes, one
/// of which is `length` in the unit of the corners.
pub(super) fn check_convex<F: Real>(
    corners: &[[F; 2]],
    length: F,
    thinnest: F,
    name: impl Fn(usize) -> Parameter,
) -> Checked<F> {
    let at = |[x, y]: [F; 2]| Vec2::new(x / length, y / length);
    for (from, to) in sides(corners) {
        let side = at(to) - at(from);
        let too_little = side.length() * thinnest;
        for (k, &v) in corners.iter().enumerate() {
            let joined = v == from || v == to;
            require(
                joined || side.cross(at(v) - at(from)) > too_little,
                name(k),
                larger(v),
                "a corner of a strictly convex polygon, counter-clockwise, inside every side but its own two by more than 3.1e-5 body sizes, in f64 5.8e-6, in fixed point 1.6e-5",
            )?;
        }
    }
    Ok(())
}
