//! Whether the body keeps clear of its surroundings. Two convex shapes are apart if they are apart along some axis: an outward
//! normal of a side of either, or, for a segment, its own direction. The separation is the largest of the gaps along the axes. The
//! gap of a single pair means nothing if the vertex is past the end of the side.

use super::Reference;
use super::contact::{Touch, sides};
use super::scene::{Pose, Vector, dot, length, scale, sub};

/// An axis along which body and obstacle may be apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    /// The normal of this side of the obstacle.
    Side(usize),
    /// The normal of this side of the body.
    BodySide(usize),
    /// The direction in which a thin wall ends at this corner.
    End(usize),
    /// The direction in which a rod ends at this vertex.
    BodyEnd(usize),
}

/// The direction in which a segment ends at one of its two vertices.
fn off_end(shape: &[Vector], end: usize) -> Vector {
    let along = sub(shape[end], shape[1 - end]);
    scale(1.0 / length(along), along)
}

impl Reference {
    /// All axes between the body and an obstacle.
    fn axes(&self, obstacle: usize) -> Vec<Axis> {
        let (shape, body) = (
            &self.scene.obstacles[obstacle].vertices,
            &self.scene.vertices,
        );
        let segment = |count: usize| if count == 2 { 2 } else { 0 };
        (0..sides(shape))
            .map(Axis::Side)
            .chain((0..sides(body)).map(Axis::BodySide))
            .chain((0..segment(shape.len())).map(Axis::End))
            .chain((0..segment(body.len())).map(Axis::BodyEnd))
            .collect()
    }

    /// The gap along an axis, m, ignoring the pairs in contact; for each
    /// pair in `closed`, the excess of its gap over the gap given with it.
    fn gap_along(
        &self,
        pose: &Pose,
        (obstacle, axis): (usize, Axis),
        closed: &[(Touch, f64)],
    ) -> f64 {
        let (shape, body) = (
            &self.scene.obstacles[obstacle].vertices,
            &self.scene.vertices,
        );
        if self.is_flat_on(obstacle, axis) {
            return f64::INFINITY;
        }
        let least = |gaps: &mut dyn Iterator<Item = f64>| gaps.fold(f64::INFINITY, f64::min);
        let of = |touch: Touch| self.gap_beside(pose, touch, closed);
        match axis {
            Axis::Side(side) => {
                let run = self.scene.run(obstacle, side).0;
                least(&mut (0..body.len()).map(|vertex| {
                    of(Touch::Side {
                        vertex,
                        obstacle: run.0,
                        side: run.1,
                    })
                }))
            }
            Axis::BodySide(body_side) => least(&mut (0..shape.len()).map(|corner| {
                of(Touch::Corner {
                    obstacle,
                    corner,
                    body_side,
                })
            })),
            Axis::End(end) => {
                let way = off_end(shape, end);
                least(
                    &mut body
                        .iter()
                        .map(|&v| dot(way, sub(pose.apply(v), shape[end]))),
                )
            }
            Axis::BodyEnd(end) => {
                let way = pose.direction(off_end(body, end));
                let at = pose.apply(body[end]);
                least(&mut shape.iter().map(|&corner| dot(way, sub(corner, at))))
            }
        }
    }

    /// Whether the body lies flat against the obstacle along this axis: then they are apart, and any other pair in that line is
    /// apart up to rounding.
    fn is_flat_on(&self, obstacle: usize, axis: Axis) -> bool {
        let along = |&&touch: &&Touch| match (touch, axis) {
            (
                Touch::Side {
                    obstacle: on, side, ..
                },
                Axis::Side(of),
            ) => self.scene.run(obstacle, of).0 == (on, side),
            (Touch::Corner { body_side, .. }, Axis::BodySide(of)) => {
                touch.obstacle() == Some(obstacle) && body_side == of
            }
            _ => false,
        };
        let flat = |touch: &Touch| {
            let mut others = self.contacts.iter().filter(|&other| other != touch);
            others.any(|&other| self.lined(&self.pose, [*touch, other]))
        };
        self.contacts.len() > 1 && self.contacts.iter().filter(along).any(flat)
    }

    /// The gap of a pair that must not close: infinite for a pair in contact.
    fn gap_beside(&self, pose: &Pose, touch: Touch, closed: &[(Touch, f64)]) -> f64 {
        if self.contacts.contains(&touch) {
            return f64::INFINITY;
        }
        let least = closed.iter().find(|(other, _)| *other == touch);
        self.scene.gap(pose, touch) - least.map_or(0.0, |&(_, gap)| gap)
    }

    /// Whether the body is deeper than `depth` body sizes inside anything, ignoring its contacts.
    pub(super) fn enters(&self, pose: &Pose, depth: f64) -> bool {
        self.enters_beside(pose, &[], depth)
    }

    /// As above, if the pairs in `closed` may have a gap down to the one given with each.
    pub(super) fn enters_beside(&self, pose: &Pose, closed: &[(Touch, f64)], depth: f64) -> bool {
        let inside = |gap: f64| gap < -depth * self.size;
        self.surface_pairs()
            .any(|touch| inside(self.gap_beside(pose, touch, closed)))
            || (0..self.scene.obstacles.len()).any(|obstacle| {
                let (_, gap) = self.widest(pose, obstacle, closed);
                inside(gap)
            })
    }

    /// The axis along which the body is farthest from an obstacle, and the gap along it. If the two have no interior together (a
    /// point and a wall, or a rod and a pin), being on the far side does not count as being apart: the body cannot pass through.
    fn widest(&self, pose: &Pose, obstacle: usize, closed: &[(Touch, f64)]) -> (Axis, f64) {
        self.axes(obstacle)
            .into_iter()
            .filter(|&axis| !self.far_side(obstacle, axis))
            .map(|axis| (axis, self.gap_along(pose, (obstacle, axis), closed)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((Axis::Side(0), f64::INFINITY))
    }

    /// Whether this is the side of a thin wall that a point cannot see, or the side of a rod opposite to a pin. For a rod and a wall,
    /// the side opposite to the one on which they touch counts too: if the rod turned about its end, the two would be apart along it.
    fn far_side(&self, obstacle: usize, axis: Axis) -> bool {
        let shape = &self.scene.obstacles[obstacle].vertices;
        let thin = shape.len() + self.scene.vertices.len() == 3;
        let both = shape.len() == 2 && self.scene.vertices.len() == 2;
        let unseen = match (self.seen[obstacle], axis) {
            (Some(Axis::Side(one)), Axis::Side(other))
            | (Some(Axis::BodySide(one)), Axis::BodySide(other)) => one != other,
            _ => false,
        };
        let touched = |touch: &Touch| match (*touch, axis) {
            (
                Touch::Side {
                    obstacle: on, side, ..
                },
                Axis::Side(other),
            ) => on == obstacle && side != other,
            (
                Touch::Corner {
                    obstacle: of,
                    body_side,
                    ..
                },
                Axis::BodySide(other),
            ) => of == obstacle && body_side != other,
            _ => false,
        };
        (thin && unseen) || (both && self.contacts.iter().any(touched))
    }

    /// Whether a pair is on the far side.
    pub(super) fn on_far_side(&self, touch: Touch) -> bool {
        match touch {
            Touch::Surface { .. } => false,
            Touch::Side { obstacle, side, .. } => self.far_side(obstacle, Axis::Side(side)),
            Touch::Corner {
                obstacle,
                body_side,
                ..
            } => self.far_side(obstacle, Axis::BodySide(body_side)),
        }
    }

    /// Records that the body now faces this side of an obstacle.
    pub(super) fn sees(&mut self, obstacle: usize, side: usize) {
        self.seen[obstacle] = Some(Axis::Side(side));
    }

    /// Records the side from which each obstacle is seen.
    pub(super) fn look(&mut self) {
        let pose = self.pose;
        for obstacle in 0..self.scene.obstacles.len() {
            let still = self.seen[obstacle].is_some_and(|axis| {
                self.gap_along(&pose, (obstacle, axis), &[]) >= -super::BESIDE * self.size
            });
            if !still {
                self.seen[obstacle] = None;
                self.seen[obstacle] = Some(self.widest(&pose, obstacle, &[]).0);
            }
        }
    }

    /// Every vertex against every half-plane.
    pub(super) fn surface_pairs(&self) -> impl Iterator<Item = Touch> + '_ {
        (0..self.scene.surfaces.len()).flat_map(|surface| {
            (0..self.scene.vertices.len()).map(move |vertex| Touch::Surface { vertex, surface })
        })
    }
}
