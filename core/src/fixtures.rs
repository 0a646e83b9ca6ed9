//! What the tests of single functions share: random numbers, loads about as large as what is carried, a pivot without a load.

use crate::coupling::Stance;
use crate::detect::Placed;
use crate::geometry::{Angle, Orientation, Vec2};

/// Random numbers from a seed, the same in every run.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// In [-1, 1).
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    /// Of two such numbers.
    pub(crate) fn vector(&mut self) -> Vec2<f64> {
        Vec2::new(self.next(), self.next())
    }
}

/// Of many cases every one, or, in the slow interpreter, one in `of`.
pub(crate) fn sampled<I: Iterator>(all: I, of: usize) -> impl Iterator<Item = I::Item> {
    all.step_by(if cfg!(miri) { of } else { 1 })
}

/// A pull and a couple, in parts of what a number type carries of both together: below it and above, each of either sign.
pub(crate) fn loads() -> impl Iterator<Item = (f64, f64)> {
    let sizes = [
        (0.4, 0.5),
        (0.9, 0.0),
        (0.0, 0.99),
        (0.7, 0.7),
        (1.1, 0.0),
        (0.0, 1.1),
    ];
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let all = move |(load, couple)| signs.map(|(x, y)| (load * x, couple * y));
    sizes.into_iter().flat_map(all)
}

/// A body about a point at the origin, with the springs of a hand that does not pull.
pub(crate) fn unloaded() -> Stance<f64> {
    Stance {
        placed: Placed {
            point: Vec2::ZERO,
            body_point: Vec2::ZERO,
            orientation: Orientation::new(Angle::default()),
            on: None,
        },
        lever: Vec2::ZERO,
        centroid: Vec2::ZERO,
        spring: Vec2::ZERO,
        couple: 0.0,
        hold: Vec2::ZERO,
        force: Vec2::ZERO,
        stiffness: 1.0,
        tolerance: 0.0,
    }
}
