//! Outgoing frames: numbered, encoded, and counted if the line has no room for them (FRAME 7).

use stiction_wire::{Frame, LONGEST_REPORT, Report, wire_bytes};

/// The line of a board, and a clock to measure with.
pub trait Link {
    /// The next byte that arrived. Must not wait.
    fn take(&mut self) -> Option<u8>;
    /// Sends a whole frame, or, if there is no room for it, nothing: then it returns false. Must not wait. A queue of
    /// less than [`wire_bytes`] of [`LONGEST_REPORT`] never has room for the longest names and refusals.
    fn send(&mut self, frame: &[u8]) -> bool;
    /// A clock (ns, wrapping) with which the work of a tick is measured.
    fn now_ns(&mut self) -> u32;
}

const LONGEST: usize = wire_bytes(LONGEST_REPORT);

#[derive(Clone, Debug)]
pub(super) struct Outbox {
    sequence: u8,
    /// Frames for which the line had no room.
    pub(super) unsent: u32,
    bytes: [u8; LONGEST],
}

impl Outbox {
    pub(super) fn new() -> Self {
        Self {
            sequence: 0,
            unsent: 0,
            bytes: [0; LONGEST],
        }
    }

    /// Sends a report with a time (µs). A report that is not sent takes no number.
    pub(super) fn send(&mut self, time: u32, message: Report<'_>, link: &mut impl Link) -> bool {
        let frame = Frame {
            sequence: self.sequence,
            time,
            message,
        };
        let sent = frame
            .encode(&mut self.bytes)
            .is_some_and(|bytes| link.send(bytes));
        if sent {
            self.sequence = self.sequence.wrapping_add(1);
        } else {
            self.unsent = self.unsent.saturating_add(1);
        }
        sent
    }
}
