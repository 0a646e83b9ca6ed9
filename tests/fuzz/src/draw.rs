//! Numbers decoded from bytes: coarse ones, so that positions, angles and coefficients often coincide, and fine ones
//! next to them.

use arbitrary::Unstructured;
use std::f64::consts::PI;

/// The remaining bytes; zeros after their end.
pub(crate) struct Draw<'a>(Unstructured<'a>);

impl<'a> Draw<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self(Unstructured::new(bytes))
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn byte(&mut self) -> u8 {
        self.0.arbitrary().unwrap_or_default()
    }

    pub(crate) fn flag(&mut self) -> bool {
        self.byte() & 1 != 0
    }

    /// One of the given values.
    pub(crate) fn one_of<T: Copy, const N: usize>(&mut self, all: [T; N]) -> T {
        all[usize::from(self.byte()) % N]
    }

    /// -1 to 1: in steps of 1/64 if the byte is even, plus a fine part of up to one step if it is odd.
    pub(crate) fn place(&mut self) -> f64 {
        let byte = self.byte() as i8;
        let fine = if byte & 1 != 0 { self.fine() } else { 0.0 };
        f64::from(byte >> 1) / 64.0 + fine / 64.0
    }

    /// 0 to 1.
    pub(crate) fn part(&mut self) -> f64 {
        self.place().abs()
    }

    /// -pi to pi: a multiple of pi/24 or any other angle.
    pub(crate) fn angle(&mut self) -> f64 {
        let byte = self.byte();
        let steps = i32::from(byte >> 1) % 49 - 24;
        let fine = if byte & 1 != 0 { self.fine() } else { 0.0 };
        (f64::from(steps) + fine) * PI / 24.0
    }

    /// A power of ten.
    pub(crate) fn power(&mut self, from: f64, to: f64) -> f64 {
        10f64.powf(from + (to - from) * self.part())
    }

    /// -1 to 1, half of the time close to 0.
    fn fine(&mut self) -> f64 {
        let bits: i16 = self.0.arbitrary().unwrap_or_default();
        let value = f64::from(bits) / 32768.0;
        if bits & 1 != 0 {
            value * value * value * value
        } else {
            value
        }
    }
}
