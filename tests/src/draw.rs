//! Random numbers for scenes, the same in every run, and convex polygons built from them.

use std::f64::consts::TAU;

/// Draws numbers (xorshift).
#[derive(Clone, Debug)]
pub struct Draw(u64);

impl Draw {
    /// Every index has its own sequence.
    pub fn new(index: u64) -> Self {
        // Never 0, a state that xorshift cannot leave: an odd multiple of a non-zero number.
        Self(index.saturating_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15))
    }
    /// A number from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    /// One of 0, 1 .. `count` - 1.
    pub fn below(&mut self, count: usize) -> usize {
        self.between(0.0, count as f64) as usize
    }
    /// A power of ten whose exponent is from `low` to `high`.
    pub fn power(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.between(low, high))
    }
    /// One of the given items.
    pub fn one<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }
}

/// Corners on an ellipse of this size, so that the polygon is strictly convex; counter-clockwise.
pub fn polygon(draw: &mut Draw, corners: usize, size: f64) -> Vec<[f64; 2]> {
    let ratio = draw.between(0.3, 1.0);
    let corner = |i| {
        let (sin, cos) = (TAU * (i as f64 + draw.between(-0.35, 0.35)) / corners as f64).sin_cos();
        [0.5 * size * cos, 0.5 * size * ratio * sin]
    };
    (0..corners).map(corner).collect()
}
