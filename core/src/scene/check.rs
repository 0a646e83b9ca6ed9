//! The checks of a description that need nothing but its numbers. The first fault ends them.

use super::{Description, Parameter, SceneError, Surface, SurfaceDescription, Units};
use crate::friction::Coulomb;
use crate::geometry::{Vec2, unit};
use crate::model::Model;
use crate::real::Real;
use heapless::Vec;

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

/// The coordinate of the larger size.
pub(super) fn larger<F: Real>([x, y]: [F; 2]) -> F {
    if y.abs() > x.abs() { y } else { x }
}

/// What is said to be allowed of numbers that the number type must carry.
pub(super) struct Carried {
    /// Of x and y of a place.
    pub(super) place: &'static str,
    /// Of the offset of a surface.
    pub(super) offset: &'static str,
    /// Of k_h.
    pub(super) stiffness: &'static str,
    /// Of k_theta.
    pub(super) rotation: &'static str,
    /// Of W.
    pub(super) weight: &'static str,
}

/// With [`Real::RANGE`] of a number type and 1 / [`Real::HUGE`] of its float.
macro_rules! carried {
    ($range:literal, $least:literal) => {
        Carried {
            place: concat!(
                "the larger coordinate and half the other at most ",
                $range,
                " body sizes"
            ),
            offset: concat!("at most ", $range, " body sizes"),
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

impl Carried {
    /// In the words for a number type.
    pub(super) fn by<R: Real>() -> Self {
        if R::RANGE <= R::from_int(16) {
            carried!("16", "1e-15")
        } else if R::RANGE <= R::from_int(1_000_000) {
            carried!("1e6", "1e-15")
        } else {
            carried!("1e12", "1e-30")
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

/// Friction and weight only where the model has them.
pub(super) fn check_model<F: Real, M: Model>(d: &Description<'_, F>) -> Checked<F> {
    require(
        M::WEIGHT || d.weight == F::ZERO,
        Parameter::Weight,
        d.weight,
        "0 in a model without weight",
    )?;
    for (i, surface) in d.surfaces.iter().enumerate() {
        let mu_s = surface.friction_static;
        require(
            M::FRICTION || mu_s == F::ZERO,
            Parameter::FrictionStatic(i),
            mu_s,
            "0 in a model without friction",
        )?;
    }
    Ok(())
}

/// The vertices; gives the largest distance between two of them, 0 for a point.
pub(super) fn check_vertices<F: Real, const V: usize>(
    vertices: &[[F; 2]],
) -> Result<F, SceneError<F>> {
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
                larger(v),
                "a place of its own: no vertex twice, none too far",
            )?;
            length = length.max(distance);
        }
    }
    check_convex(vertices, length)?;
    Ok(length)
}

/// L of a point, which has no size: 1 m, or the nearest power of two from r/4 to 8 r, where r² = d² + k_theta / k_h and d is
/// the lever of the holding point. The stability of the balance, about r² / L², is then a number that every type carries,
/// and so is 1 over it.
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

/// Every vertex lies to the left of every side, but for the two that the side joins, and so far off it that no more than two can
/// touch one surface: a body that is thinner is a rod.
fn check_convex<F: Real>(vertices: &[[F; 2]], length: F) -> Checked<F> {
    let at = |[x, y]: [F; 2]| Vec2::new(x / length, y / length);
    let least = F::from_int(3) / F::from_int(100_000);
    let ends = vertices.iter().skip(1).chain(vertices.first());
    for (&from, &to) in vertices.iter().zip(ends) {
        let side = at(to) - at(from);
        let too_little = side.length() * least;
        for (k, &v) in vertices.iter().enumerate() {
            let joined = v == from || v == to;
            require(
                joined || side.cross(at(v) - at(from)) > too_little,
                Parameter::Vertex(k),
                larger(v),
                "a corner of a strictly convex polygon, counter-clockwise, inside every side but its own two by more than 3e-5 body sizes",
            )?;
        }
    }
    Ok(())
}

/// Checks and normalises the surfaces.
pub(super) fn surfaces<R: Real, const S: usize>(
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
        let normal = Vec2::new(R::from_si(x, R::Si::ONE), R::from_si(y, R::Si::ONE));
        let offset = units.length_from_si(d.offset);
        // The slice is not longer than S, so there is room.
        let _ = checked.push(Surface {
            normal,
            tangent: Vec2::new(normal.y, -normal.x),
            offset,
            origin: normal * offset,
            friction: Coulomb::from_coefficients(mu_s, mu_d),
        });
    }
    Ok(checked)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// r² = d² + k_theta / k_h of a point at (1, 2), held at a lever.
    fn size(ratio: f64, lever: Option<[f64; 2]>) -> f64 {
        size_of_point(&Description {
            vertices: &[[1.0, 2.0]],
            start: [0.0; 3],
            weight: 0.0,
            holding_point: lever.map(|[x, y]| [1.0 + x, 2.0 + y]),
            reach: 0.0,
            stiffness_translation: 3.0,
            stiffness_rotation: 3.0 * ratio,
            surfaces: &[],
        })
    }

    #[test]
    fn point_is_as_large_as_its_springs_ask_for() {
        // r/4 and 8 r themselves are large and small enough.
        for (r, should) in [
            (4.0, 1.0),
            (0.125, 1.0),
            (4.01, 2.0),
            (0.124, 0.5),
            (8.0, 2.0),
        ] {
            assert_eq!(size(r * r, None), should, "{r}");
        }
        assert_eq!(size(0.0, None), 1.0, "without springs or lever");
        assert_eq!(size(f64::INFINITY, None), 1.0, "no number of lengths");
        for exponent in -20..=20 {
            let r = libm::exp2(0.7 * f64::from(exponent) + 0.05);
            let found = size(r * r, None);
            assert!((r / 4.0..=8.0 * r).contains(&found), "{r} {found}");
            assert_eq!(libm::frexp(found).0, 0.5, "a power of two");
            let nearer_to_1 = if found > 1.0 {
                found / 2.0
            } else {
                found * 2.0
            };
            assert!(found == 1.0 || !(r / 4.0..=8.0 * r).contains(&nearer_to_1));
            // The lever counts as much: r is the hypotenuse of all three.
            let lever = [2.0 * r / 7.0, -3.0 * r / 7.0];
            assert_eq!(size(36.0 / 49.0 * r * r, Some(lever)), found, "{r}");
        }
    }

    /// The first parameter to be refused, and what is allowed.
    fn refused(change: impl Fn(&mut Description<'_, f32>)) -> Option<(Parameter, &'static str)> {
        let mut description = Description {
            vertices: &[],
            start: [0.0; 3],
            weight: 0.0,
            holding_point: None,
            reach: 0.0,
            stiffness_translation: 1.0,
            stiffness_rotation: 0.0,
            surfaces: &[],
        };
        change(&mut description);
        let error = check_numbers(&description).err()?;
        Some((error.parameter, error.allowed))
    }

    /// Whether a polygon is convex does not depend on how large it is; a corner on a straight side is none.
    #[test]
    fn convexity_is_that_of_the_shape() {
        for exponent in (-30..=30).step_by(6) {
            let scale = libm::exp10(f64::from(exponent)) as f32;
            let scaled = |corner: [f32; 2]| {
                let vertices = [[0.0, 0.0], [1.0, 0.0], corner, [0.0, 1.0]];
                check_vertices::<f32, 4>(&vertices.map(|v| v.map(|x| x * scale)))
            };
            assert!(scaled([1.0, 1.0]).is_ok(), "{scale}");
            assert!(scaled([0.75, 0.5]).is_ok(), "{scale}");
            for dent in [[0.5, 0.5], [0.25, 0.5], [2.0, -1.0]] {
                let error = scaled(dent).map_err(|error| error.parameter);
                assert!(matches!(error, Err(Parameter::Vertex(_))), "{scale}");
            }
        }
    }

    #[test]
    fn zero_is_allowed_where_the_text_says_so() {
        assert_eq!(refused(|_| ()), None);
        let k_h = refused(|d| d.stiffness_translation = 0.0);
        assert_eq!(k_h, Some((Parameter::StiffnessTranslation, "more than 0")));
        let k_theta = refused(|d| d.stiffness_rotation = -1e-30);
        assert_eq!(k_theta, Some((Parameter::StiffnessRotation, "0 or more")));
    }
}
