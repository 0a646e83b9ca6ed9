//! The scene: body, springs, surfaces with friction. Checked once, then immutable; the error names the parameter,
//! its value and what is allowed. Lengths are divided by L, the body's largest vertex distance, and forces by k_h L.

use crate::body::Body;
use crate::contact::Pair;
use crate::detect::Placed;
use crate::friction::Coulomb;
use crate::geometry::{Angle, Orientation, Pose, Vec2};
use crate::list::gather;
use crate::model::{Full, Model};
use crate::obstacle::{Corner, Obstacles, Round};
use crate::real::Real;
use crate::surface::Surface;
use crate::units::Units;
use crate::world::World;
use core::ops::Range;
use heapless::Vec;

mod check;
mod description;
mod obstacles;

pub(crate) use check::check_obstacle_count;
use check::{
    Representable, check_model, check_numbers, check_vertices, check_vertices_among, fits, larger,
    size_of_point, surfaces, thinnest,
};
pub use description::{
    Description, ObstacleDescription, Parameter, SceneError, SurfaceDescription,
};

impl<R: Real, const V: usize, const S: usize, M: Model> World<R> for Scene<R, V, S, M> {
    const EDGES: bool = V > 1;
    const SURFACES: bool = S > 1 || Self::CORNERS;
    const CORNERS: bool = <M::Obstacles<R, V> as Obstacles<R>>::CORNERS;
    const GLIDES: bool = !M::FRICTION && S <= 1 && !Self::CORNERS;

    fn vertices(&self) -> &[Vec2<R>] {
        self.body.vertices()
    }
    fn centroid(&self) -> Vec2<R> {
        self.body.centroid()
    }
    fn stiffness(&self) -> R {
        self.stiffness
    }
    fn weight(&self) -> Vec2<R> {
        if M::WEIGHT { self.weight } else { Vec2::ZERO }
    }
    /// A half-plane, or the side of an obstacle after them; without friction in a model that has none.
    fn surface(&self, index: u8) -> Surface<R> {
        let surface = self.surfaces.get(usize::from(index));
        let of_obstacle = || self.corner(index).map(|corner| &corner.side);
        let surface = if Self::CORNERS {
            surface.or_else(of_obstacle)
        } else {
            surface
        };
        let mut surface = *surface.unwrap_or(&Surface::NOWHERE);
        if !M::FRICTION {
            // As a constant it leaves no code of the friction to compile.
            surface.friction = Coulomb::FRICTIONLESS;
        }
        surface
    }
    fn surface_indices(&self) -> Range<u8> {
        0..u8::try_from(self.surfaces.len()).unwrap_or(u8::MAX)
    }
    fn corners(&self) -> &[Corner<R>] {
        self.obstacles.corners()
    }
    fn firsts(&self) -> &[u8] {
        self.obstacles.firsts()
    }
    fn rounds(&self) -> &[Round<R>] {
        self.obstacles.rounds()
    }
    fn body_normal(&self, side: u8) -> Vec2<R> {
        let [x, y] = self.obstacles.body_normal(side);
        Vec2::new(x, y)
    }
}

/// A checked scene in numbers of type R, with room for V vertices and S surfaces (at most 255 each), for a solver with the parts
/// of M. It never changes; [`Description`] has an example.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene<R: Real, const V: usize, const S: usize, M: Model = Full> {
    pub(crate) body: Body<R, V>,
    surfaces: Vec<Surface<R>, S>,
    stiffness: R,
    weight: Vec2<R>,
    pub(crate) start: Pose<R>,
    pub(crate) holding_point: Option<Vec2<R>>,
    pub(crate) reach: R,
    pub(crate) units: Units<R::Si>,
    pub(crate) obstacles: M::Obstacles<R, V>,
}

impl<R: Real, const V: usize, const S: usize, M: Model> Scene<R, V, S, M> {
    /// Checks a description and makes it non-dimensional (STATICS 10). Coplanar sides of obstacles that meet and have the same friction
    /// become one side.
    ///
    /// A box over the edge of a table:
    ///
    /// ```
    /// use stiction_core::{Description, ObstacleDescription, Parameter, Scene, WithObstacles};
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
    /// // Room for 2 obstacles, with 6 corners together.
    /// type Among = Scene<f32, 4, 1, WithObstacles<2, 6>>;
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
    /// let error = Scene::<f32, 4, 1>::new(&description).expect_err("a model without obstacles");
    /// assert_eq!(error.parameter, Parameter::ObstacleCount);
    /// # Ok::<(), stiction_core::SceneError<f32>>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError`] names the first parameter that is not finite, out of its range or inconsistent with the others,
    /// its value and what is allowed.
    pub fn new(description: &Description<'_, R::Si>) -> Result<Self, SceneError<R::Si>> {
        let d = description;
        check_numbers(d)?;
        check_model::<R::Si, M>(d)?;
        if Self::CORNERS {
            check_vertices_among(d.vertices)?;
        }
        let length = match check_vertices::<R::Si, V>(d.vertices, thinnest::<R>())? {
            length if length > R::Si::ZERO => length,
            _ => size_of_point(d),
        };
        let units = Units::new(length, d.stiffness_translation);
        let nd = |point| units.point_from_si::<R>(point);
        let [x, y, theta] = d.start;
        let theta = Angle::from_radians(theta);
        let start = Pose {
            position: nd([x, y]),
            orientation: Orientation::new(Angle {
                turns: theta.turns,
                rest: R::from_si(theta.rest, R::Si::ONE),
            }),
        };
        let mut scene = Self {
            body: Body::new(gather(d.vertices.iter().map(|&v| nd(v)))),
            surfaces: surfaces(d.surfaces, &units)?,
            stiffness: units.moment_from_si(d.stiffness_rotation),
            weight: Vec2::new(R::ZERO, -units.force_from_si::<R>(d.weight)),
            start,
            holding_point: d.holding_point.map(nd),
            reach: units.length_from_si(d.reach),
            units,
            obstacles: M::Obstacles::of_body(obstacles::normals::<R>(d.vertices)),
        };
        scene.check_range(d)?;
        scene.check_start()?;
        M::surround(&mut scene, d)?;
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
        for (i, (vertex, given)) in self.vertices().iter().zip(d.vertices).enumerate() {
            if !fits(vertex.length_bound()) {
                return error(Parameter::Vertex(i), larger(*given), allowed.place);
            }
        }
        let [x, y, theta] = d.start;
        if !fits(self.start.position.length_bound()) {
            return error(Parameter::Start, larger([x, y]), allowed.place);
        }
        if self.start.orientation.angle().rest.abs() > R::TAU {
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
        for (i, (surface, given)) in self.surfaces.iter().zip(d.surfaces).enumerate() {
            if !fits(surface.offset) {
                return error(Parameter::Offset(i), given.offset, allowed.offset);
            }
        }
        if !self.units.are_usable() {
            let k_h = d.stiffness_translation;
            return error(Parameter::StiffnessTranslation, k_h, allowed.stiffness);
        }
        if !fits(self.stiffness) {
            let k_theta = d.stiffness_rotation;
            return error(Parameter::StiffnessRotation, k_theta, allowed.rotation);
        }
        if !fits(self.weight.y) {
            return error(Parameter::Weight, d.weight, allowed.weight);
        }
        Ok(())
    }

    /// At the start no vertex is deeper than 1e-5 of the body size inside a surface.
    fn check_start(&self) -> Result<(), SceneError<R::Si>> {
        let placed = Placed::at(&self.start);
        for surface in self.surface_indices() {
            let gap = |vertex: u8| placed.gap(self, Pair { vertex, surface });
            let deepest = self.vertex_indices().fold((0, gap(0)), |worst, i| {
                if gap(i) < worst.1 { (i, gap(i)) } else { worst }
            });
            if deepest.1 < -Self::start_tolerance() {
                return Err(SceneError {
                    parameter: Parameter::Penetration {
                        surface: usize::from(surface),
                        vertex: usize::from(deepest.0),
                    },
                    value: self.units.length_to_si(-deepest.1),
                    allowed: "at most 1e-5 of the body's largest vertex distance",
                });
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

/// 1/n
fn one_in<F: Real>(n: i32) -> F {
    F::ONE / F::from_int(n)
}
