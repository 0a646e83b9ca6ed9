//! Positions in which no state could move the body on: every frame ends at rest.

use stiction_core::Evolution;
use stiction_tests::obstacles::survey::{Kind, look};
use stiction_tests::{Number, test_each};

/// Random scenes, with what happens in each.
const SCENES: &[(u64, &str)] = &[
    (
        6,
        "the moment about one of two sliding contacts no longer presses the other",
    ),
    (
        193,
        "a side leans over the corner at the end of a wall in line with it",
    ),
    (
        210,
        "a vertex goes round the tip of two walls, and a corner of one covers that of the other",
    ),
    (
        449,
        "a rod turns from level over the upper end of the side on which it stands",
    ),
    (
        492,
        "without friction a box slides down between a wall and a corner",
    ),
    (
        926,
        "the search for a touch gives up because a sliding body turns first",
    ),
    (
        1584,
        "a slip from the end of one side leads to the end of the next, and back",
    ),
];

test_each!(cases::every_frame_ends_at_rest);

mod cases {
    use super::*;

    pub(super) fn every_frame_ends_at_rest<R: Number>(evolution: Evolution) {
        for &(number, what) in SCENES {
            let report = look::<R>((Kind::Worlds, number), evolution);
            let (unlawful, statuses) = (report.unlawful, report.statuses);
            let is_at_rest = statuses.is_empty() && unlawful.is_empty();
            assert!(
                is_at_rest,
                "{} {number}: {what}: {statuses:?} {unlawful:?}",
                R::NAME
            );
        }
    }
}
