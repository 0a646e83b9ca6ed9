//! Properties of the obstacles that do not depend on a frame: which coplanar sides are one, and which corners are covered (m,
//! world frame).

use crate::body::size;
use crate::obstacles::OVERLAP;
use crate::scene::{Obstacle, Scene};
use crate::shape::{ends, gap_of_segments, outward, sides};
use crate::vector::{Vec2, cross, dot, sub};

/// Sides at a smaller angle (rad) are parallel: those in one line have been made so.
const SAME: f64 = 1e-9;

/// The properties of every obstacle, by its index.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sides {
    /// For every side: the interval along its tangent of the line that it forms with the adjoining coplanar sides of equal friction (m).
    runs: Vec<Vec<[f64; 2]>>,
    /// For every corner: whether another obstacle, or a half-plane, lies over it.
    covered: Vec<Vec<bool>>,
}

/// A side of an obstacle, as a segment of a line.
#[derive(Clone, Copy)]
struct Part {
    normal: Vec2,
    from: Vec2,
    friction: (f64, f64, Option<f64>),
    /// The interval along the tangent.
    span: [f64; 2],
}

impl Part {
    fn new(obstacle: &Obstacle, side: usize) -> Self {
        let normal = outward(&obstacle.vertices, side);
        let [from, to] = ends(&obstacle.vertices, side);
        Self {
            normal,
            from,
            friction: (
                obstacle.friction_static,
                obstacle.friction_dynamic,
                obstacle.memory,
            ),
            span: span(normal, [from, to]),
        }
    }

    fn is_coplanar(&self, other: &Self, near: f64) -> bool {
        dot(self.normal, other.normal) > 0.0
            && cross(self.normal, other.normal).abs() <= SAME
            && dot(self.normal, sub(other.from, self.from)).abs() <= near
            && self.friction == other.friction
    }
}

/// The lowest and highest position of points along the tangent of a normal.
fn span(normal: Vec2, points: [Vec2; 2]) -> [f64; 2] {
    let [a, b] = points.map(|point| dot([normal[1], -normal[0]], point));
    [a.min(b), a.max(b)]
}

impl Sides {
    pub(crate) fn new(scene: &Scene) -> Self {
        let near = OVERLAP * size(&scene.vertices);
        let of = |obstacle: &Obstacle| -> Vec<Part> {
            let all = 0..sides(&obstacle.vertices);
            all.map(|side| Part::new(obstacle, side)).collect()
        };
        let parts: Vec<Vec<Part>> = scene.obstacles.iter().map(of).collect();
        let all: Vec<Part> = parts.iter().flatten().copied().collect();
        let run = |part: &Part| run(part, &all, near);
        let corner = |i: usize, point: Vec2| is_covered(scene, i, point, near);
        let corners = |(i, obstacle): (usize, &Obstacle)| {
            (obstacle.vertices.iter())
                .map(|&point| corner(i, point))
                .collect()
        };
        Self {
            runs: (parts.iter())
                .map(|parts| parts.iter().map(run).collect())
                .collect(),
            covered: scene.obstacles.iter().enumerate().map(corners).collect(),
        }
    }

    /// The interval along its tangent of a side together with those that it is one with (m).
    pub(crate) fn run(&self, obstacle: usize, side: usize) -> [f64; 2] {
        self.runs[obstacle][side]
    }

    /// Whether something lies over a corner, or another corner coincides with it.
    pub(crate) fn is_covered(&self, obstacle: usize, corner: usize) -> bool {
        self.covered[obstacle][corner]
    }
}

fn run(part: &Part, all: &[Part], near: f64) -> [f64; 2] {
    let mut spans: Vec<[f64; 2]> = (all.iter())
        .filter(|other| part.is_coplanar(other, near))
        .map(|other| {
            let along = other.span[1] - other.span[0];
            let [_, high] = span(part.normal, [other.from; 2]);
            // A side runs against its tangent.
            [high - along, high]
        })
        .collect();
    let mut whole = part.span;
    loop {
        let joins = |&[low, high]: &[f64; 2]| low <= whole[1] + near && whole[0] <= high + near;
        let Some(i) = spans.iter().position(joins) else {
            return whole;
        };
        let [low, high] = spans.swap_remove(i);
        whole = [whole[0].min(low), whole[1].max(high)];
    }
}

fn is_covered(scene: &Scene, obstacle: usize, point: Vec2, near: f64) -> bool {
    let behind =
        (scene.surfaces.iter()).any(|surface| dot(surface.normal, point) <= surface.offset + near);
    behind
        || (scene.obstacles.iter().enumerate()).any(|(other, over)| {
            let shape = &over.vertices;
            other != obstacle
                && match shape.as_slice() {
                    [pin] => gap_of_segments([*pin; 2], [point; 2]) <= near,
                    [a, b] => gap_of_segments([*a, *b], [point; 2]) <= near,
                    _ => (0..sides(shape))
                        .all(|side| dot(outward(shape, side), sub(point, shape[side])) <= near),
                }
        })
}
