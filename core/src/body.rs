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

    /// v_i, body frame; the origin where there is no such vertex.
    pub(crate) fn vertex(&self, i: u8) -> Vec2<R> {
        self.vertices
            .get(usize::from(i))
            .copied()
            .unwrap_or(Vec2::ZERO)
    }

    /// The centroid cg (of the area, of the rod, of the point), body frame.
    pub(crate) fn centroid(&self) -> Vec2<R> {
        self.centroid
    }

    /// The indices of all vertices.
    pub(crate) fn indices(&self) -> impl Iterator<Item = u8> + use<R, V> {
        0..u8::try_from(self.vertices.len()).unwrap_or(u8::MAX)
    }

    /// The two neighbours of a vertex: on the surface that it touches nothing else can arrive first.
    pub(crate) fn neighbours(&self, i: u8) -> impl Iterator<Item = u8> + use<R, V> {
        let last = self.vertices.len().saturating_sub(1);
        let at = usize::from(i);
        let next = if at >= last { 0 } else { at.saturating_add(1) };
        let previous = if at == 0 { last } else { at.saturating_sub(1) };
        let pair = [next, previous];
        let distinct = match last {
            0 => 0,
            1 => 1,
            _ => 2,
        };
        pair.into_iter()
            .take(distinct)
            .filter_map(|k| u8::try_from(k).ok())
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
