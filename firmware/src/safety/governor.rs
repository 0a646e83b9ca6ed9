//! From the wrench that the statics demands to one that the device may output: force and moment limited in size, by one factor; after a safe
//! state the size also grows by no more than a step per tick, until it has reached what is wanted.
//!
//! At any other time the wrench follows the demand at once. The demand is the force of springs, which is passive (see
//! [`Passivity`](super::Passivity)), and slips and losses of contact only release what the springs hold: no limit of rate is needed for that,
//! and one would make the force lag behind the hand, which does work on it.
//!
//! A limit of size must not spoil this: force and moment that are cut off separately are not those of springs any more, and give the hand
//! energy on a closed path. Here a factor reduces both, which depends only on the energy E of the springs: with E_c at the limit, it is
//! h = 1 up to E_c, and sqrt(E_c / E) beyond. H, its integral over E, grows less and less, so that with h times the force the proof of
//! passivity is that of the springs, of H instead of E. For a weight see `debt.rs`.
//!
//! Growth raises E_c. At constant E_c the springs are passive, as above; where E_c grows, H grows, from 0 to at most E. So once after a safe
//! state the hand may be given what the springs hold meanwhile, and nothing more, however it moves; the cut before took the same from a hand
//! that was in contact. What falls, falls at once.

use super::limits::Limits;
use stiction_core::{Real, Wrench};

/// A limit is observed with this margin, for the rounding of what is computed with it.
const MARGIN: f32 = 1.0 + 8.0 * f32::EPSILON;

/// What the statics demands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wanted {
    /// The wrench on the hand (N, N·m).
    pub(crate) wrench: Wrench<f32>,
    /// Its size: 1 if the springs hold as much as the one of them does that is at its limit first.
    pub(crate) size: f32,
}

impl Wanted {
    /// A limit of size reduces it.
    pub(crate) fn is_limited(&self) -> bool {
        self.size > 1.0
    }

    /// A part of it, 0 to 1, which counts as reduced by a limit of size.
    pub(crate) fn reduced(self, part: f32) -> Self {
        let ([x, y], moment) = (self.wrench.force, self.wrench.moment);
        Self {
            wrench: Wrench {
                force: [x * part, y * part],
                moment: moment * part,
            },
            size: Real::max(self.size, MARGIN),
        }
    }
}

impl Limits {
    /// A wrench (N, N·m) of springs of stiffness k_h (N/m) and k_theta (N·m/rad), and its size by these limits. A limit of 0 means that the
    /// device does not output the force or the moment: it is 0 then.
    pub fn sized(&self, wrench: &Wrench<f32>, [k_h, k_theta]: [f32; 2]) -> Wanted {
        let mut wrench = *wrench;
        if self.force == 0.0 {
            wrench.force = [0.0; 2];
        }
        if self.moment == 0.0 {
            wrench.moment = 0.0;
        }
        let ([x, y], m) = (wrench.force, wrench.moment);
        let mut held = 0.0;
        for (square, limit, stiffness) in [
            (x * x + y * y, self.force, k_h),
            (m * m, self.moment, k_theta),
        ] {
            if limit > 0.0 && stiffness > 0.0 {
                held += square / stiffness;
            }
        }
        let size = Real::sqrt(held / self.most([k_h, k_theta])) * MARGIN;
        Wanted { wrench, size }
    }

    /// Twice what springs hold at the limit of size (J); infinite without one.
    fn most(&self, stiffness: [f32; 2]) -> f32 {
        let limits = [self.force, self.moment].into_iter().zip(stiffness);
        limits
            .filter(|&(limit, stiffness)| limit > 0.0 && stiffness > 0.0)
            .map(|(limit, stiffness)| limit * limit / stiffness)
            .fold(f32::INFINITY, Real::min)
    }

    /// What springs of this size give until they are at rest (J): H, see the module.
    pub(crate) fn springs(&self, size: f32, stiffness: [f32; 2]) -> f32 {
        let part = if size > 1.0 {
            size + size - 1.0
        } else {
            size * size
        };
        self.most(stiffness) / 2.0 * part
    }

    /// By how much the size may grow in a tick: neither force nor moment grows faster than its limit.
    fn step(&self) -> f32 {
        let part = |rate: f32, limit: f32| match limit > 0.0 {
            true => rate * self.period() / limit,
            false => 1.0,
        };
        Real::min(
            part(self.force_rate, self.force),
            part(self.moment_rate, self.moment),
        )
    }
}

/// The wrench of a tick, and what limited it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Given {
    /// The wrench on the hand.
    pub wrench: Wrench<f32>,
    /// The wanted wrench is larger than permitted.
    pub size_limited: bool,
    /// The wanted wrench, within its size, is not reached yet: it grows after a safe state.
    pub rate_limited: bool,
    /// The wanted wrench is not finite: zero is output.
    pub not_finite: bool,
}

/// Keeps the force on the hand within its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Governor {
    /// By how much the size may grow in a tick.
    step: f32,
    /// The size up to which it has grown; infinite once what is wanted was reached.
    grown: f32,
}

impl Governor {
    /// For limits that were checked. Begins at zero force.
    pub fn new(limits: &Limits) -> Self {
        Self {
            step: limits.step(),
            grown: 0.0,
        }
    }

    /// New limits, which were checked as well. What grows goes on growing.
    pub fn set_limits(&mut self, limits: &Limits) {
        self.step = limits.step();
    }

    /// The wrench on the hand in this tick if `wanted` would be right.
    pub fn toward(&mut self, wanted: &Wanted) -> Given {
        let Wanted { wrench, size } = *wanted;
        let ([x, y], moment) = (wrench.force, wrench.moment);
        if ![x, y, moment, size].into_iter().all(Real::is_finite) {
            return Given {
                not_finite: true,
                ..self.cut()
            };
        }
        let grown = self.grown + self.step;
        let most = Real::min(grown, 1.0);
        let is_reached = grown >= Real::min(size, 1.0);
        self.grown = if is_reached { f32::INFINITY } else { grown };
        let wrench = if size <= most {
            wrench
        } else {
            let part = most / size;
            Wrench {
                force: [x * part, y * part],
                moment: moment * part,
            }
        };
        Given {
            wrench,
            size_limited: wanted.is_limited(),
            rate_limited: !is_reached,
            not_finite: false,
        }
    }

    /// Zero, immediately; then it grows.
    pub fn cut(&mut self) -> Given {
        self.grown = 0.0;
        Given::default()
    }

    /// From now on it grows, from this size.
    pub(crate) fn grow(&mut self, from: f32) {
        self.grown = from;
    }
}
