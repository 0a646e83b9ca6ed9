//! Comparison with a bound, and the size of a test.

/// Asserts |got - want| <= bound; says what, both values and the distance.
#[track_caller]
pub fn close(what: &str, got: f64, want: f64, bound: f64) {
    let distance = (got - want).abs();
    assert!(
        distance <= bound,
        "{what}: {got} instead of {want}, off by {distance:.2e}, allowed {bound:.0e}"
    );
}

/// The number of repetitions: `release` in an optimised build, `debug` otherwise.
pub const fn budget(release: usize, debug: usize) -> usize {
    if cfg!(debug_assertions) {
        debug
    } else {
        release
    }
}
