//! The obstacles of a scene: checked, made non-dimensional, with the sides that form one line and the corners that are covered.

use super::check::{Room, check_obstacles, default_memory, sides};
use super::{Description, ObstacleDescription, Parameter, Scene, SceneError};
use crate::detect::Placed;
use crate::friction::Coulomb;
use crate::geometry::{Vec2, normalized};
use crate::list::gather;
use crate::model::{Model, WithObstacles};
use crate::obstacle::{Corner, Round};
use crate::real::Real;
use crate::surface::Surface;
use crate::world::World;
use heapless::Vec;
use union::{Outline, Side, cover, cover_hollows, join};

mod union;

impl<R: Real, const V: usize, const S: usize, const O: usize, const C: usize, M: Model>
    Scene<R, V, S, WithObstacles<O, C, M>>
{
    /// Checks the obstacles and makes them non-dimensional (STATICS 12).
    pub(crate) fn surround(
        &mut self,
        description: &Description<'_, R::Si>,
    ) -> Result<(), SceneError<R::Si>> {
        let room = Room {
            half_planes: description.surfaces.len(),
            obstacles: O,
            corners: C,
        };
        check_obstacles::<R, M>(description.obstacles, &room, &self.units)?;
        for (index, obstacle) in description.obstacles.iter().enumerate() {
            self.add(index, obstacle);
        }
        self.unite(description);
        self.check_apart()
    }

    /// Adds an obstacle as if there were no other.
    fn add(&mut self, index: usize, given: &ObstacleDescription<'_, R::Si>) {
        let friction = if M::FRICTION {
            let memory = given
                .memory
                .map_or(default_memory(), |memory| self.units.length_from_si(memory));
            Coulomb::from_coefficients(given.friction_static, given.friction_dynamic, memory)
        } else {
            Coulomb::FRICTIONLESS
        };
        let first = u8::try_from(self.obstacles.corners.len()).unwrap_or(u8::MAX);
        // There is room for it, and for its corners.
        let _ = self.obstacles.firsts.push(first);
        let places = given
            .vertices
            .iter()
            .map(|&at| self.units.point_from_si(at));
        let _ = self.obstacles.rounds.push(Round::about(places));
        for (from, to) in sides(given.vertices) {
            let [place, end]: [Vec2<R>; 2] = [from, to].map(|at| self.units.point_from_si(at));
            let [x, y] = outward(from, to);
            let offset = R::Si::sum_of_products(x, from[0], y, from[1]);
            let offset = self.units.length_from_si(offset);
            let [x, y] = [x, y].map(|x| R::from_si(x, R::Si::ONE));
            let normal = Vec2::new(x, y);
            let tangent = Vec2::new(normal.y, -normal.x);
            let line = u8::try_from(self.obstacles.corners.len()).unwrap_or(u8::MAX);
            let _ = self.obstacles.corners.push(Corner {
                place,
                side: Surface {
                    normal,
                    tangent,
                    offset,
                    origin: normal * offset,
                    friction,
                },
                reach: [tangent.dot(end), tangent.dot(place)],
                line: self.surface_indices().end.saturating_add(line),
                obstacle: u8::try_from(index).unwrap_or(u8::MAX),
                covered: false,
            });
        }
    }

    /// Unites the obstacles and the half-planes to one world: in the outside float, in which their positions have not been rounded to the
    /// number type.
    fn unite(&mut self, description: &Description<'_, R::Si>) {
        let given = description.obstacles;
        let nd = |at: [R::Si; 2]| self.units.point_from_si::<R::Si>(at);
        let all = given.iter().flat_map(|obstacle| sides(obstacle.vertices));
        let lines: Vec<Side<R::Si>, C> = gather(all.map(|(from, to)| Side::new(nd(from), nd(to))));
        let corners = &mut self.obstacles.corners;
        join(corners, &lines);
        for (index, obstacle) in given.iter().enumerate() {
            let outline = Outline::<_, C>::new(obstacle.vertices.iter().map(|&at| nd(at)));
            for (corner, side) in corners.iter_mut().zip(&lines) {
                corner.covered |= match usize::from(corner.obstacle) {
                    own if own == index => false,
                    own => outline.covers::<R>(side.from, index < own),
                };
            }
        }
        cover_hollows(corners, &lines);
        for surface in description.surfaces {
            let (x, y) = normalized(surface.normal[0], surface.normal[1]);
            let offset = self.units.length_from_si(surface.offset);
            cover(corners, &lines, Vec2::new(x, y), offset);
        }
    }

    /// At the start the body is not deeper than 1e-5 of its size in an obstacle.
    fn check_apart(&self) -> Result<(), SceneError<R::Si>> {
        let placed = Placed::at(&self.start);
        for obstacle in 0..self.firsts().len() {
            let depth = -placed.separation(self, obstacle);
            if depth > Self::start_tolerance() {
                return Err(SceneError {
                    parameter: Parameter::Overlap(obstacle),
                    value: self.units.length_to_si(depth),
                    allowed: "at most 1e-5 of the body's largest vertex distance",
                });
            }
        }
        Ok(())
    }
}

/// The outward normals of the sides of a body, body frame; a point has none.
pub(super) fn normals<R: Real>(vertices: &[[R::Si; 2]]) -> impl Iterator<Item = [R; 2]> {
    let is_point = vertices.len() < 2;
    let sides = sides(vertices).filter(move |_| !is_point);
    sides.map(|(from, to)| outward(from, to).map(|x| R::from_si(x, R::Si::ONE)))
}

/// The outward unit normal of the side between two corners, counter-clockwise; for a pin any unit vector.
fn outward<F: Real>(from: [F; 2], to: [F; 2]) -> [F; 2] {
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    if x == F::ZERO && y == F::ZERO {
        return [F::ZERO, -F::ONE];
    }
    let (x, y) = normalized(x, y);
    [y, -x]
}

#[cfg(test)]
mod tests;
