//! The scene: body, springs, surfaces and obstacles with friction. Checked once, then immutable; the error names the parameter, its value and
//! what is allowed.

use crate::geometry::{Angle, Rotation, Vec2, one_in};
use crate::list::gather;
use crate::obstacles::Corner;
use crate::obstacles::axes::At;
use crate::obstacles::union::unite;
use crate::real::Real;
use crate::state::HandPose;
use crate::units::Units;
use crate::world::{Side, Stiffness, World, united};
use heapless::Vec;

mod check;
mod description;
mod parts;

use check::{
    Representable, Room, check_numbers, check_obstacles, check_surfaces, check_vertices, fits,
    larger, size_of_point, thinnest,
};
pub use description::{
    Description, ObstacleDescription, Parameter, SceneError, SurfaceDescription,
};
use parts::{centroid, normals, plain, side};

/// A checked scene in numbers of type R, with room for V vertices, S surfaces and C corners of obstacles, for a solver. It never changes;
/// [`Description`] has an example. Without room for corners, the solver contains no code for obstacles.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene<R: Real, const V: usize, const S: usize, const C: usize = 0> {
    pub(crate) world: World<R, V, S, C>,
    pub(crate) units: Units<R::Si>,
    /// g, body frame, if the scene has one.
    pub(crate) holding_point: Option<Vec2<R>>,
    /// How far outside the body a hand may be and still take hold.
    pub(crate) reach: R,
    /// The pose of the body's origin at the start, and its whole turns.
    pub(crate) start: HandPose<R>,
    pub(crate) turns: i32,
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Scene<R, V, S, C> {
    /// Checks a description and makes it non-dimensional . Coplanar sides of obstacles that meet and have the same friction
    /// become one side.
    ///
    /// A box over the edge of a table:
    ///
    /// ```
    /// use stiction_core::{Description, ObstacleDescription, Parameter, Scene};
    ///
    /// let table = [ObstacleDescription {
    ///     vertices: &[[-0.5, -0.1], [0.0, -0.1], [0.0, 0.0], [-0.5, 0.0]],
    ///     friction_static: 0.5,
    ///     friction_dynamic: 0.3,
    ///     memory: None,
    /// }];
    /// let description = Description {
    ///     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
    ///     start: [-0.02, 0.03, 0.0],
    ///     weight: 2.0,
    ///     holding_point: Some([0.0, 0.02]),
    ///     reach: 0.0,
    ///     stiffness_translation: 500.0,
    ///     stiffness_rotation: 0.5,
    ///     surfaces: &[],
    ///     obstacles: &table,
    /// };
    /// // Room for 6 corners of obstacles.
    /// type Among = Scene<f32, 4, 1, 6>;
    /// assert!(Among::new(&description).is_ok());
    ///
    /// let sunk = Description { start: [-0.02, 0.02, 0.0], ..description };
    /// let error = Among::new(&sunk).expect_err("10 mm within the table");
    /// assert_eq!(error.parameter, Parameter::Overlap(0));
    ///
    /// let clockwise = [[0.2, 0.0], [0.2, 0.1], [0.3, 0.0]];
    /// let step = [ObstacleDescription { vertices: &clockwise, ..table[0] }];
    /// let error = Among::new(&Description { obstacles: &step, ..description }).expect_err("no polygon");
    /// assert!(error.to_string().starts_with("corner 2 of obstacle 0 is 0.3, allowed: a corner"));
    ///
    /// let error = Scene::<f32, 4, 1>::new(&description).expect_err("no room for obstacles");
    /// assert_eq!(error.parameter, Parameter::ObstacleCount);
    /// # Ok::<(), stiction_core::SceneError<f32>>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError`] names the first parameter that is not finite, out of its range or inconsistent with the others,
    /// its value and what is allowed.
    pub fn new(d: &Description<'_, R::Si>) -> Result<Self, SceneError<R::Si>> {
        check_numbers(d)?;
        let length = match check_vertices::<R::Si, V, C>(d.vertices, thinnest::<R>())? {
            length if length > R::Si::ZERO => length,
            _ => size_of_point(d),
        };
        let units = Units::new(d, length);
        check_units::<R>(d, &units)?;
        check_surfaces::<R, S>(d.surfaces)?;
        let room = Room {
            half_planes: d.surfaces.len(),
            corners: C,
        };
        check_obstacles::<R>(d.obstacles, &room, &units)?;
        let vertices = gather(d.vertices.iter().map(|&v| units.vector::<R>(v)));
        // In the floats of the description: in fixed point the area of a thin body has few places.
        let described: Vec<_, V> = gather(d.vertices.iter().map(|&v| units.vector::<R::Si>(v)));
        let (corners, obstacles) = if C > 0 {
            unite::<R, S, C>(d.surfaces, d.obstacles, &units)
        } else {
            (Vec::new(), Vec::new())
        };
        let [x, y, theta] = d.start;
        let theta = Angle::from_radians(theta);
        let k = d.stiffness_rotation;
        let scene = Self {
            world: World {
                centroid: plain(centroid(&described)),
                vertices,
                sides: united(gather(d.surfaces.iter().map(|s| side(s, &units)))),
                normals: gather(normals::<R>(d.vertices)),
                corners,
                obstacles,
                nowhere: Corner::NOWHERE,
                stiffness: Stiffness::new(
                    R::from_si(k, units.per_moment(1)),
                    R::from_si(k, units.per_moment(64)),
                ),
                weight: R::from_si(d.weight, units.per_force()),
            },
            units,
            holding_point: d.holding_point.map(|g| units.vector(g)),
            reach: units.length(d.reach),
            start: HandPose {
                at: units.point([x, y]),
                angle: R::from_si(theta.rest, R::Si::ONE),
            },
            turns: theta.turns,
        };
        scene.check_range(d)?;
        scene.check_start()?;
        Ok(scene)
    }

    /// Coordinates beyond the range of the number type are refused: their sums would have no digits left.
    fn check_range(&self, d: &Description<'_, R::Si>) -> Result<(), SceneError<R::Si>> {
        let allowed = Representable::by::<R>();
        let error = |parameter, value, allowed| {
            Err(SceneError {
                parameter,
                value,
                allowed,
            })
        };
        let world = &self.world;
        for (i, (vertex, given)) in world.vertices.iter().zip(d.vertices).enumerate() {
            if !fits(vertex.length_bound()) {
                return error(Parameter::Vertex(i), larger(*given), allowed.place);
            }
        }
        if self.start.angle.abs() > R::TAU {
            let [.., theta] = d.start;
            return error(
                Parameter::Start,
                theta,
                "turns that the number type can count",
            );
        }
        if let (Some(g), Some(given)) = (self.holding_point, d.holding_point)
            && !fits(g.length_bound())
        {
            return error(Parameter::HoldingPoint, larger(given), allowed.place);
        }
        for (i, (side, given)) in world.sides.iter().zip(d.surfaces).enumerate() {
            // One that another one covers is as far away as that.
            let is_covered = *side == Side::NOWHERE;
            if !is_covered && !fits(side.offset) {
                return error(Parameter::Offset(i), given.offset, allowed.offset);
            }
        }
        if !fits(world.stiffness.value) {
            let k_theta = d.stiffness_rotation;
            return error(Parameter::StiffnessRotation, k_theta, allowed.rotation);
        }
        if !fits(world.weight) {
            return error(Parameter::Weight, d.weight, allowed.weight);
        }
        Ok(())
    }

    /// At the start no vertex is deeper than 1e-5 of the body size inside a surface, nor the body in an obstacle.
    fn check_start(&self) -> Result<(), SceneError<R::Si>> {
        let allowed = "at most 1e-5 of the body's largest vertex distance";
        let at = At {
            rotation: Rotation::by(self.start.angle),
            g: self.start.at,
        };
        let grip = self.world.grip(Vec2::ZERO);
        let statics = self.world.held(&grip);
        let too_deep = |depth: R, parameter| {
            let error = SceneError {
                parameter,
                value: depth.to_si(self.units.length),
                allowed,
            };
            (depth > Self::start_tolerance()).then_some(error)
        };
        for (surface, side) in self.world.sides.iter().enumerate() {
            let depth = |v: &Vec2<R>| side.offset - side.normal.dot(at.g + at.rotation.apply(*v));
            let all = self.world.vertices.iter().map(depth).enumerate();
            let deepest = all.reduce(|worst, one| if one.1 > worst.1 { one } else { worst });
            let found = deepest.and_then(|(vertex, depth)| {
                too_deep(depth, Parameter::Penetration { surface, vertex })
            });
            if let Some(error) = found {
                return Err(error);
            }
        }
        for (index, obstacle) in statics.obstacles() {
            let widest = statics.widest(&obstacle, at);
            let found =
                widest.and_then(|w| too_deep(-w.gap, Parameter::Overlap(usize::from(index))));
            if let Some(error) = found {
                return Err(error);
            }
        }
        Ok(())
    }

    /// A vertex this close to a surface touches it from the beginning: 1e-5 of the body size.
    pub(crate) fn start_tolerance() -> R {
        // In floats: not every number type represents this.
        R::from_si(one_in(100_000), R::Si::ONE)
    }
}

/// The units can be divided by, and the start is so near the origin of the world that its coordinates have digits left within the body.
fn check_units<R: Real>(
    d: &Description<'_, R::Si>,
    units: &Units<R::Si>,
) -> Result<(), SceneError<R::Si>> {
    let [x, y, _] = d.start;
    let farther = larger([x, y]);
    if units.is_far(farther) {
        let is_double = R::Si::RANGE > R::Si::from_int(1_000_000);
        return Err(SceneError {
            parameter: Parameter::Start,
            value: farther,
            allowed: if is_double {
                "at most 1e12 body sizes from the origin"
            } else {
                "at most 1e6 body sizes from the origin"
            },
        });
    }
    if units.are_usable() {
        return Ok(());
    }
    Err(SceneError {
        parameter: Parameter::StiffnessTranslation,
        value: d.stiffness_translation,
        allowed: Representable::by::<R>().stiffness,
    })
}
