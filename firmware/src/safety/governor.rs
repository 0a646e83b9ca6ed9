//! From the wrench that the statics demands to one that the device may output: force and moment limited in size, keeping the direction of
//! the force, and in their change from tick to tick.

use super::limits::Limits;
use stiction_core::{Real, Wrench};

/// A limit is observed with this margin, for the rounding of what is computed with it.
const MARGIN: f32 = 1.0 - 4.0 * f32::EPSILON;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Limit {
    /// The largest size (N, N·m).
    size: f32,
    /// The largest change in one tick.
    step: f32,
}

/// The wrench of a tick, and what limited it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Given {
    /// The wrench on the hand.
    pub wrench: Wrench<f32>,
    /// The wanted wrench is larger than permitted.
    pub size_limited: bool,
    /// The wanted wrench, within its size, is not reached yet.
    pub rate_limited: bool,
    /// The wanted wrench is not finite: zero is output.
    pub not_finite: bool,
}

/// Keeps the force on the hand within its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Governor {
    force: Limit,
    moment: Limit,
    given: Wrench<f32>,
}

impl Governor {
    /// For limits that were checked. Begins at zero force.
    pub fn new(limits: &Limits) -> Self {
        let step = |rate: f32| rate * limits.period();
        Self {
            force: Limit {
                size: limits.force,
                step: step(limits.force_rate),
            },
            moment: Limit {
                size: limits.moment,
                step: step(limits.moment_rate),
            },
            given: Wrench::default(),
        }
    }

    /// New limits, which were checked as well. The force continues from its present value.
    pub fn set_limits(&mut self, limits: &Limits) {
        *self = Self {
            given: self.given,
            ..Self::new(limits)
        };
    }

    /// The wrench on the hand in this tick if `wanted` would be right.
    pub fn toward(&mut self, wanted: &Wrench<f32>) -> Given {
        let [x, y] = wanted.force;
        if ![x, y, wanted.moment].into_iter().all(Real::is_finite) {
            return Given {
                not_finite: true,
                ..self.cut()
            };
        }
        let force = limited(wanted.force, self.force.size);
        let moment = clamped(wanted.moment, self.moment.size);
        let old = self.given;
        self.given = Wrench {
            force: approached(old.force, force, self.force.step),
            moment: old.moment + clamped(moment - old.moment, self.moment.step),
        };
        if Real::abs(moment - self.given.moment) <= f32::EPSILON * self.moment.size {
            // Reached, except for the rounding of the last step.
            self.given.moment = moment;
        }
        Given {
            wrench: self.given,
            size_limited: force != wanted.force || moment != wanted.moment,
            rate_limited: self.given.force != force || self.given.moment != moment,
            not_finite: false,
        }
    }

    /// Zero, immediately.
    pub fn cut(&mut self) -> Given {
        self.given = Wrench::default();
        Given::default()
    }
}

/// A number limited to a magnitude of at most `most`.
fn clamped(x: f32, most: f32) -> f32 {
    Real::max(Real::min(x, most), -most)
}

/// A vector shortened to a length, keeping its direction. No sum or product in it overflows.
fn limited([x, y]: [f32; 2], length: f32) -> [f32; 2] {
    let length = length * MARGIN;
    let (wide, high) = (Real::abs(x), Real::abs(y));
    // The usual case, without a root or a division.
    if wide + high <= length {
        return [x, y];
    }
    let largest = Real::max(wide, high);
    let (u, v) = (x / largest, y / largest);
    let size = Real::sqrt(u * u + v * v);
    // A length beyond the largest number compares as infinity, which is correct.
    if largest * size <= length {
        return [x, y];
    }
    let scale = length / size;
    [u * scale, v * scale]
}

/// From `from` towards `to`, at most one step.
fn approached(from: [f32; 2], to: [f32; 2], most: f32) -> [f32; 2] {
    let ([x, y], [to_x, to_y]) = (from, to);
    let way = [to_x - x, to_y - y];
    let step = limited(way, most);
    if step == way {
        return to;
    }
    // Between two forces that are not too large there is none that is.
    let [dx, dy] = step;
    [x + dx, y + dy]
}
