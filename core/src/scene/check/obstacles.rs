//! The checks of obstacles with corners that need only their numbers and the body's size L.

use super::outline::{check_convex, sides, spread};
use super::{Checked, GivenFriction, Representable, fits, larger, require, thinnest};
use crate::geometry::Vec2;
use crate::real::Real;
use crate::scene::{ObstacleDescription, Parameter};
use crate::units::Units;

/// The capacities for obstacles.
pub(in crate::scene) struct Room {
    /// Indices that half-planes occupy of the 255 that they share with the corners.
    pub(in crate::scene) half_planes: usize,
    /// Corners of all obstacles together.
    pub(in crate::scene) corners: usize,
}

/// All obstacles, in their order.
pub(in crate::scene) fn check_obstacles<R: Real>(
    given: &[ObstacleDescription<'_, R::Si>],
    room: &Room,
    units: &Units<R::Si>,
) -> Checked<R::Si> {
    // Each has a corner.
    require(
        given.len() <= room.corners,
        Parameter::ObstacleCount,
        count(given),
        "0 to the capacity of the solver",
    )?;
    for (i, obstacle) in given.iter().enumerate() {
        let corners = count(obstacle.vertices);
        let some = !obstacle.vertices.is_empty();
        require(some, Parameter::Corners(i), corners, "1 or more")?;
    }
    let corners = (given.iter()).fold(0_usize, |n, o| n.saturating_add(o.vertices.len()));
    let indices = room.half_planes.saturating_add(corners);
    require(
        corners <= room.corners && indices <= usize::from(u8::MAX),
        Parameter::CornerCount,
        whole(corners),
        "0 to the capacity of the solver, and at most 255 together with the surfaces",
    )?;
    for (i, obstacle) in given.iter().enumerate() {
        check_shape::<R>(i, obstacle.vertices, units)?;
        let (mu_s, fixed) = (
            obstacle.friction_static,
            Parameter::ObstacleFrictionStatic(i),
        );
        let friction = GivenFriction {
            mu_s,
            mu_d: obstacle.friction_dynamic,
            memory: obstacle.memory,
        };
        friction.check([
            fixed,
            Parameter::ObstacleFrictionDynamic(i),
            Parameter::ObstacleMemory(i),
        ])?;
    }
    Ok(())
}

/// A pin, a thin wall or a strictly convex polygon, counter-clockwise, in the range of the number type.
fn check_shape<R: Real>(
    obstacle: usize,
    corners: &[[R::Si; 2]],
    units: &Units<R::Si>,
) -> Checked<R::Si> {
    let name = |corner: usize| Parameter::Corner { obstacle, corner };
    spread(corners, name)?;
    let allowed = Representable::by::<R>().place;
    for (k, &corner) in corners.iter().enumerate() {
        let place: Vec2<R> = units.point(corner);
        require(fits(place.length_bound()), name(k), larger(corner), allowed)?;
    }
    let body_size = units.length;
    let shortest = shortest_side::<R>().to_si(units.length);
    if corners.len() > 1 {
        for (side, (from, to)) in sides(corners).enumerate() {
            let [from, to] = [from, to].map(|[x, y]| Vec2::new(x, y));
            let length = (to - from).length();
            let parameter = Parameter::Side { obstacle, side };
            let allowed = "at least 2^-16 body sizes";
            require(length >= shortest, parameter, length, allowed)?;
        }
    }
    check_convex(corners, body_size, thinnest::<R>(), name)
}

/// 2^-16, in body sizes: displacements up to [`Real::MICRO`] count as none, and two contacts closer than that are one. On a side eight
/// times as long, a vertex has room between both ends, and the side's direction is known.
fn shortest_side<R: Real>() -> R {
    R::MICRO * R::from_int(8)
}

/// The number of items, as a number of the type.
fn count<T, F: Real>(list: &[T]) -> F {
    whole(list.len())
}

fn whole<F: Real>(n: usize) -> F {
    F::from_int(i32::try_from(n).unwrap_or(i32::MAX))
}
