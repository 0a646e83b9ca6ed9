//! The harness finds no difference where there is none, and finds one where there is.

use stiction_differential::{FAMILIES, Family, OLD, Solver, compare};

fn family(name: &str) -> &'static Family {
    let mut families = FAMILIES.iter();
    families
        .find(|family| family.name == name)
        .expect("a family")
}

fn solver(name: &str) -> Solver {
    let mut solvers = OLD.into_iter();
    solvers
        .find(|solver| solver.name == name)
        .expect("a solver")
}

#[test]
fn a_solver_is_equal_to_itself() {
    let old = solver("old-f64");
    for family in &FAMILIES {
        let pair = compare(family, [old, old], 0..1);
        assert!(pair.differences.is_empty(), "{}: {pair}", family.name);
        assert!(pair.missing.is_empty(), "{}", family.name);
    }
}

#[test]
fn evolutions_differ_where_a_body_slips() {
    let pair = compare(
        family("haptic"),
        [solver("old-f64"), solver("old-f64-frame")],
        0..1,
    );
    assert_eq!(pair.differences.len(), 1, "{pair}");
}
