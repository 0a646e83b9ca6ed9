//! Every case of `cases/obstacles.json` in a number type and an evolution: pose and forces within 1e-6 in f64 (1e-9 if they follow
//! from closed formulas), 2e-3 in f32 and fixed point.

use std::time::Duration;
use stiction_core::{Evolution, Fixed};
use stiction_tests::Number;
use stiction_tests::obstacles::cases::all;
use stiction_tests::obstacles::guard::{Outcome, within};
use stiction_tests::obstacles::judged::verdict;

/// More time than any case takes.
const LIMIT: Duration = Duration::from_secs(20);
/// The number of cases in the file.
const CASES: usize = 16;

fn every_case_is_right<R: Number>(evolution: Evolution) {
    let cases = all();
    assert_eq!(cases.len(), CASES);
    let mut off = 0;
    for case in cases {
        let name = case.name.clone();
        let is_right = match within(LIMIT, move || verdict::<R>(&case, evolution)) {
            Outcome::Done(verdict) => {
                println!("{name}: {verdict}");
                verdict.first_off.is_none() && verdict.statuses.is_empty()
            }
            other => {
                println!("{name}: {other:?}");
                false
            }
        };
        off += usize::from(!is_right);
    }
    assert_eq!(off, 0, "wrong cases in {}", R::NAME);
}

#[test]
fn cases_are_right_in_f64_along_the_path() {
    every_case_is_right::<f64>(Evolution::Path);
}

#[test]
fn cases_are_right_in_f64_frame_by_frame() {
    every_case_is_right::<f64>(Evolution::Frame);
}

#[test]
fn cases_are_right_in_f32_along_the_path() {
    every_case_is_right::<f32>(Evolution::Path);
}

#[test]
fn cases_are_right_in_f32_frame_by_frame() {
    every_case_is_right::<f32>(Evolution::Frame);
}

#[test]
fn cases_are_right_in_fixed_point_along_the_path() {
    every_case_is_right::<Fixed>(Evolution::Path);
}

#[test]
fn cases_are_right_in_fixed_point_frame_by_frame() {
    every_case_is_right::<Fixed>(Evolution::Frame);
}
