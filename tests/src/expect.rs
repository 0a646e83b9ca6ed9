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

/// How often a test repeats: `daily` as a rule, `long` if the environment variable `STICTION_TESTS` is `long`, as in
/// `tests/check.sh --all`.
///
/// # Panics
/// If the variable has another value than `daily` or `long`.
pub fn times<N>(daily: N, long: N) -> N {
    match std::env::var("STICTION_TESTS").as_deref() {
        Err(_) | Ok("" | "daily") => daily,
        Ok("long") => long,
        Ok(other) => panic!("STICTION_TESTS is {other:?}, allowed: daily, long"),
    }
}

/// The point between `low` and `high` at which a condition changes, to the last digit: the last one at which it is as at `low`.
///
/// # Panics
/// If it is the same at both.
pub fn change(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let first = holds(low);
    assert_ne!(first, holds(high), "no change between {low} and {high}");
    loop {
        let middle = f64::midpoint(low, high);
        if middle == low || middle == high {
            return low;
        }
        if holds(middle) == first {
            low = middle;
        } else {
            high = middle;
        }
    }
}
