//! The scene: body, springs, surfaces with friction. Checked once, then immutable; the error names the parameter,
//! its value and what is allowed. Lengths are divided by L, the body's largest vertex distance, and forces by k_h L.

use crate::body::Body;
use crate::detect::Placed;
use crate::friction::Coulomb;
use crate::geometry::{Angle, Orientation, Pose, Vec2};
use crate::list::gather;
use crate::model::{Full, Model};
use crate::real::Real;
use crate::state::Pair;
use core::marker::PhantomData;
use core::ops::Range;
use heapless::Vec;

mod check;
mod description;

use check::{Carried, check_model, check_numbers, check_vertices, larger, size_of_point, surfaces};
pub use description::{Description, Parameter, SceneError, SurfaceDescription};

/// A checked surface, lengths / L.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Surface<R> {
    /// n: unit normal to the free side.
    pub(crate) normal: Vec2<R>,
    /// t = (n_y, -n_x)
    pub(crate) tangent: Vec2<R>,
    /// b: the free side is n·p >= b.
    pub(crate) offset: R,
    /// The point of the surface that is nearest to the origin.
    pub(crate) origin: Vec2<R>,
    /// Friction on this surface.
    pub(crate) friction: Coulomb<R>,
}

impl<R: Real> Surface<R> {
    /// Nothing reaches it.
    const NOWHERE: Self = Self {
        normal: Vec2::new(R::ZERO, R::ONE),
        tangent: Vec2::new(R::ONE, R::ZERO),
        offset: R::LEAST,
        origin: Vec2::ZERO,
        friction: Coulomb::FRICTIONLESS,
    };

    /// (N, T) of the contact that bears a force on the body.
    pub(crate) fn reaction(&self, force: Vec2<R>) -> (R, R) {
        (-self.normal.dot(force), -self.tangent.dot(force))
    }
}

/// The size of 1 inside the solver, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units<F> {
    /// L (m)
    length: F,
    /// k_h L (N)
    force: F,
    /// k_h L² (N·m)
    moment: F,
    /// 1/L (1/m)
    per_length: F,
}

impl<F: Real> Units<F> {
    fn new(length: F, stiffness_translation: F) -> Self {
        let force = stiffness_translation * length;
        Self {
            length,
            force,
            moment: force * length,
            per_length: F::ONE / length,
        }
    }
    /// Neither too large nor too small to divide by.
    fn are_usable(&self) -> bool {
        let usable = |unit: F| unit.is_finite() && unit > F::ONE / F::HUGE;
        usable(self.length) && usable(self.force) && usable(self.moment)
    }
    /// A length in metres made non-dimensional.
    pub(crate) fn length_from_si<R: Real<Si = F>>(&self, x: F) -> R {
        R::from_si(x, self.per_length)
    }
    /// A point in metres made non-dimensional.
    pub(crate) fn point_from_si<R: Real<Si = F>>(&self, [x, y]: [F; 2]) -> Vec2<R> {
        Vec2::new(self.length_from_si(x), self.length_from_si(y))
    }
    /// A force in newtons made non-dimensional.
    fn force_from_si<R: Real<Si = F>>(&self, x: F) -> R {
        R::from_si(x, F::ONE / self.force)
    }
    /// A moment in newton metres made non-dimensional.
    fn moment_from_si<R: Real<Si = F>>(&self, x: F) -> R {
        R::from_si(x, F::ONE / self.moment)
    }
    /// A length in metres.
    pub(crate) fn length_to_si<R: Real<Si = F>>(&self, x: R) -> F {
        x.to_si(self.length)
    }
    /// A point in metres.
    pub(crate) fn point_to_si<R: Real<Si = F>>(&self, v: Vec2<R>) -> [F; 2] {
        [v.x, v.y].map(|x| x.to_si(self.length))
    }
    /// A force in newtons.
    pub(crate) fn force_to_si<R: Real<Si = F>>(&self, x: R) -> F {
        x.to_si(self.force)
    }
    /// A moment in newton metres.
    pub(crate) fn moment_to_si<R: Real<Si = F>>(&self, x: R) -> F {
        x.to_si(self.moment)
    }
}

/// What the states ask of a scene. The constants are known to the compiler: what a scene cannot need is not compiled in.
pub(crate) trait World<R: Real> {
    /// A body of more than one vertex: it can lie on an edge.
    const EDGES: bool;
    /// More than one surface: it can touch two at once.
    const SURFACES: bool;
    /// Two contacts at once are possible.
    const SEVERAL: bool = Self::EDGES || Self::SURFACES;
    /// The only surface is without friction. A contact on it glides: its foot is where the tangential forces balance.
    const GLIDES: bool;

    /// Vertices, body frame, counter-clockwise.
    fn vertices(&self) -> &[Vec2<R>];
    /// The surface of an index; a plane that nothing reaches where there is none.
    fn surface(&self, index: u8) -> Surface<R>;
    /// The indices of all surfaces.
    fn surface_indices(&self) -> Range<u8>;
    /// cg, body frame.
    fn centroid(&self) -> Vec2<R>;
    /// k_theta / (k_h L²)
    fn stiffness(&self) -> R;
    /// The weight as a force, W / (k_h L).
    fn weight(&self) -> Vec2<R>;
    /// Balances and the ends of slips are found to within this angle (rad) and part of the body size; 0: as far as the
    /// digits go.
    fn tolerance(&self) -> R;

    /// v_i, body frame; the origin where there is no such vertex.
    fn vertex(&self, i: u8) -> Vec2<R> {
        let vertex = self.vertices().get(usize::from(i));
        vertex.copied().unwrap_or(Vec2::ZERO)
    }

    /// The indices of all vertices.
    fn vertex_indices(&self) -> Range<u8> {
        0..u8::try_from(self.vertices().len()).unwrap_or(u8::MAX)
    }

    /// The two neighbours of a vertex (of a rod twice the other one, of a point itself): on the surface that it touches
    /// nothing else can arrive first.
    fn neighbours(&self, i: u8) -> [u8; 2] {
        let last = self.vertex_indices().end.saturating_sub(1);
        let next = if i >= last { 0 } else { i.saturating_add(1) };
        let previous = if i == 0 { last } else { i.saturating_sub(1) };
        [next, previous]
    }
}

impl<R: Real, const V: usize, const S: usize, M: Model> World<R> for Scene<R, V, S, M> {
    const EDGES: bool = V > 1;
    const SURFACES: bool = S > 1;
    const GLIDES: bool = !M::FRICTION && S <= 1;

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
    fn tolerance(&self) -> R {
        self.tolerance
    }
    fn surface(&self, index: u8) -> Surface<R> {
        let surface = self.surfaces.get(usize::from(index));
        let mut surface = surface.copied().unwrap_or(Surface::NOWHERE);
        if !M::FRICTION {
            // As a constant it leaves nothing of the friction to compile.
            surface.friction = Coulomb::FRICTIONLESS;
        }
        surface
    }
    fn surface_indices(&self) -> Range<u8> {
        0..u8::try_from(self.surfaces.len()).unwrap_or(u8::MAX)
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
    pub(crate) tolerance: R,
    model: PhantomData<M>,
}

impl<R: Real, const V: usize, const S: usize, M: Model> Scene<R, V, S, M> {
    /// Checks a description and makes it non-dimensional (STATICS 10).
    ///
    /// # Errors
    /// [`SceneError`] names the first parameter that is not finite, out of its range or inconsistent with the others,
    /// its value and what is allowed.
    pub fn new(description: &Description<'_, R::Si>) -> Result<Self, SceneError<R::Si>> {
        let d = description;
        check_numbers(d)?;
        check_model::<R::Si, M>(d)?;
        let length = match check_vertices::<R::Si, V>(d.vertices)? {
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
        let scene = Self {
            body: Body::new(gather(d.vertices.iter().map(|&v| nd(v)))),
            surfaces: surfaces(d.surfaces, &units)?,
            stiffness: units.moment_from_si(d.stiffness_rotation),
            weight: Vec2::new(R::ZERO, -units.force_from_si::<R>(d.weight)),
            start,
            holding_point: d.holding_point.map(nd),
            reach: units.length_from_si(d.reach),
            units,
            tolerance: R::ZERO,
            model: PhantomData,
        };
        scene.check_range(d)?;
        scene.check_start()?;
        Ok(scene)
    }

    /// Coordinates beyond the range of the number type are refused: their sums would carry no digits.
    fn check_range(&self, d: &Description<'_, R::Si>) -> Result<(), SceneError<R::Si>> {
        let fits = |x: R| x.is_finite() && x.abs() <= R::RANGE;
        let allowed = Carried::by::<R>();
        let error = |parameter, value, allowed| {
            Err(SceneError {
                parameter,
                value,
                allowed,
            })
        };
        for (i, (vertex, given)) in self.vertices().iter().zip(d.vertices).enumerate() {
            if !fits(vertex.reach()) {
                return error(Parameter::Vertex(i), larger(*given), allowed.place);
            }
        }
        let [x, y, theta] = d.start;
        if !fits(self.start.position.reach()) {
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
            && !fits(g.reach())
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

    /// A vertex this near to a surface touches it from the beginning: 1e-5 of the body size.
    pub(crate) fn start_tolerance() -> R {
        // In floats: not every number type counts so far.
        R::from_si(one_in(100_000), R::Si::ONE)
    }
}

/// 1/n
fn one_in<F: Real>(n: i32) -> F {
    F::ONE / F::from_int(n)
}

#[cfg(test)]
mod tests;
