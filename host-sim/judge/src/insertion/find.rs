//! Finds the peg and the hole of a scene: from body, obstacles and half-planes to a [`Meter`], or none. World frame, m.

use std::f64::consts::FRAC_1_SQRT_2;

use super::plane::{Side, Vec2, add, cross, dot, left, length, middle, placed, scaled, sides, sub};
use super::{Meter, Peg};
use crate::scene::{Obstacle, Scene, Surface};

/// The largest clearance c of a peg in its hole: above it, a friction of 1 wedges no peg.
pub const MOST_CLEARANCE: f64 = 1.0 - FRAC_1_SQRT_2;
/// Tolerance of parallel sides (rad): over the length of a peg, their distance changes by a thousandth of a clearance of a thousandth.
const PARALLEL: f64 = 1e-6;

/// A wall of a hole, and its friction.
type Wall = (Side, f64);

impl Meter {
    /// The meter of a scene that has a peg and a hole.
    pub fn find(scene: &Scene) -> Option<Self> {
        let walls: Vec<(usize, Wall)> = (scene.obstacles.iter().enumerate())
            .flat_map(|(k, solid)| {
                sides(&solid.vertices).map(move |side| (k, (side, solid.friction_dynamic)))
            })
            .collect();
        let pegs = Peg::all(&scene.vertices);
        let mut best: Option<([f64; 2], Self)> = None;
        for (i, &(a, one)) in walls.iter().enumerate() {
            for &(_, other) in walls[..i].iter().filter(|(b, _)| *b != a) {
                for peg in &pegs {
                    let Some(meter) = Self::of(scene, peg, [one, other]) else {
                        continue;
                    };
                    let rank = meter.rank(scene);
                    if best.as_ref().is_none_or(|(least, _)| rank < *least) {
                        best = Some((rank, meter));
                    }
                }
            }
        }
        best.map(|(_, meter)| meter)
    }

    /// The rank of a peg and hole, lower is better: the clearance, as far as it differs, then the distance from the
    /// start to the mouth (m).
    fn rank(&self, scene: &Scene) -> [f64; 2] {
        let apart = length(sub(self.mouth, start(scene)));
        [(self.clearance() / PARALLEL).round(), apart]
    }

    fn of(scene: &Scene, peg: &Peg, walls: [Wall; 2]) -> Option<Self> {
        let [(a, mu_a), (b, mu_b)] = walls;
        if !are_opposite(a.normal, b.normal) {
            return None;
        }
        let width = dot(a.normal, sub(b.from, a.from));
        let clearance = (width - peg.width) / width;
        if width <= 0.0 || clearance <= 0.0 || clearance > MOST_CLEARANCE {
            return None;
        }
        let along = left(a.normal);
        let place = |point| dot(along, sub(point, a.from));
        let low = place(a.from)
            .min(place(a.to))
            .max(place(b.from).min(place(b.to)));
        let high = place(a.from)
            .max(place(a.to))
            .min(place(b.from).max(place(b.to)));
        if high <= low {
            return None;
        }
        let end = |at: f64| {
            add(
                a.from,
                add(scaled(along, at), scaled(a.normal, 0.5 * width)),
            )
        };
        let ends = [(end(low), along), (end(high), scaled(along, -1.0))];
        let open = ends
            .into_iter()
            .filter(|(end, _)| !is_covered(scene, *end, PARALLEL * width));
        let apart = |end: Vec2| length(sub(end, start(scene)));
        let (mouth, inwards) = open.min_by(|a, b| apart(a.0).total_cmp(&apart(b.0)))?;
        Some(Self {
            radius: 0.5 * peg.width,
            width,
            friction: mu_a.min(mu_b),
            length: high - low,
            mouth,
            inwards,
            peg: peg.clone(),
        })
    }
}

/// The mean of the body's vertices at the start (m).
fn start(scene: &Scene) -> Vec2 {
    let sum = scene
        .vertices
        .iter()
        .fold([0.0; 2], |sum, &vertex| add(sum, vertex));
    placed(
        scene.start,
        scaled(sum, 1.0 / scene.vertices.len().max(1) as f64),
    )
}

fn are_opposite(a: Vec2, b: Vec2) -> bool {
    dot(a, b) < 0.0 && cross(a, b).abs() <= PARALLEL
}

/// Whether a point is in, on or behind an item, to within `near` (m).
fn is_covered(scene: &Scene, point: Vec2, near: f64) -> bool {
    let behind = |surface: &Surface| dot(surface.normal, point) <= surface.offset + near;
    let within = |solid: &Obstacle| match solid.vertices.as_slice() {
        [pin] => length(sub(point, *pin)) <= near,
        vertices => sides(vertices).all(|side| {
            let along = scaled(
                left(side.normal),
                if vertices.len() == 2 { 1.0 } else { 0.0 },
            );
            // A thin wall has ends.
            dot(side.normal, sub(point, side.from)) <= near
                && dot(along, sub(point, side.to)) <= near
        }),
    };
    scene.surfaces.iter().any(behind) || scene.obstacles.iter().any(within)
}

impl Peg {
    /// Every pair of parallel sides of a body.
    fn all(body: &[Vec2]) -> Vec<Self> {
        let sides: Vec<Side> = sides(body).collect();
        let pairs =
            (sides.iter().enumerate()).flat_map(|(i, a)| sides[..i].iter().map(move |b| (a, b)));
        let opposite = pairs.filter(|(a, b)| are_opposite(a.normal, b.normal));
        opposite.map(|(a, b)| Self::of(a, b)).collect()
    }

    fn of(a: &Side, b: &Side) -> Self {
        let axis = left(a.normal);
        let along = |side: &Side| match dot(axis, sub(side.to, side.from)) > 0.0 {
            true => [side.to, side.from],
            false => [side.from, side.to],
        };
        let ([a_end, a_begin], [b_end, b_begin]) = (along(a), along(b));
        Self {
            axis,
            ends: [[a_end, b_end], [a_begin, b_begin]],
            width: dot(a.normal, sub(a.from, b.from)),
        }
    }

    /// The peg in a pose, with the tip at the end that points inwards: the unit axis, the ends of the tip and the opposite ends (m),
    /// world frame.
    pub(crate) fn pointing(&self, pose: [f64; 3], inwards: Vec2) -> Placed {
        let axis = super::plane::turned(self.axis, pose[2]);
        let ends = self.ends.map(|ends| ends.map(|end| placed(pose, end)));
        let [towards, away] = ends;
        match dot(axis, inwards) > 0.0 {
            true => Placed {
                axis,
                tip: towards,
                back: away,
            },
            false => Placed {
                axis: scaled(axis, -1.0),
                tip: away,
                back: towards,
            },
        }
    }
}

pub(crate) struct Placed {
    /// The unit vector along the peg, into the hole.
    pub(crate) axis: Vec2,
    /// The ends of its sides at the tip, and the opposite ones (m).
    pub(crate) tip: [Vec2; 2],
    pub(crate) back: [Vec2; 2],
}

impl Placed {
    /// The middle of the tip (m).
    pub(crate) fn middle(&self) -> Vec2 {
        middle(self.tip)
    }
}
