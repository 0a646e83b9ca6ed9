//! Incoming samples (FRAME 4.1, 4.2, 4.8): from the plane of the mode and the frames that arrived to the one sample for a step, and the
//! counts of those that were overtaken or lost.

use stiction_core::{Axis, Hand, Projection, TrackerSample};
use stiction_wire::{Mode, Sequence};

use crate::device::NO_HAND;

/// A sample of the planar hand and the sequence number of its frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrived {
    pub(super) hand: Hand<f32>,
    pub(super) sequence: u8,
}

#[derive(Clone, Debug)]
pub(super) struct Intake {
    plane: [Axis; 2],
    projection: Option<Projection<f32>>,
    waiting: Option<Arrived>,
    sequence: Sequence,
    /// A client that sends samples to a board that measures them itself has been notified.
    pub(super) refused: bool,
    pub(super) samples: u32,
    /// Samples that no step used.
    pub(super) late: u32,
    /// Frames that did not arrive.
    pub(super) lost: u32,
}

impl Intake {
    pub(super) fn new(mode: &Mode) -> Self {
        Self {
            plane: mode.plane,
            projection: Projection::new(mode.plane),
            waiting: None,
            sequence: Sequence::new(),
            refused: false,
            samples: 0,
            late: 0,
            lost: 0,
        }
    }

    /// A client connects: the gap before its first frame does not count.
    pub(super) fn greet(&mut self) {
        self.sequence = Sequence::new();
        self.refused = false;
    }

    pub(super) fn follow(&mut self, sequence: u8) {
        let lost = self.sequence.lost_before(sequence);
        self.lost = self.lost.saturating_add(u32::from(lost));
    }

    /// A sample of the hand arrived; one that still waits is overtaken.
    pub(super) fn hand(&mut self, hand: Hand<f32>, sequence: u8) {
        self.samples = self.samples.saturating_add(1);
        self.drop_waiting();
        self.waiting = Some(Arrived { hand, sequence });
    }

    pub(super) fn measured(&mut self) {
        self.samples = self.samples.saturating_add(1);
    }

    /// A sample of a tracker arrived. Its turns are counted with every one, including overtaken ones.
    pub(super) fn tracker(&mut self, sample: &TrackerSample<f32>, sequence: u8) {
        let planar = self.projection.as_mut().and_then(|p| p.planar(sample));
        self.hand(planar.unwrap_or(NO_HAND), sequence);
    }

    pub(super) fn take(&mut self) -> Option<Arrived> {
        self.waiting.take()
    }

    /// The body starts again: earlier samples are obsolete, and the count of the tracker's turns restarts at zero.
    pub(super) fn begin_anew(&mut self) {
        self.drop_waiting();
        self.projection = Projection::new(self.plane);
    }

    /// The plane of a mode. The count of the turns continues if the plane is the same as before.
    pub(super) fn look_at(&mut self, plane: [Axis; 2]) {
        if plane != self.plane {
            self.plane = plane;
            self.projection = Projection::new(plane);
        }
    }

    fn drop_waiting(&mut self) {
        if self.waiting.take().is_some() {
            self.late = self.late.saturating_add(1);
        }
    }
}
