//! The contacts that two convex shapes can have: a vertex of the body on a surface or on a side of an obstacle, and a corner of an
//! obstacle on a side of the body. Each has a point, a normal towards the body, a tangent, a gap, the position of the body's
//! material along the tangent, and the ends of its side. World frame, m.

use super::scene::{Friction, Pose, Scene, Vector, add, cross, dot, length, scale, sub};

pub(super) use crate::obstacles::shape::{ends, sides};
pub use stiction_judge::Touch;

/// The unit normal of a side, pointing out of the shape.
pub(super) fn outward(shape: &[Vector], side: usize) -> Vector {
    let [from, to] = ends(shape, side);
    let along = sub(to, from);
    scale(1.0 / length(along), [along[1], -along[0]])
}

/// The direction in which friction is positive on a side with this normal (floor: +x).
pub(super) fn tangent_of(normal: Vector) -> Vector {
    [normal[1], -normal[0]]
}

impl Scene {
    /// Friction coefficients and memory length of the touched surface or obstacle.
    pub(super) fn friction(&self, touch: Touch) -> Friction {
        let of = |mu_s, mu_d, memory| Friction { mu_s, mu_d, memory };
        match touch {
            Touch::Surface { surface, .. } => {
                let surface = &self.surfaces[surface];
                of(surface.mu_s, surface.mu_d, surface.memory)
            }
            Touch::Side { obstacle, .. } | Touch::Corner { obstacle, .. } => {
                let obstacle = &self.obstacles[obstacle];
                of(obstacle.mu_s, obstacle.mu_d, obstacle.memory)
            }
        }
    }

    /// The unit normal of the contact, towards the body.
    pub(super) fn normal(&self, pose: &Pose, touch: Touch) -> Vector {
        match touch {
            Touch::Surface { surface, .. } => self.surfaces[surface].normal,
            Touch::Side { obstacle, side, .. } => outward(&self.obstacles[obstacle].vertices, side),
            Touch::Corner { body_side, .. } => {
                pose.direction(scale(-1.0, outward(&self.vertices, body_side)))
            }
        }
    }

    /// The direction in which the contact's friction is positive.
    pub(super) fn tangent(&self, pose: &Pose, touch: Touch) -> Vector {
        tangent_of(self.normal(pose, touch))
    }

    /// The point of the body that is held fixed while the contact sticks, body frame.
    pub(super) fn held(&self, pose: &Pose, touch: Touch) -> Vector {
        match touch {
            Touch::Surface { vertex, .. } | Touch::Side { vertex, .. } => self.vertices[vertex],
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => {
                let outward = outward(&self.vertices, body_side);
                let point = pose.inverse(self.obstacles[obstacle].vertices[corner]);
                let above = dot(outward, sub(point, self.vertices[body_side]));
                add(point, scale(-above, outward))
            }
        }
    }

    /// The position of the contact.
    pub(super) fn point(&self, pose: &Pose, touch: Touch) -> Vector {
        match touch {
            Touch::Surface { vertex, .. } | Touch::Side { vertex, .. } => {
                pose.apply(self.vertices[vertex])
            }
            Touch::Corner {
                obstacle, corner, ..
            } => self.obstacles[obstacle].vertices[corner],
        }
    }

    /// Distance of the vertex from the line of the side, or of the corner from the line of the body's side; negative inside.
    pub(super) fn gap(&self, pose: &Pose, touch: Touch) -> f64 {
        let from = match touch {
            Touch::Surface { vertex, surface } => {
                let surface = &self.surfaces[surface];
                return dot(surface.normal, pose.apply(self.vertices[vertex])) - surface.offset;
            }
            Touch::Side {
                vertex,
                obstacle,
                side,
            } => sub(
                pose.apply(self.vertices[vertex]),
                self.obstacles[obstacle].vertices[side],
            ),
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => sub(
                pose.apply(self.vertices[body_side]),
                self.obstacles[obstacle].vertices[corner],
            ),
        };
        dot(self.normal(pose, touch), from)
    }

    /// Position of the body's material at the contact along the tangent: it grows as the body slides along the tangent.
    pub(super) fn place(&self, pose: &Pose, touch: Touch) -> f64 {
        match touch {
            Touch::Surface { .. } | Touch::Side { .. } => {
                dot(self.tangent(pose, touch), self.point(pose, touch))
            }
            Touch::Corner { body_side, .. } => {
                let along = self.body_tangent(body_side);
                -dot(along, pose.inverse(self.point(pose, touch)))
            }
        }
    }

    /// The positions between which the contact is on its side; `None` on a half-plane.
    pub(super) fn reach(&self, touch: Touch) -> Option<[f64; 2]> {
        match touch {
            Touch::Surface { .. } => None,
            Touch::Side { obstacle, side, .. } => Some(self.run(obstacle, side).1),
            Touch::Corner { body_side, .. } => {
                let along = self.body_tangent(body_side);
                let [a, b] = ends(&self.vertices, body_side).map(|end| -dot(along, end));
                Some([a.min(b), a.max(b)])
            }
        }
    }

    /// How far the contact is past the end of its side; negative on it.
    pub(super) fn beyond(&self, pose: &Pose, touch: Touch) -> f64 {
        self.reach(touch).map_or(f64::NEG_INFINITY, |[low, high]| {
            let place = self.place(pose, touch);
            (low - place).max(place - high)
        })
    }

    /// The tangent of contacts on a side of the body, body frame.
    fn body_tangent(&self, body_side: usize) -> Vector {
        tangent_of(scale(-1.0, outward(&self.vertices, body_side)))
    }

    /// Whether two contacts lie on one line, with the same normal, within `tolerance` rad and body sizes: a flat contact.
    pub(super) fn in_line(
        &self,
        pose: &Pose,
        [a, b]: [Touch; 2],
        (size, tolerance): (f64, f64),
    ) -> bool {
        if let (Touch::Surface { surface: a, .. }, Touch::Surface { surface: b, .. }) = (a, b) {
            return a == b;
        }
        if a.vertex().is_some() && a.vertex() == b.vertex() {
            return false;
        }
        let [first, second] = [a, b].map(|touch| self.normal(pose, touch));
        let apart = sub(self.point(pose, b), self.point(pose, a));
        dot(first, second) > 0.0
            && cross(first, second).abs() <= tolerance
            && dot(first, apart).abs() <= tolerance * size
    }
}
