//! Every case of `cases/obstacles.json` in every number type and evolution: pose and forces within 1e-6 in f64 (1e-9 if they follow
//! from closed formulas), 2e-3 in f32 and fixed point.

use std::time::Duration;
use stiction_core::Evolution;
use stiction_tests::obstacles::cases::all;
use stiction_tests::obstacles::guard::{Outcome, within};
use stiction_tests::obstacles::judged::is_right;
use stiction_tests::{Number, test_each};

/// More time than any case takes.
const LIMIT: Duration = Duration::from_secs(20);
/// The number of cases in the file.
const CASES: usize = 16;

test_each!(each::case_is_right);

mod each {
    use super::*;

    pub(super) fn case_is_right<R: Number>(evolution: Evolution) {
        let cases = all();
        assert_eq!(cases.len(), CASES);
        let mut wrong = Vec::new();
        for case in cases {
            let name = case.name.clone();
            let outcome = within(LIMIT, move || is_right::<R>(&case, evolution));
            if outcome != Outcome::Done(Ok(())) {
                wrong.push(format!("{name}: {outcome:?}"));
            }
        }
        assert!(wrong.is_empty(), "{} {evolution:?}: {wrong:#?}", R::NAME);
    }
}
