//! The unit of length of a point, and the shapes and numbers that are refused, at any scale.

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
        obstacles: &[],
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
        // The lever counts equally: r is the hypotenuse of all three.
        let lever = [2.0 * r / 7.0, -3.0 * r / 7.0];
        assert_eq!(size(36.0 / 49.0 * r * r, Some(lever)), found, "{r}");
    }
}

/// Whether a polygon is convex does not depend on its size; a corner on a straight side is not convex.
#[test]
fn convexity_is_that_of_the_shape() {
    for exponent in (-30..=30).step_by(6) {
        let scale = libm::exp10(f64::from(exponent)) as f32;
        let scaled = |corner: [f32; 2]| {
            let vertices = [[0.0, 0.0], [1.0, 0.0], corner, [0.0, 1.0]];
            check_vertices::<f32, 4>(&vertices.map(|v| v.map(|x| x * scale)), thinnest::<f32>())
        };
        assert!(scaled([1.0, 1.0]).is_ok(), "{scale}");
        assert!(scaled([0.75, 0.5]).is_ok(), "{scale}");
        for dent in [[0.5, 0.5], [0.25, 0.5], [2.0, -1.0]] {
            let error = scaled(dent).map_err(|error| error.parameter);
            assert!(matches!(error, Err(Parameter::Vertex(_))), "{scale}");
        }
    }
}
