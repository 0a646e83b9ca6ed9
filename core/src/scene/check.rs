//! The checks of a description that need only its numbers. The first fault ends them.

use super::{Description, Parameter, SceneError, SurfaceDescription};
use crate::geometry::Vec2;
use crate::real::Real;

mod obstacles;
mod outline;

pub(super) use obstacles::{Room, check_obstacles};
use outline::{check_convex, spread};

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

/// The coordinate with the larger magnitude.
pub(super) fn larger<F: Real>([x, y]: [F; 2]) -> F {
    if y.abs() > x.abs() { y } else { x }
}

/// The descriptions of what is allowed for numbers that the number type must represent.
pub(super) struct Representable {
    /// For x and y of a position.
    pub(super) place: &'static str,
    /// For the offset of a surface.
    pub(super) offset: &'static str,
    /// For k_h.
    pub(super) stiffness: &'static str,
    /// For k_theta.
    pub(super) rotation: &'static str,
    /// For W.
    pub(super) weight: &'static str,
}

/// With [`Real::RANGE`] of a number type and 1 / [`Real::HUGE`] of its float.
macro_rules! representable {
    ($range:literal, $least:literal) => {
        Representable {
            place: concat!(
                "the larger coordinate and half the other at most ",
                $range,
                " body sizes from where the body starts"
            ),
            offset: concat!("at most ", $range, " body sizes from where the body starts"),
            stiffness: concat!(
                "L, k_h L and k_h L^2 finite and more than ",
                $least,
                ", L the body's size"
            ),
            rotation: concat!("at most ", $range, " k_h L^2, L the body's size"),
            weight: concat!("at most ", $range, " k_h L, L the body's size"),
        }
    };
}

impl Representable {
    /// The descriptions for a number type.
    pub(super) fn by<R: Real>() -> Self {
        if R::RANGE <= R::from_int(16) {
            representable!("16", "1e-15")
        } else if R::RANGE <= R::from_int(1_000_000) {
            representable!("1e6", "1e-15")
        } else {
            representable!("1e12", "1e-30")
        }
    }
}

/// The single numbers of a description.
pub(super) fn check_numbers<F: Real>(d: &Description<'_, F>) -> Checked<F> {
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

/// Returns whether the number type represents it as a coordinate.
pub(super) fn fits<R: Real>(x: R) -> bool {
    x.is_finite() && x.abs() <= R::RANGE
}

/// The friction of a surface or an obstacle as it is given.
struct GivenFriction<F> {
    mu_s: F,
    mu_d: F,
    /// The memory length (m).
    memory: Option<F>,
}

impl<F: Real> GivenFriction<F> {
    /// Checks that mu_s >= mu_d >= 0, and the memory length; `names`: of the three.
    fn check(&self, names: [Parameter; 3]) -> Checked<F> {
        let [fixed, sliding, length] = names;
        require(self.mu_d >= F::ZERO, sliding, self.mu_d, "0 or more")?;
        let allowed = "not less than the dynamic friction";
        require(self.mu_s >= self.mu_d, fixed, self.mu_s, allowed)?;
        let given = self.memory.unwrap_or(F::ZERO);
        require(given >= F::ZERO, length, given, "0 or more")
    }
}

/// Checks the vertices; returns the largest distance between two of them, 0 for a point.
pub(super) fn check_vertices<F: Real, const V: usize, const C: usize>(
    vertices: &[[F; 2]],
    thinnest: F,
) -> Result<F, SceneError<F>> {
    let count = vertices.len();
    let shown = F::from_int(i32::try_from(count).unwrap_or(i32::MAX));
    // Among obstacles a contact numbers a vertex with seven bits, on the wire.
    let (most, allowed) = if C > 0 {
        (
            128,
            "1 to the capacity of the solver, and at most 128 among obstacles",
        )
    } else {
        (255, "1 to the capacity of the solver, and at most 255")
    };
    let fits = count >= 1 && count <= V && count <= most;
    require(fits, Parameter::VertexCount, shown, allowed)?;
    let length = spread(vertices, Parameter::Vertex)?;
    check_convex(vertices, length, thinnest, Parameter::Vertex)?;
    Ok(length)
}

/// L of a point, which has no size: 1 m, or the nearest power of two from r/4 to 8 r, where r² = d² + k_theta / k_h and d is the lever of
/// the holding point. The stability of the balance, about r² / L², is then a number that every type represents, and so is its reciprocal.
pub(super) fn size_of_point<F: Real>(d: &Description<'_, F>) -> F {
    let mut square = d.stiffness_rotation / d.stiffness_translation;
    for (g, v) in d.holding_point.iter().zip(d.vertices) {
        let lever = Vec2::new(g[0] - v[0], g[1] - v[1]);
        square = square + lever.dot(lever);
    }
    let mut size = F::ONE;
    if square > F::ZERO && square.is_finite() {
        while size * size > square * F::from_int(64) {
            size = size.halved();
        }
        while size * size * F::from_int(16) < square {
            size = size.doubled();
        }
    }
    size
}

/// The least distance, in body sizes, of a vertex from the sides that do not end at it; a thinner body is a rod. Displacements up to
/// [`Real::MICRO`] count as none: with three times that no more than two vertices touch one surface. The share of a load that two contacts
/// at this distance bear is known to a 256th.
pub(super) fn thinnest<R: Real>() -> R::Si {
    let known = R::EPSILON * R::from_int(16) * R::from_int(16);
    let thinnest = known.max(R::MICRO * R::from_int(3));
    thinnest.to_si(R::Si::ONE)
}

/// Checks the surfaces.
pub(super) fn check_surfaces<R: Real, const S: usize>(
    given: &[SurfaceDescription<R::Si>],
) -> Checked<R::Si> {
    let count = R::Si::from_int(i32::try_from(given.len()).unwrap_or(i32::MAX));
    let fits = given.len() <= S && given.len() <= usize::from(u8::MAX);
    let capacity = "0 to the capacity of the solver, and at most 255";
    require(fits, Parameter::SurfaceCount, count, capacity)?;
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
        let friction = GivenFriction {
            mu_s: d.friction_static,
            mu_d: d.friction_dynamic,
            memory: d.memory,
        };
        friction.check([
            Parameter::FrictionStatic(i),
            Parameter::FrictionDynamic(i),
            Parameter::Memory(i),
        ])?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
