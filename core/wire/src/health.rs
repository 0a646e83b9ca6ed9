//! The condition of a board, on the wire (FRAME 5.6).

use crate::fault::{FaultKind, Faults};
use crate::fields::{Fields, Sink};

/// Whether a board outputs force to the hand, and if not, why.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Drive {
    /// Force is output, or would be if the board had actuators.
    #[default]
    On,
    /// No fresh sample of the hand: no force until samples return.
    Silent,
    /// A fault: no force until [`Reset::Everything`](crate::Reset::Everything).
    Latched,
}

impl Drive {
    /// All, in the order of their codes.
    pub const ALL: [Self; 3] = [Self::On, Self::Silent, Self::Latched];

    /// The name in a log.
    pub const fn name(self) -> &'static str {
        match self {
            Self::On => "on",
            Self::Silent => "silent",
            Self::Latched => "latched",
        }
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

impl Health {
    pub(crate) const BYTES: usize = 1 + 4 * (8 + FaultKind::ALL.len());

    /// Writes the payload of health (FRAME 5.6).
    pub(crate) fn write(&self, sink: &mut impl Sink) {
        sink.code(&Drive::ALL, &self.drive);
        let counts = [
            self.ticks,
            self.missed_ticks,
            self.samples,
            self.late_samples,
            self.lost_frames,
            self.unsent,
            self.worst_step,
            self.worst_tick,
        ];
        for count in counts.into_iter().chain(self.faults.counts()) {
            sink.u32(count);
        }
    }

    /// Reads the payload of health (FRAME 5.6); fails if its length is wrong or the code of the drive has no meaning.
    pub(crate) fn read(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        fields.exactly(Self::BYTES)?;
        Ok(Self {
            drive: fields.code(&Drive::ALL)?,
            ticks: fields.u32(),
            missed_ticks: fields.u32(),
            samples: fields.u32(),
            late_samples: fields.u32(),
            lost_frames: fields.u32(),
            unsent: fields.u32(),
            worst_step: fields.u32(),
            worst_tick: fields.u32(),
            faults: Faults::from_counts(core::array::from_fn(|_| fields.u32())),
        })
    }
}
