//! From the 16-bit counts of quadrature encoders to joint angles, unwrapped. The counts are whole numbers, so that errors do not
//! accumulate.

use super::geometry::{Encoder, Geometry};
use core::f32::consts::TAU;
use stiction_core::Angle;

/// One joint: whole turns and the counts within a turn since home.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Joint {
    encoder: Encoder,
    last: u16,
    turns: i32,
    /// 0 to `counts_per_turn` - 1
    counts: i32,
}

impl Joint {
    /// At its encoder's offset, with the present value of the counter.
    pub(crate) const fn new(encoder: Encoder, count: u16) -> Self {
        Self {
            encoder,
            last: count,
            turns: 0,
            counts: 0,
        }
    }

    /// Takes a new count; the counter has moved by less than half of its range since it was last read.
    pub(crate) fn update(&mut self, count: u16) {
        // As a signed 16-bit number: -32 768 to 32 767.
        let moved = count.wrapping_sub(self.last).cast_signed();
        self.last = count;
        let moved = i32::from(moved);
        let moved = if self.encoder.reversed {
            moved.saturating_neg()
        } else {
            moved
        };
        // At most 2^22 and more than 0 by the check of the geometry.
        let turn = self.encoder.counts_per_turn.cast_signed();
        let counts = self.counts.saturating_add(moved);
        let turns = counts.checked_div_euclid(turn).unwrap_or(0);
        self.turns = self.turns.saturating_add(turns);
        self.counts = counts.checked_rem_euclid(turn).unwrap_or(0);
    }

    pub(crate) fn angle(&self) -> Angle<f32> {
        let part = self.counts as f32 / self.encoder.counts_per_turn as f32;
        let rest = Angle {
            turns: self.turns,
            rest: 0.0,
        };
        rest.plus(part * TAU).plus(self.encoder.offset)
    }
}

/// The joints of a pantograph: left, right, handle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joints {
    joints: [Joint; 3],
}

impl Joints {
    /// In the home position, with the present values of the counters. For a geometry that was checked.
    pub fn new(geometry: &Geometry, counts: [u16; 3]) -> Self {
        let [left, right, handle] = geometry.encoders;
        let [a, b, c] = counts;
        Self {
            joints: [
                Joint::new(left, a),
                Joint::new(right, b),
                Joint::new(handle, c),
            ],
        }
    }

    /// Takes the present values of the counters. To be called before any of them has moved by 32 768 counts.
    pub fn update(&mut self, counts: [u16; 3]) {
        for (joint, count) in self.joints.iter_mut().zip(counts) {
            joint.update(count);
        }
    }

    /// The angles of the joints, unwrapped.
    pub fn angles(&self) -> [Angle<f32>; 3] {
        self.joints.map(|joint| joint.angle())
    }
}
