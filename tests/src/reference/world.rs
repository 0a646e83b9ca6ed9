//! A world of several obstacles: which coplanar sides count as one, and which corners cannot be touched because another obstacle
//! or a half-plane covers them. The answers are computed on every request.

use super::contact::{ends, outward, sides, tangent_of};
use super::scene::{Scene, Vector, cross, dot, length, sub};

/// Corners and sides that are closer than this coincide, in body sizes and rad.
const SAME: f64 = 1e-9;

impl Scene {
    /// The first of the sides of equal friction that form one line with a side, and the positions along the tangent at which that line
    /// begins and ends.
    pub(super) fn run(&self, obstacle: usize, side: usize) -> ((usize, usize), [f64; 2]) {
        let shape = &self.obstacles[obstacle].vertices;
        let normal = outward(shape, side);
        let tangent = tangent_of(normal);
        let origin = shape[side];
        let span = |obstacle: usize, side: usize| {
            let [a, b] =
                ends(&self.obstacles[obstacle].vertices, side).map(|end| dot(tangent, end));
            [a.min(b), a.max(b)]
        };
        let friction = |obstacle: usize| {
            let obstacle = &self.obstacles[obstacle];
            (obstacle.mu_s, obstacle.mu_d, obstacle.memory)
        };
        let coplanar: Vec<_> = self
            .all_sides()
            .filter(|&of| of != (obstacle, side) && friction(of.0) == friction(obstacle))
            .filter(|&(other, k)| {
                let shape = &self.obstacles[other].vertices;
                let facing = outward(shape, k);
                dot(facing, normal) > 0.0
                    && cross(facing, normal).abs() <= SAME
                    && dot(normal, sub(shape[k], origin)).abs() <= SAME * self.size()
            })
            .collect();
        let (mut first, mut whole) = ((obstacle, side), span(obstacle, side));
        let near = SAME
            * if coplanar.is_empty() {
                0.0
            } else {
                self.size()
            };
        for _ in 0..coplanar.len() {
            for &(other, k) in &coplanar {
                let [low, high] = span(other, k);
                if low <= whole[1] + near && whole[0] <= high + near {
                    first = first.min((other, k));
                    whole = [whole[0].min(low), whole[1].max(high)];
                }
            }
        }
        (first, whole)
    }

    /// All sides of all obstacles.
    fn all_sides(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.obstacles
            .iter()
            .enumerate()
            .flat_map(|(i, obstacle)| (0..sides(&obstacle.vertices)).map(move |side| (i, side)))
    }

    /// Whether this corner cannot be touched.
    pub(super) fn covered(&self, obstacle: usize, corner: usize) -> bool {
        let point = self.obstacles[obstacle].vertices[corner];
        let near = SAME * self.size();
        let behind = self
            .surfaces
            .iter()
            .any(|surface| dot(surface.normal, point) <= surface.offset + near);
        behind
            || (0..self.obstacles.len())
                .any(|other| other != obstacle && self.covers(other, (obstacle, point), near))
    }

    /// Whether a point is in or on an obstacle; if corners coincide, the first of them remains.
    fn covers(&self, other: usize, (obstacle, point): (usize, Vector), near: f64) -> bool {
        let shape = &self.obstacles[other].vertices;
        if shape
            .iter()
            .any(|&corner| length(sub(corner, point)) <= near)
        {
            return other < obstacle;
        }
        let inside = |side: usize| dot(outward(shape, side), sub(point, shape[side])) <= near;
        let between = |side: usize| {
            let [a, b] = ends(shape, side);
            let along = sub(b, a);
            let part = dot(along, sub(point, a)) / dot(along, along);
            (0.0..=1.0).contains(&part)
        };
        sides(shape) > 0 && (0..sides(shape)).all(inside) && (shape.len() > 2 || between(0))
    }
}
