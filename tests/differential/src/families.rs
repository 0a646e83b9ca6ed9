//! The families of cases, each a function from a seed to a scene and a hand; the same on every machine.

mod degenerate;
mod known;
mod ordinary;
mod tops;

use crate::case::Case;

/// A family of cases.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// What it is called on the command line.
    pub name: &'static str,
    /// The seeds 0 to this one less are its usual sample.
    pub count: u64,
    /// The case of a seed; `None` beyond the last one.
    pub case: fn(u64) -> Option<Case>,
    /// In words.
    pub about: &'static str,
}

const fn family(
    name: &'static str,
    count: u64,
    case: fn(u64) -> Option<Case>,
    about: &'static str,
) -> Family {
    Family {
        name,
        count,
        case,
        about,
    }
}

/// All families.
pub const FAMILIES: [Family; 22] = [
    family(
        "haptic",
        320,
        ordinary::haptic,
        "ordinary haptic use among half-planes, mu_d < mu_s and mu_d = mu_s in turn, 2000 frames",
    ),
    family(
        "soft",
        100,
        ordinary::soft,
        "the same bodies and hands with k_theta / 100",
    ),
    family("free", 100, ordinary::free, "with k_theta = 0"),
    family("smooth", 100, ordinary::smooth, "with mu = 0"),
    family(
        "heavy",
        100,
        ordinary::heavy,
        "with weights of 0.02 to 0.5 k_h L",
    ),
    family(
        "drags",
        20,
        ordinary::drags,
        "six straight strokes of 1000 frames among 1 to 3 half-planes",
    ),
    family(
        "bundled",
        20,
        known::bundled,
        "the bundled scenes at their own rate",
    ),
    family(
        "cases",
        20,
        known::cases,
        "the cases with known answers among obstacles",
    ),
    family(
        "worlds",
        200,
        ordinary::worlds,
        "random obstacles, approached, pressed, dragged along; 400 frames",
    ),
    family(
        "worlds-soft",
        200,
        ordinary::worlds_soft,
        "with k_theta / 100",
    ),
    family(
        "worlds-free",
        200,
        ordinary::worlds_free,
        "with k_theta = 0",
    ),
    family("worlds-smooth", 200, ordinary::worlds_smooth, "with mu = 0"),
    family("rooms", 200, ordinary::rooms, "jumps in closed rooms"),
    family(
        "jumps",
        1000,
        degenerate::jumps,
        "half-planes, steps of the hand up to 5 L; 60 frames",
    ),
    family(
        "worlds-jumps",
        1000,
        degenerate::worlds_jumps,
        "obstacles, steps of the hand up to 5 L; 60 frames",
    ),
    family(
        "slow",
        1000,
        degenerate::slow,
        "haptic use among half-planes and obstacles in turn, 400 frames",
    ),
    family(
        "supports",
        1000,
        degenerate::supports,
        "a plank on two supports of unequal friction and further obstacles; 400 frames",
    ),
    family(
        "pegs",
        100,
        degenerate::pegs,
        "a peg pushed into a hole and pulled out, 4 s",
    ),
    family(
        "strokes",
        20,
        degenerate::strokes,
        "bundled scenes, then pegs: for several rates",
    ),
    family(
        "tops",
        500,
        tops::tops,
        "a level body slides across tiles, posts, pins and gaps, level or each up to 1 um lower",
    ),
    family(
        "tops-uneven",
        500,
        tops::uneven,
        "tops that differ by less than 2^-20 L, up and down",
    ),
    family(
        "faults",
        6,
        known::faults,
        "level tops that were found to catch a body",
    ),
];
