//! The geometry of a pair in a pose: its position, its line, its gap, its position on its side, and whether the adjacent sides leave
//! it space. World frame unless stated otherwise (m).

use stiction_core::Touch;

use crate::frame::Contact;
use crate::model::Model;
use crate::obstacles::OVERLAP;
use crate::pin::Spot;
use crate::scene::{Obstacle, Scene, face};
use crate::shape::{ends, neighbours, outward, sides};
use crate::touch::{Face, share_vertex};
use crate::vector::{Vec2, cross, dot, scaled, sub, turned};

/// Lines whose angle (rad) and distance (L) do not exceed this may be the same.
const LINE: f64 = 1e-5;
/// Within this, they are the same.
const SAME_LINE: f64 = 1e-9;

/// How a normal behaves as the body turns.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Facing {
    /// It is fixed in the world: world frame.
    World(Vec2),
    /// It turns with the body: body frame.
    Body(Vec2),
}

impl Facing {
    /// The normal in the world frame, with the body at an angle.
    pub(crate) fn at(self, theta: f64) -> Vec2 {
        match self {
            Self::World(normal) => normal,
            Self::Body(normal) => turned(normal, theta),
        }
    }
}

/// Whether two contacts are on one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lined {
    Yes,
    No,
    /// It is uncertain.
    Maybe,
}

/// The point of the body frame at a point of the world.
fn in_body(pose: [f64; 3], place: Vec2) -> Vec2 {
    turned(sub(place, [pose[0], pose[1]]), -pose[2])
}

impl Model {
    pub(crate) fn has(&self, touch: Touch) -> bool {
        let corners = |obstacle: usize| self.scene.obstacles.get(obstacle).map(|o| &o.vertices);
        let body = &self.scene.vertices;
        match touch {
            Touch::Surface { vertex, surface } => {
                vertex < body.len() && surface < self.scene.surfaces.len()
            }
            Touch::Side {
                vertex,
                obstacle,
                side,
            } => vertex < body.len() && corners(obstacle).is_some_and(|shape| side < sides(shape)),
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => body_side < sides(body) && corners(obstacle).is_some_and(|all| corner < all.len()),
        }
    }

    pub(crate) fn face(&self, pose: [f64; 3], touch: Touch) -> Face {
        let normal = self.facing(touch).at(pose[2]);
        let of = |obstacle: &Obstacle| Face {
            normal,
            friction_static: obstacle.friction_static,
            friction_dynamic: obstacle.friction_dynamic,
            memory: obstacle.memory,
        };
        match touch {
            Touch::Surface { surface, .. } => face(&self.scene.surfaces[surface]),
            Touch::Side { obstacle, .. } | Touch::Corner { obstacle, .. } => {
                of(&self.scene.obstacles[obstacle])
            }
        }
    }

    /// The unit normal towards the body.
    pub(crate) fn facing(&self, touch: Touch) -> Facing {
        match touch {
            Touch::Surface { surface, .. } => Facing::World(self.scene.surfaces[surface].normal),
            Touch::Side { obstacle, side, .. } => {
                Facing::World(outward(&self.scene.obstacles[obstacle].vertices, side))
            }
            Touch::Corner { body_side, .. } => {
                Facing::Body(scaled(outward(&self.scene.vertices, body_side), -1.0))
            }
        }
    }

    pub(crate) fn foot(&self, pose: [f64; 3], touch: Touch) -> Vec2 {
        match touch {
            Touch::Surface { vertex, .. } | Touch::Side { vertex, .. } => {
                Scene::place(pose, self.scene.vertices[vertex])
            }
            Touch::Corner {
                obstacle, corner, ..
            } => self.scene.obstacles[obstacle].vertices[corner],
        }
    }

    /// The point of the body at a contact, body frame.
    pub(crate) fn held(&self, pose: [f64; 3], touch: Touch) -> Vec2 {
        match touch.vertex() {
            Some(vertex) => self.scene.vertices[vertex],
            None => in_body(pose, self.foot(pose, touch)),
        }
    }

    /// Where a contact is, in the body and in the world.
    pub(crate) fn spot(&self, pose: [f64; 3], touch: Touch) -> Spot {
        Spot {
            held: self.held(pose, touch),
            at: self.foot(pose, touch),
        }
    }

    /// n·x - b for the vertex, or for the body's side at the corner: negative inside.
    pub(crate) fn gap(&self, pose: [f64; 3], touch: Touch) -> f64 {
        let foot = self.foot(pose, touch);
        match touch {
            Touch::Surface { surface, .. } => {
                let surface = &self.scene.surfaces[surface];
                dot(surface.normal, foot) - surface.offset
            }
            Touch::Side { obstacle, side, .. } => {
                let shape = &self.scene.obstacles[obstacle].vertices;
                dot(outward(shape, side), sub(foot, shape[side]))
            }
            Touch::Corner { body_side, .. } => {
                let shape = &self.scene.vertices;
                dot(
                    outward(shape, body_side),
                    sub(in_body(pose, foot), shape[body_side]),
                )
            }
        }
    }

    /// The distance of a contact from the nearer end of its side: negative beyond it. Half-planes have no ends.
    pub(crate) fn inside_ends(&self, pose: [f64; 3], touch: Touch) -> f64 {
        let foot = self.foot(pose, touch);
        let (place, [low, high]) = match touch {
            Touch::Surface { .. } => return f64::INFINITY,
            Touch::Side { obstacle, side, .. } => {
                let tangent = self.face(pose, touch).tangent();
                (dot(tangent, foot), self.sides.run(obstacle, side))
            }
            Touch::Corner { body_side, .. } => {
                let shape = &self.scene.vertices;
                let [x, y] = outward(shape, body_side);
                let [a, b] = ends(shape, body_side).map(|end| dot([y, -x], end));
                (dot([y, -x], in_body(pose, foot)), [a.min(b), a.max(b)])
            }
        };
        (place - low).min(high - place)
    }

    /// How deep the shape next to the vertex or corner is behind the line that it touches: at most 0 if the line supports it.
    pub(crate) fn unsupported(&self, pose: [f64; 3], touch: Touch) -> f64 {
        let below = |shape: &[Vec2], index: usize, normal: Vec2| {
            let gaps = neighbours(shape, index).map(|next| dot(normal, sub(next, shape[index])));
            -gaps.fold(0.0, f64::min)
        };
        match (touch, self.facing(touch)) {
            (Touch::Side { vertex, .. }, Facing::World(normal)) => {
                below(&self.scene.vertices, vertex, turned(normal, -pose[2]))
            }
            (
                Touch::Corner {
                    obstacle, corner, ..
                },
                Facing::Body(normal),
            ) => {
                let shape = &self.scene.obstacles[obstacle].vertices;
                below(shape, corner, scaled(turned(normal, pose[2]), -1.0))
            }
            _ => 0.0,
        }
    }

    /// The direction in which a [`mark`](Self::mark) moves as the body slides along t: t for a vertex, in the world frame; for a
    /// corner, in the body frame.
    pub(crate) fn along(&self, touch: Touch) -> Vec2 {
        let (Facing::World([x, y]) | Facing::Body([x, y])) = self.facing(touch);
        [y, -x]
    }

    /// The position that a contact keeps while it sticks: for a vertex in the world, as reported; for a corner in the body, reversed,
    /// so that it grows as the body moves on.
    pub(crate) fn mark(&self, pose: [f64; 3], contact: &Contact) -> Vec2 {
        match contact.touch.vertex() {
            Some(_) => contact.point,
            None => scaled(self.held(pose, contact.touch), -1.0),
        }
    }

    /// Whether two contacts lie on one line, with the same normal. `unknown`: the uncertainty of positions (m).
    pub(crate) fn lined(&self, pose: [f64; 3], [a, b]: [Touch; 2], unknown: f64) -> Lined {
        if let (Some(a), Some(b)) = (a.surface(), b.surface()) {
            return if a == b { Lined::Yes } else { Lined::No };
        }
        if share_vertex(a, b) {
            return Lined::No;
        }
        let on = |touch| match touch {
            Touch::Side { obstacle, side, .. } => Some((obstacle, side)),
            Touch::Surface { .. } | Touch::Corner { .. } => None,
        };
        let [first, second] = [a, b].map(|touch| self.face(pose, touch).normal);
        let apart = sub(self.foot(pose, b), self.foot(pose, a));
        let (turn, off) = (cross(first, second).abs(), dot(first, apart).abs());
        let reach = dot([first[1], -first[0]], apart).abs();
        let blur = 4.0 * unknown;
        if on(a).is_some() && on(a) == on(b) {
            Lined::Yes
        } else if dot(first, second) <= 0.0
            || off > LINE * self.size + blur
            || turn * reach > LINE * reach + OVERLAP * self.size + blur
        {
            Lined::No
        } else if turn <= SAME_LINE && off <= SAME_LINE * self.size {
            Lined::Yes
        } else {
            Lined::Maybe
        }
    }

    /// Every pair with an obstacle that may touch, except covered corners.
    pub(crate) fn pairs_with(&self, obstacle: usize) -> Vec<Touch> {
        let shape = &self.scene.obstacles[obstacle].vertices;
        let vertices = 0..self.scene.vertices.len();
        let on_sides = (0..sides(shape)).flat_map(|side| {
            (vertices.clone()).map(move |vertex| Touch::Side {
                vertex,
                obstacle,
                side,
            })
        });
        let body_sides = 0..sides(&self.scene.vertices);
        let corners = (0..shape.len()).filter(|&corner| !self.sides.is_covered(obstacle, corner));
        let at_corners = corners.flat_map(|corner| {
            (body_sides.clone()).map(move |body_side| Touch::Corner {
                obstacle,
                corner,
                body_side,
            })
        });
        on_sides.chain(at_corners).collect()
    }
}
