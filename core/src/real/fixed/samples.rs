//! Numbers for the tests of the kernels: the edges of the range and of the halves that are multiplied, and random
//! numbers of every magnitude.

use super::product::RAIL;

/// The edges, and their neighbours.
pub(super) fn edges() -> impl Iterator<Item = i32> + Clone {
    (0..31)
        .map(|bit| 1i32 << bit)
        .chain([0, 3 << 23, 105_414_357, 0x5555_5555, RAIL - 1])
        .flat_map(|x| [x.saturating_sub(1), x, x + 1])
        .flat_map(|x| [x, -x])
}

/// Every pair of edges.
pub(super) fn pairs() -> impl Iterator<Item = (i32, i32)> {
    sampled(edges().flat_map(|a| edges().map(move |b| (a, b))))
}

/// All numbers, or, in the slow interpreter, a few.
pub(in crate::real) fn sampled<I: Iterator>(all: I) -> impl Iterator<Item = I::Item> {
    all.step_by(if cfg!(miri) { 499 } else { 1 })
}

/// Random numbers, equally many of each binary order of magnitude.
pub(super) fn random(count: usize) -> impl Iterator<Item = i32> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    core::iter::repeat_with(move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        ((state >> 33) as i32 >> (state & 31)) * if state & 32 == 0 { 1 } else { -1 }
    })
    .take(if cfg!(miri) { count / 4999 } else { count })
}

/// Pairs of random numbers that follow each other.
pub(super) fn random_pairs(count: usize) -> impl Iterator<Item = (i32, i32)> {
    random(count).zip(random(count + 1).skip(1))
}

/// Every pair of edges, and pairs of random numbers.
pub(super) fn all_pairs(random: usize) -> impl Iterator<Item = (i32, i32)> {
    pairs().chain(random_pairs(random))
}

/// An exact quotient of integers as a Q24 number: rounded to the nearest, halves away from zero, within the rails.
pub(super) fn nearest(numerator: i128, denominator: i128) -> i32 {
    let (n, d) = (numerator.unsigned_abs(), denominator.unsigned_abs());
    let size = ((2 * n + d) / (2 * d)).min(RAIL as u128) as i32;
    if (numerator < 0) == (denominator < 0) {
        size
    } else {
        -size
    }
}
