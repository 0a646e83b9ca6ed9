//! The largest reactions that are exact in fixed point (R43).

use stiction_tests::{Number, Setup};

/// Whether reactions may be inexact. They are computed as components along the edges of the friction cones, which in fixed point are at
/// most 128 k_h L: from half of that on, they need not be exact. The contacts are given as N (N), T (N) and mu_s.
pub(crate) fn clamps<R: Number>(
    setup: &Setup,
    mut reactions: impl Iterator<Item = (f64, f64, f64)>,
) -> bool {
    let is_large = |force: f64| {
        let lengths = force / (128.0 * setup.stiffness_translation);
        // For a point, L is a power of two.
        match setup.vertices.len() {
            1 => (lengths.log2() - lengths.log2().round()).abs() < 1e-6,
            _ => lengths / setup.size() > 0.5,
        }
    };
    R::NAME == "fixed"
        && reactions.any(|(normal, friction, slope)| {
            let part = 0.5 * slope.hypot(1.0) * (normal + friction.abs() / slope);
            is_large(normal) || is_large(part)
        })
}
