//! The condition of a board, on the wire (FRAME 5.6).

use crate::fault::Faults;
use crate::layout::{coded, layout};

coded! {
    /// Whether a board outputs force to the hand, and if not, why.
    #[derive(Default)]
    pub enum Drive {
        /// Force is output, or would be if the board had actuators.
        #[default]
        On = "on",
        /// No fresh sample of the hand: no force until samples return.
        Silent = "silent",
        /// A fault: no force until [`Reset::Everything`](crate::Reset::Everything).
        Latched = "latched",
    }
}

/// The condition of a board. Counts begin at power-up or [`Reset::Everything`](crate::Reset::Everything) and saturate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Health {
    /// Force to the hand.
    pub drive: Drive,
    /// Ticks of the clock.
    pub ticks: u32,
    /// Ticks at which the previous tick was not finished.
    pub missed_ticks: u32,
    /// Samples of the hand that arrived.
    pub samples: u32,
    /// Of these, samples that a newer one overtook before a step used them.
    pub late_samples: u32,
    /// Frames that did not arrive: gaps in the sequence numbers.
    pub lost_frames: u32,
    /// Reports that were not sent, because the line was busy.
    pub unsent: u32,
    /// The longest step of the solver (ns).
    pub worst_step: u32,
    /// The longest tick: samples, step, safety, reports (ns).
    pub worst_tick: u32,
    /// Frames that were not accepted.
    pub faults: Faults,
}

layout! {
    Health {
        drive: Drive, ticks: u32, missed_ticks: u32, samples: u32, late_samples: u32,
        lost_frames: u32, unsent: u32, worst_step: u32, worst_tick: u32, faults: Faults
    }
}
