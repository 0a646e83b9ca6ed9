//! What force may go to the hand: from the wrench of the solver to the one that a device may give, tick by tick.
//!
//! ```text
//! limits.rs    what the device carries and damps; checked once, the error names the parameter and the bound
//! governor.rs  size and rate of change of force and moment
//! arrivals.rs  which sample is new, which are late and lost
//! silence.rs   when samples have stayed away for too long
//! ticks.rs     ticks that did not come
//! ```
//!
//! Zero force is the safe state. It is given **at once**, past the rate limit, on silence, on an input that cannot be used
//! and on an overrun: a force that no longer follows the hand is a motor that runs freely, and does work on the hand for as
//! long as that moves; taking a force away does none. The step down is never more than the limit of size. The way back is
//! within the rate limit, and so without a jump.

mod arrivals;
mod governor;
mod limits;
mod silence;
mod ticks;

pub use arrivals::{Arrival, Arrivals};
pub use governor::{Given, Governor};
pub use limits::{Allowed, LimitError, LimitParameter, Limits, Passivity};
pub use silence::Silence;
pub use ticks::Ticks;
pub(crate) use ticks::{lateness, latest};

/// Why the force is what it is, and no other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Flags {
    /// No usable sample for as long as the limits say, or none yet: zero force; the body is held where the last one led it.
    pub silent: bool,
    /// The solver could not use the last sample (saturated, held-last): zero force, the pose is held.
    pub held_last: bool,
    /// Ticks are missing before this one, more than allowed: zero force.
    pub overrun: bool,
    /// The solver's wrench was not finite: zero force.
    pub not_finite: bool,
    /// The device could not give the force of the tick before: zero force.
    pub actuator_fault: bool,
    /// The force or the moment wanted is larger than the device gives.
    pub size_limited: bool,
    /// The force or the moment is on its way to the one wanted.
    pub rate_limited: bool,
}

impl Flags {
    /// One of those that make the force zero.
    pub fn is_safe_state(&self) -> bool {
        self.silent || self.held_last || self.overrun || self.not_finite || self.actuator_fault
    }
}

/// What has been counted since power-on. Counters stay at their largest value when they reach it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Health {
    /// Ticks done.
    pub ticks: u32,
    /// Ticks that did not come when they should.
    pub missed_ticks: u32,
    /// Samples that reached the solver.
    pub samples: u32,
    /// Samples not newer than one before them (late, or sent twice): not used.
    pub late_samples: u32,
    /// Samples that are missing in the sender's count.
    pub lost_samples: u32,
    /// Times that the sender began to count anew.
    pub restarts: u32,
    /// Samples that the solver could not use: not finite, or out of range.
    pub unusable_samples: u32,
    /// Times that samples stayed away for too long.
    pub silences: u32,
    /// Ticks whose force the device could not give.
    pub actuator_faults: u32,
    /// The longest step, in the unit of the clock that the board measures with.
    pub worst_step: u32,
}
