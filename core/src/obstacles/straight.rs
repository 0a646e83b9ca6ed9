//! Lines of the world with a free side, in double precision; lengths / L (R35). Their functions are not compiled into each other: where a
//! processor has no doubles, every operation is a call.

use crate::geometry::{Vec2, normalized};
use crate::real::Real;

/// 2^-19: what lies closer to a line is on it, what is closer to a place is there.
pub(super) const NEAR: f64 = f64::MICRO;
/// Lines at a smaller angle (its sine) have no place in common that is known well enough.
const PARALLEL: f64 = 1.0 / 16.0;

pub(super) type Point = Vec2<f64>;

/// A line with its free side, as that of a half-plane.
#[derive(Clone, Copy)]
pub(super) struct Straight {
    pub(super) normal: Point,
    pub(super) offset: f64,
    /// A side in it, the longest.
    pub(super) index: u8,
}

impl Straight {
    pub(super) fn tangent(&self) -> Point {
        Vec2::new(self.normal.y, -self.normal.x)
    }
    #[inline(never)]
    pub(super) fn height(&self, at: Point) -> f64 {
        self.normal.dot(at) - self.offset
    }
    /// The line of a side.
    #[inline(never)]
    pub(super) fn through(from: Point, to: Point, index: u8) -> Self {
        let along = to - from;
        let (x, y) = normalized(along.x, along.y);
        let normal = Vec2::new(y, -x);
        Self {
            normal,
            offset: normal.dot(from),
            index,
        }
    }
    #[inline(never)]
    pub(super) fn is_near(&self, at: Point) -> bool {
        self.height(at).abs() <= NEAR
    }
    /// With the other side free.
    pub(super) fn turned(&self, index: u8) -> Self {
        Self {
            normal: -self.normal,
            offset: -self.offset,
            index,
        }
    }
    /// The place near a point where another line crosses this one; none if they are almost parallel.
    #[inline(never)]
    pub(super) fn meeting(&self, other: &Self, at: Point) -> Option<Point> {
        let (sine, own, others) = (
            self.normal.cross(other.normal),
            self.height(at),
            other.height(at),
        );
        let place =
            || at + other.normal.turned() * (own / sine) - self.normal.turned() * (others / sine);
        (sine.abs() >= PARALLEL).then(place)
    }
}
