//! The force that may be output to the hand: from the wrench of the solver to the one that a device may output, tick by tick.
//!
//! ```text
//! limits.rs    the limits and the damping of the device; checked once, the error names the parameter and the bound
//! governor.rs  size of force and moment, and their growth after a safe state
//! debt.rs      what a weight gives back that was lifted with a force of limited size
//! arrivals.rs  which sample is new, which are late and lost
//! silence.rs   when samples have stayed away for too long
//! ticks.rs     ticks that did not come
//! ```
//!
//! Zero force is the safe state. It is output **immediately**, regardless of the rate limit, on silence, on an input that cannot be used
//! and on an overrun: a force that no longer follows the hand is a motor that runs freely, and does work on the hand for as long as that
//! moves; removing a force does none. The step down is never more than the limit of size. The way back grows by the limit of rate, and so has
//! no jump; once it is there, the force follows its demand without such a limit.

mod arrivals;
mod debt;
mod governor;
mod limits;
mod silence;
mod ticks;

pub use arrivals::{Arrival, Arrivals};
pub(crate) use debt::{Debt, Held};
pub use governor::{Given, Governor, Wanted};
pub use limits::{Allowed, LimitError, LimitParameter, Limits, Passivity};
pub use silence::Silence;
pub use ticks::Ticks;
pub(crate) use ticks::{lateness, latest};

/// Why the force has its present value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Flags {
    /// No usable sample for as long as the limits permit, or none yet: zero force; the body is held where the last one led it.
    pub silent: bool,
    /// The solver could not use the last sample (saturated, held-last): zero force, the pose is held.
    pub held_last: bool,
    /// Ticks are missing before this one, more than permitted: zero force.
    pub overrun: bool,
    /// The solver's wrench was not finite: zero force.
    pub not_finite: bool,
    /// The device could not output the force of the previous tick: zero force.
    pub actuator_fault: bool,
    /// The wanted force or moment is larger than the device's limit, or was, so that the hand has not paid for a weight yet.
    pub size_limited: bool,
    /// The force or the moment has not reached the wanted value yet: it grows after a safe state.
    pub rate_limited: bool,
}

impl Flags {
    /// Returns whether one of the flags is set that make the force zero.
    pub fn is_safe_state(&self) -> bool {
        self.silent || self.held_last || self.overrun || self.not_finite || self.actuator_fault
    }
}

/// The counts since power-on. Counters saturate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Health {
    /// Ticks done.
    pub ticks: u32,
    /// Ticks that were not in time.
    pub missed_ticks: u32,
    /// Samples that reached the solver.
    pub samples: u32,
    /// Samples not newer than one before them (late, or sent twice): not used.
    pub late_samples: u32,
    /// Samples that are missing in the sender's count.
    pub lost_samples: u32,
    /// Restarts of the sender's count.
    pub restarts: u32,
    /// Samples that the solver could not use: not finite, or out of range.
    pub unusable_samples: u32,
    /// Times that samples stayed away for too long.
    pub silences: u32,
    /// Ticks whose force the device could not output.
    pub actuator_faults: u32,
    /// The longest step, in the unit of the clock that the board measures with.
    pub worst_step: u32,
}
