//! Random numbers for the tests of single functions, the same in every run.

use crate::geometry::Vec2;

/// From a seed.
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
