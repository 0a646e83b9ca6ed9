//! The scene: body, springs, surfaces with friction. Checked once, then immutable; the error names the parameter,
//! its value and what is allowed. Lengths are divided by L, the body's largest vertex distance, and forces by k_h L.

use crate::body::Body;
use crate::friction::Coulomb;
use crate::geometry::{Angle, Orientation, Pose, Vec2, unit};
use crate::list::gather;
use crate::real::Real;
use core::fmt;
use heapless::Vec;

/// A fixed half-plane in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceDescription<F> {
    /// Points to the free side; any length but 0.
    pub normal: [F; 2],
    /// The free side is normal·p >= offset [m], the normal taken with length 1.
    pub offset: F,
    /// Static friction mu_s >= mu_d.
    pub friction_static: F,
    /// Dynamic friction mu_d >= 0.
    pub friction_dynamic: F,
}

/// A scene in SI units, as it is given to [`Scene::new`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description<'a, F> {
    /// Vertices [m] in the body frame: one point, a rod of two, or a strictly convex polygon, counter-clockwise.
    pub vertices: &'a [[F; 2]],
    /// Start pose: x, y [m], theta [rad] of the body frame in the world.
    pub start: [F; 3],
    /// Weight W [N] >= 0 at the centroid, along world -y.
    pub weight: F,
    /// The initial holding point g [m], body frame; the rotation's rest offset is then 0. `None`: both are taken from
    /// the hand when it takes hold.
    pub holding_point: Option<[F; 2]>,
    /// How far outside the polygon a hand may be and still take hold [m] >= 0.
    pub reach: F,
    /// Translational stiffness k_h [N/m] > 0.
    pub stiffness_translation: F,
    /// Rotational stiffness k_theta [N·m/rad] >= 0.
    pub stiffness_rotation: F,
    /// The surfaces.
    pub surfaces: &'a [SurfaceDescription<F>],
}

/// The parameter that a [`SceneError`] is about. Indices count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// The number of vertices.
    VertexCount,
    /// A vertex.
    Vertex(usize),
    /// The start pose.
    Start,
    /// The weight.
    Weight,
    /// The initial holding point.
    HoldingPoint,
    /// The reach of the grasp.
    Reach,
    /// k_h
    StiffnessTranslation,
    /// k_theta
    StiffnessRotation,
    /// The number of surfaces.
    SurfaceCount,
    /// The normal of a surface.
    Normal(usize),
    /// The offset of a surface.
    Offset(usize),
    /// mu_s of a surface.
    FrictionStatic(usize),
    /// mu_d of a surface.
    FrictionDynamic(usize),
    /// Surface `surface` at the start: vertex `vertex` is inside it.
    Penetration {
        /// The surface.
        surface: usize,
        /// The deepest vertex.
        vertex: usize,
    },
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::VertexCount => write!(f, "number of vertices"),
            Self::Vertex(i) => write!(f, "vertex {i}"),
            Self::Start => write!(f, "start pose"),
            Self::Weight => write!(f, "weight"),
            Self::HoldingPoint => write!(f, "holding point"),
            Self::Reach => write!(f, "reach"),
            Self::StiffnessTranslation => write!(f, "translational stiffness k_h"),
            Self::StiffnessRotation => write!(f, "rotational stiffness k_theta"),
            Self::SurfaceCount => write!(f, "number of surfaces"),
            Self::Normal(i) => write!(f, "normal of surface {i}"),
            Self::Offset(i) => write!(f, "offset of surface {i}"),
            Self::FrictionStatic(i) => write!(f, "static friction of surface {i}"),
            Self::FrictionDynamic(i) => write!(f, "dynamic friction of surface {i}"),
            Self::Penetration { surface, vertex } => {
                write!(
                    f,
                    "depth of vertex {vertex} in surface {surface} at the start"
                )
            }
        }
    }
}

/// Why a scene cannot be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneError<F> {
    /// Which parameter.
    pub parameter: Parameter,
    /// Its value, SI units (for a vector the component that is at fault, for a count the count).
    pub value: F,
    /// What is allowed.
    pub allowed: &'static str,
}

impl<F: fmt::Debug> fmt::Display for SceneError<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} is {:?}, allowed: {}",
            self.parameter, self.value, self.allowed
        )
    }
}

impl<F: fmt::Debug> core::error::Error for SceneError<F> {}

/// A checked surface, lengths / L.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Surface<R> {
    /// n: unit normal to the free side.
    pub(crate) normal: Vec2<R>,
    /// t = (n_y, -n_x)
    pub(crate) tangent: Vec2<R>,
    /// b: the free side is n·p >= b.
    pub(crate) offset: R,
    /// Friction on this surface.
    pub(crate) friction: Coulomb<R>,
}

/// The size of 1 inside the solver, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units<F> {
    /// L [m]
    pub(crate) length: F,
    /// k_h L [N]
    pub(crate) force: F,
    /// k_h L² [N·m]
    pub(crate) moment: F,
}

impl<F: Real> Units<F> {
    fn new(length: F, stiffness_translation: F) -> Self {
        let force = stiffness_translation * length;
        Self {
            length,
            force,
            moment: force * length,
        }
    }
    /// Neither too large nor too small to divide by.
    fn are_usable(&self) -> bool {
        let usable = |unit: F| unit.is_finite() && unit > F::ONE / F::HUGE;
        usable(self.length) && usable(self.force) && usable(self.moment)
    }
    fn of_length(&self, x: F) -> F {
        x / self.length
    }
    fn of_force(&self, x: F) -> F {
        x / self.force
    }
    fn of_moment(&self, x: F) -> F {
        x / self.moment
    }
    pub(crate) fn to_length(self, x: F) -> F {
        x * self.length
    }
    pub(crate) fn to_force(self, x: F) -> F {
        x * self.force
    }
    pub(crate) fn to_moment(self, x: F) -> F {
        x * self.moment
    }
    /// A point in metres made non-dimensional.
    pub(crate) fn point_from_si<R: Real<Si = F>>(&self, [x, y]: [F; 2]) -> Vec2<R> {
        Vec2::new(R::from_si(self.of_length(x)), R::from_si(self.of_length(y)))
    }
    /// A point in metres.
    pub(crate) fn point_to_si<R: Real<Si = F>>(self, v: Vec2<R>) -> [F; 2] {
        [v.x, v.y].map(|x| self.to_length(x.to_si()))
    }
    /// A force in newtons.
    pub(crate) fn force_to_si<R: Real<Si = F>>(self, v: Vec2<R>) -> [F; 2] {
        [v.x, v.y].map(|x| self.to_force(x.to_si()))
    }
}

/// A checked scene with room for V vertices and S surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene<R: Real, const V: usize, const S: usize> {
    pub(crate) body: Body<R, V>,
    pub(crate) surfaces: Vec<Surface<R>, S>,
    /// k_theta / (k_h L²)
    pub(crate) stiffness: R,
    /// The weight as a force, W / (k_h L).
    pub(crate) weight: Vec2<R>,
    pub(crate) start: Pose<R>,
    pub(crate) holding_point: Option<Vec2<R>>,
    pub(crate) reach: R,
    pub(crate) units: Units<R::Si>,
}

impl<R: Real, const V: usize, const S: usize> Scene<R, V, S> {
    /// Checks a description and makes it non-dimensional.
    ///
    /// # Errors
    /// [`SceneError`] names the first parameter that is not finite, out of its range or inconsistent with the others,
    /// its value and what is allowed.
    pub fn new(description: &Description<'_, R::Si>) -> Result<Self, SceneError<R::Si>> {
        let d = description;
        check_numbers(d)?;
        let length = check_vertices::<R::Si, V>(d.vertices)?;
        let units = Units::new(length, d.stiffness_translation);
        let nd = |point| units.point_from_si::<R>(point);
        let [x, y, theta] = d.start;
        let theta = Angle::from_radians(theta);
        let start = Pose {
            position: nd([x, y]),
            orientation: Orientation::new(Angle {
                turns: theta.turns,
                rest: R::from_si(theta.rest),
            }),
        };
        let scene = Self {
            body: Body::new(gather(d.vertices.iter().map(|&v| nd(v)))),
            surfaces: surfaces(d.surfaces, &units)?,
            stiffness: R::from_si(units.of_moment(d.stiffness_rotation)),
            weight: Vec2::new(R::ZERO, -R::from_si(units.of_force(d.weight))),
            start,
            holding_point: d.holding_point.map(nd),
            reach: R::from_si(units.of_length(d.reach)),
            units,
        };
        scene.check_range(d)?;
        scene.check_start()?;
        Ok(scene)
    }

    /// The surface of an index; a plane that nothing reaches where there is none.
    pub(crate) fn surface(&self, index: u8) -> Surface<R> {
        self.surfaces
            .get(usize::from(index))
            .copied()
            .unwrap_or(Surface {
                normal: Vec2::new(R::ZERO, R::ONE),
                tangent: Vec2::new(R::ONE, R::ZERO),
                offset: -R::HUGE,
                friction: Coulomb::FRICTIONLESS,
            })
    }

    /// The indices of all surfaces.
    pub(crate) fn surface_indices(&self) -> impl Iterator<Item = u8> + use<R, V, S> {
        0..u8::try_from(self.surfaces.len()).unwrap_or(u8::MAX)
    }

    /// Coordinates beyond the range of the number type are refused: their sums would carry no digits.
    fn check_range(&self, d: &Description<'_, R::Si>) -> Result<(), SceneError<R::Si>> {
        let fits = |x: R| x.is_finite() && x.abs() <= R::RANGE;
        let error = |parameter, value| {
            Err(SceneError {
                parameter,
                value,
                allowed: "a value that the number type can carry in units of the body's size",
            })
        };
        let [x, y, _] = d.start;
        if !fits(self.start.position.reach()) {
            return error(Parameter::Start, x.abs().max(y.abs()));
        }
        if let (Some(g), Some([gx, gy])) = (self.holding_point, d.holding_point)
            && !fits(g.reach())
        {
            return error(Parameter::HoldingPoint, gx.abs().max(gy.abs()));
        }
        for (i, (surface, given)) in self.surfaces.iter().zip(d.surfaces).enumerate() {
            if !fits(surface.offset) {
                return error(Parameter::Offset(i), given.offset);
            }
        }
        if !self.units.are_usable() {
            return error(Parameter::StiffnessTranslation, d.stiffness_translation);
        }
        if !fits(self.stiffness) {
            return error(Parameter::StiffnessRotation, d.stiffness_rotation);
        }
        if !fits(self.weight.y) {
            return error(Parameter::Weight, d.weight);
        }
        Ok(())
    }

    /// At the start no vertex is deeper than 1e-5 of the body size inside a surface.
    fn check_start(&self) -> Result<(), SceneError<R::Si>> {
        let rotation = self.start.orientation.rotation();
        for (s, surface) in self.surface_indices().zip(&self.surfaces) {
            let gap = |i: u8| {
                let vertex = self.start.position + rotation.apply(self.body.vertex(i));
                surface.normal.dot(vertex) - surface.offset
            };
            let deepest = self.body.indices().fold((0, gap(0)), |worst, i| {
                if gap(i) < worst.1 { (i, gap(i)) } else { worst }
            });
            if deepest.1 < -Self::start_tolerance() {
                return Err(SceneError {
                    parameter: Parameter::Penetration {
                        surface: usize::from(s),
                        vertex: usize::from(deepest.0),
                    },
                    value: self.units.to_length((-deepest.1).to_si()),
                    allowed: "at most 1e-5 of the body's largest vertex distance",
                });
            }
        }
        Ok(())
    }

    /// A vertex this near to a surface touches it from the beginning: 1e-5 of the body size.
    pub(crate) fn start_tolerance() -> R {
        R::ONE / R::from_int(100_000)
    }
}

type Checked<F> = Result<(), SceneError<F>>;

/// Refuses `value` unless it is finite and `holds`.
fn require<F: Real>(
    holds: bool,
    parameter: Parameter,
    value: F,
    allowed: &'static str,
) -> Checked<F> {
    if value.is_finite() && holds {
        Ok(())
    } else {
        Err(SceneError {
            parameter,
            value,
            allowed,
        })
    }
}

/// The single numbers of a description.
fn check_numbers<F: Real>(d: &Description<'_, F>) -> Checked<F> {
    for value in d.start {
        require(true, Parameter::Start, value, "finite numbers")?;
    }
    for value in d.holding_point.into_iter().flatten() {
        require(true, Parameter::HoldingPoint, value, "finite numbers")?;
    }
    require(
        d.weight >= F::ZERO,
        Parameter::Weight,
        d.weight,
        "0 or more",
    )?;
    require(d.reach >= F::ZERO, Parameter::Reach, d.reach, "0 or more")?;
    let (k_h, k_theta) = (d.stiffness_translation, d.stiffness_rotation);
    require(
        k_h > F::ZERO,
        Parameter::StiffnessTranslation,
        k_h,
        "more than 0",
    )?;
    require(
        k_theta >= F::ZERO,
        Parameter::StiffnessRotation,
        k_theta,
        "0 or more",
    )
}

/// The vertices; gives L, the largest distance between two of them (1 m for a point).
fn check_vertices<F: Real, const V: usize>(vertices: &[[F; 2]]) -> Result<F, SceneError<F>> {
    let count = vertices.len();
    let shown = F::from_int(i32::try_from(count).unwrap_or(i32::MAX));
    let fits = count >= 1 && count <= V && count <= usize::from(u8::MAX);
    require(
        fits,
        Parameter::VertexCount,
        shown,
        "1 to the capacity of the solver, and at most 255",
    )?;
    for (i, v) in vertices.iter().enumerate() {
        for &value in v {
            require(true, Parameter::Vertex(i), value, "finite numbers")?;
        }
    }
    let at = |[x, y]: [F; 2]| Vec2::new(x, y);
    let mut length = F::ZERO;
    for (i, &v) in vertices.iter().enumerate() {
        for &u in vertices.iter().take(i) {
            let distance = (at(v) - at(u)).length();
            require(
                distance > F::ZERO && distance.is_finite(),
                Parameter::Vertex(i),
                v[0],
                "a place of its own: no vertex twice, none too far",
            )?;
            length = length.max(distance);
        }
    }
    if count == 1 {
        return Ok(F::ONE);
    }
    if count > 2 {
        check_convex(vertices, length)?;
    }
    Ok(length)
}

/// Every vertex lies to the left of every side, but for the two that the side joins.
fn check_convex<F: Real>(vertices: &[[F; 2]], length: F) -> Checked<F> {
    let at = |[x, y]: [F; 2]| Vec2::new(x / length, y / length);
    let ends = vertices.iter().skip(1).chain(vertices.first());
    for (i, (&from, &to)) in vertices.iter().zip(ends).enumerate() {
        let side = at(to) - at(from);
        for (k, &v) in vertices.iter().enumerate() {
            let joined = v == from || v == to;
            require(
                joined || side.cross(at(v) - at(from)) > F::ZERO,
                Parameter::Vertex(k),
                v[0],
                if i == 0 && k == 2 {
                    "a corner of a strictly convex polygon, counter-clockwise"
                } else {
                    "a corner of a strictly convex polygon, counter-clockwise, not on or beyond another side"
                },
            )?;
        }
    }
    Ok(())
}

/// Checks and normalises the surfaces.
fn surfaces<R: Real, const S: usize>(
    given: &[SurfaceDescription<R::Si>],
    units: &Units<R::Si>,
) -> Result<Vec<Surface<R>, S>, SceneError<R::Si>> {
    let count = R::Si::from_int(i32::try_from(given.len()).unwrap_or(i32::MAX));
    let fits = given.len() <= S && given.len() <= usize::from(u8::MAX);
    let capacity = "0 to the capacity of the solver, and at most 255";
    require(fits, Parameter::SurfaceCount, count, capacity)?;
    let mut checked = Vec::new();
    for (i, d) in given.iter().enumerate() {
        let [x, y] = d.normal;
        let size = x.hypot(y);
        let finite = if x.is_finite() { y } else { x };
        require(
            size.is_finite() && size > R::Si::ZERO,
            Parameter::Normal(i),
            if finite.is_finite() { size } else { finite },
            "a finite vector that is not zero",
        )?;
        require(true, Parameter::Offset(i), d.offset, "a finite number")?;
        let (mu_s, mu_d) = (d.friction_static, d.friction_dynamic);
        require(
            mu_d >= R::Si::ZERO,
            Parameter::FrictionDynamic(i),
            mu_d,
            "0 or more",
        )?;
        require(
            mu_s >= mu_d,
            Parameter::FrictionStatic(i),
            mu_s,
            "not less than the dynamic friction",
        )?;
        let (x, y) = unit(x, y);
        let normal = Vec2::new(R::from_si(x), R::from_si(y));
        // The slice is not longer than S, so there is room.
        let _ = checked.push(Surface {
            normal,
            tangent: Vec2::new(normal.y, -normal.x),
            offset: R::from_si(units.of_length(d.offset)),
            friction: Coulomb::from_coefficients(mu_s, mu_d),
        });
    }
    Ok(checked)
}
