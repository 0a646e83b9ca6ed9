//! The body: a point, a rod or a strictly convex polygon of at most V vertices, in units of its own size L.

use crate::geometry::Vec2;
use crate::real::Real;
use heapless::Vec;

/// A rigid body in its own frame, lengths / L.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Body<R, const V: usize> {
    vertices: Vec<Vec2<R>, V>,
    centroid: Vec2<R>,
}

impl<R: Real, const V: usize> Body<R, V> {
    /// From vertices that were checked before: 1 to V of them, strictly convex, counter-clockwise.
    pub(crate) fn new(vertices: Vec<Vec2<R>, V>) -> Self {
        let centroid = centroid(&vertices);
        Self { vertices, centroid }
    }

    /// Vertices, body frame, counter-clockwise.
    pub(crate) fn vertices(&self) -> &[Vec2<R>] {
        &self.vertices
    }

    /// The centroid cg (of the area, of the rod, of the point), body frame.
    pub(crate) fn centroid(&self) -> Vec2<R> {
        self.centroid
    }

    /// The distance of a point of the body frame from the body; 0 inside.
    pub(crate) fn distance(&self, point: Vec2<R>) -> R {
        let Some(last) = self.vertices.last().copied() else {
            return R::HUGE;
        };
        let mut nearest = (point - last).length();
        let mut inside = self.vertices.len() > 2;
        let mut from = last;
        for &to in &self.vertices {
            let side = to - from;
            let along = point - from;
            inside &= side.cross(along) >= R::ZERO;
            let length2 = side.dot(side);
            if length2 > R::ZERO {
                let part = (side.dot(along) / length2).max(R::ZERO).min(R::ONE);
                nearest = nearest.min((along - side * part).length());
            }
            from = to;
        }
        if inside { R::ZERO } else { nearest }
    }
}

/// The centroid of the area; for a point and a rod the mean of the vertices.
fn centroid<R: Real>(vertices: &[Vec2<R>]) -> Vec2<R> {
    let (Some(&first), Some(&last)) = (vertices.first(), vertices.last()) else {
        return Vec2::ZERO;
    };
    if vertices.len() < 3 {
        return first.lerp(last, R::HALF);
    }
    let (mut sum, mut area) = (Vec2::ZERO, R::ZERO);
    for (a, b) in vertices.iter().zip(vertices.iter().skip(1)) {
        let (a, b) = (*a - first, *b - first);
        let twice = a.cross(b);
        sum = sum + (a + b) * twice;
        area = area + twice;
    }
    first + sum * (R::ONE / (R::from_int(3) * area))
}
