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
    /// From 1 to V vertices that have already been checked: strictly convex, counter-clockwise.
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
        let mut nearest = R::HUGE;
        let mut inside = self.vertices.len() > 2;
        let mut from = self.vertices.last().copied().unwrap_or(Vec2::ZERO);
        for &to in &self.vertices {
            let side = to - from;
            let along = point - from;
            inside &= side.cross(along) >= R::ZERO;
            // 0 for a side of length zero.
            let part = R::ZERO.max(side.dot(along) / side.dot(side));
            let nearest_of_side = side * part.min(R::ONE);
            nearest = nearest.min((along - nearest_of_side).length());
            from = to;
        }
        if inside { R::ZERO } else { nearest }
    }
}

/// The centroid of the area; for a point and a rod the mean of the vertices.
fn centroid<R: Real>(vertices: &[Vec2<R>]) -> Vec2<R> {
    let at = |end: Option<&Vec2<R>>| end.copied().unwrap_or(Vec2::ZERO);
    let (first, last) = (at(vertices.first()), at(vertices.last()));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{Random, sampled};
    use crate::list::gather;

    fn body(vertices: &[[f64; 2]]) -> Body<f64, 8> {
        Body::new(gather(vertices.iter().map(|&[x, y]| Vec2::new(x, y))))
    }

    /// Points of a side, which is no longer than 2.
    const STEPS: i32 = if cfg!(miri) { 50 } else { 2000 };

    /// To the nearest of many points on all sides; 0 if the point is on the left of every side.
    fn to_points(vertices: &[[f64; 2]], point: Vec2<f64>) -> f64 {
        let at = |i: usize| Vec2::new(vertices[i][0], vertices[i][1]);
        let n = vertices.len();
        let sides = || (0..n).map(|i| (at(i), at((i + 1) % n)));
        if n > 2 && sides().all(|(from, to)| (to - from).cross(point - from) >= 0.0) {
            return 0.0;
        }
        let points = sides().flat_map(|(from, to)| {
            (0..=STEPS)
                .map(move |i| (from.lerp(to, f64::from(i) / f64::from(STEPS)) - point).length())
        });
        points.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn distance_is_to_the_nearest_point() {
        let bodies: [&[[f64; 2]]; 4] = [
            &[[0.5, -0.25]],
            &[[0.5, 0.25], [1.5, 0.25]],
            &[[0.0, 0.0], [0.5, 0.0], [0.25, 0.5]],
            &[[0.2, -0.4], [0.8, 0.0], [0.8, 0.4], [0.3, 0.5], [-0.1, 0.2]],
        ];
        let mut random = Random(5);
        for vertices in bodies {
            let body = body(vertices);
            for _ in sampled(0..200, 29) {
                let point = random.vector() * 2.0;
                let (is, should) = (body.distance(point), to_points(vertices, point));
                assert!(
                    is <= should + 1e-12 && is >= should - 2.0 / f64::from(STEPS),
                    "{point:?} {is} {should}"
                );
            }
            for &[x, y] in vertices {
                assert_eq!(body.distance(Vec2::new(x, y)), 0.0);
            }
        }
    }

    /// A rod has no inside, neither between its ends nor beyond them.
    #[test]
    fn beyond_the_end_of_a_rod_is_outside() {
        let rod = body(&[[0.0, 0.5], [1.0, 0.5]]);
        for (x, distance) in [
            (-0.5, 0.5),
            (0.0, 0.0),
            (0.5, 0.0),
            (1.0, 0.0),
            (1.25, 0.25),
        ] {
            assert_eq!(rod.distance(Vec2::new(x, 0.5)), distance, "{x}");
        }
        // An empty body is nowhere.
        assert_eq!(body(&[]).distance(Vec2::ZERO), <f64 as Real>::HUGE);
        assert_eq!(body(&[]).centroid(), Vec2::ZERO);
    }
}
