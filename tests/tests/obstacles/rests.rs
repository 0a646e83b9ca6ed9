//! Positions in which no state could move the body on: every frame ends at rest.

use std::sync::atomic::AtomicU64;
use stiction_core::{Evolution, Fixed};
use stiction_tests::Number;
use stiction_tests::obstacles::survey::{Kind, look};

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

fn every_frame_is_at_rest<R: Number>() {
    let mut odd = Vec::new();
    for &(number, what) in SCENES {
        for evolution in Evolution::ALL {
            let report = look::<R>((Kind::Worlds, number), evolution, &AtomicU64::new(0));
            if !report.statuses.is_empty() || !report.unlawful.is_empty() {
                let (name, statuses) = (evolution.name(), report.statuses);
                odd.push(format!("{number} {name}: {what}: {statuses:?}"));
            }
        }
    }
    assert!(odd.is_empty(), "{}: {odd:#?}", R::NAME);
}

#[test]
fn every_frame_ends_at_rest_in_f64() {
    every_frame_is_at_rest::<f64>();
}

#[test]
fn every_frame_ends_at_rest_in_f32() {
    every_frame_is_at_rest::<f32>();
}

#[test]
fn every_frame_ends_at_rest_in_fixed_point() {
    every_frame_is_at_rest::<Fixed>();
}
