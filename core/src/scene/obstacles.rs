//! The obstacles of a scene: checked, made non-dimensional, with the sides that make one line and the corners that are covered.

use super::check::default_memory;
use super::{Description, ObstacleDescription, Scene, SceneError};
use crate::friction::Coulomb;
use crate::geometry::{Vec2, normalized};
use crate::list::gather;
use crate::model::{Model, WithObstacles};
use crate::obstacle::Corner;
use crate::real::Real;
use crate::world::{Surface, World};

impl<R: Real, const V: usize, const S: usize, const O: usize, const C: usize, M: Model>
    Scene<R, V, S, WithObstacles<O, C, M>>
{
    /// Checks a description and obstacles and makes them non-dimensional (STATICS 10, 12).
    ///
    /// # Errors
    /// As [`Scene::new`]; and the first parameter of an obstacle that is not finite, out of its range or inconsistent with the others.
    pub fn among(
        description: &Description<'_, R::Si>,
        obstacles: &[ObstacleDescription<'_, R::Si>],
    ) -> Result<Self, SceneError<R::Si>> {
        let mut scene = Self::new(description)?;
        let ends = description.vertices.iter().skip(1);
        let sides = (description.vertices.iter()).zip(ends.chain(description.vertices.first()));
        if description.vertices.len() > 1 {
            let normals = sides.map(|(from, to)| outward::<R>(*from, *to).0);
            scene.obstacles.body_normals = gather(normals);
        }
        for (index, obstacle) in obstacles.iter().enumerate() {
            scene.add(index, obstacle);
        }
        Ok(scene)
    }

    fn add(&mut self, index: usize, given: &ObstacleDescription<'_, R::Si>) {
        let memory = given
            .memory
            .map_or(default_memory(), |memory| self.units.length_from_si(memory));
        let (mu_s, mu_d) = (given.friction_static, given.friction_dynamic);
        let friction = Coulomb::from_coefficients(mu_s, mu_d, memory);
        let first = u8::try_from(self.obstacles.corners.len()).unwrap_or(u8::MAX);
        let _ = self.obstacles.firsts.push(first);
        let ends = given.vertices.iter().skip(1);
        let sides = (given.vertices.iter()).zip(ends.chain(given.vertices.first()));
        for (from, to) in sides {
            let place: Vec2<R> = self.units.point_from_si(*from);
            let end: Vec2<R> = self.units.point_from_si(*to);
            let (normal, offset) = outward::<R>(*from, *to);
            let offset = self.units.length_from_si(offset);
            let tangent = Vec2::new(normal.y, -normal.x);
            let side = Surface {
                normal,
                tangent,
                offset,
                origin: normal * offset,
                friction,
            };
            let line = u8::try_from(self.obstacles.corners.len()).unwrap_or(u8::MAX);
            let _ = self.obstacles.corners.push(Corner {
                place,
                side,
                reach: [tangent.dot(end), tangent.dot(place)],
                line: self.surface_indices().end.saturating_add(line),
                obstacle: u8::try_from(index).unwrap_or(u8::MAX),
                covered: false,
            });
        }
    }
}

/// The outward normal of a side between two points, in SI units, and its offset; of a pin something.
fn outward<R: Real>(from: [R::Si; 2], to: [R::Si; 2]) -> (Vec2<R>, R::Si) {
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    let (x, y) = if x == R::Si::ZERO && y == R::Si::ZERO {
        (R::Si::ONE, R::Si::ZERO)
    } else {
        normalized(x, y)
    };
    let offset = R::Si::sum_of_products(y, from[0], -x, from[1]);
    let normal = Vec2::new(R::from_si(y, R::Si::ONE), R::from_si(-x, R::Si::ONE));
    (normal, offset)
}
