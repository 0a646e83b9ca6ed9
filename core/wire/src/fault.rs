//! The faults of frames that are not accepted, and their counts (FRAME 6).

use crate::Reference;
use crate::layout::{coded, layout};

coded! {
    /// Why the bytes between two delimiters are not a message. A frame is tested for the kinds in this order.
    pub enum FaultKind {
        /// More bytes than the receiver has room for.
        TooLong = "too-long",
        /// A COBS code byte points beyond the end of the frame.
        Cobs = "cobs",
        /// The checksum is wrong, or the frame is too short to have one.
        Crc = "crc",
        /// The checksum is right, but the frame is of another version of this format.
        Version = "version",
        /// A type that this side does not know or does not receive.
        UnknownType = "unknown-type",
        /// Not the number of bytes that its type has.
        Length = "length",
        /// A field holds a code without a meaning.
        Value = "value",
    }
}

/// A frame that was not accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Why.
    pub kind: FaultKind,
    /// Which frame it was, so that it can be refused. Known if the checksum was right: then the frame arrived as it was sent.
    pub frame: Option<Reference>,
}

/// Faults by kind; a count saturates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Faults {
    /// In the order of [`FaultKind::ALL`].
    counts: [u32; FaultKind::ALL.len()],
}

layout! { Faults { counts: [u32; FaultKind::ALL.len()] } }

impl Faults {
    /// None yet.
    pub const fn new() -> Self {
        Self {
            counts: [0; FaultKind::ALL.len()],
        }
    }
    /// Counts a fault.
    pub fn count(&mut self, kind: FaultKind) {
        if let Some(count) = self.counts.get_mut(kind as usize) {
            *count = count.saturating_add(1);
        }
    }
    /// How many of a kind there were.
    pub fn of(&self, kind: FaultKind) -> u32 {
        self.counts.get(kind as usize).copied().unwrap_or_default()
    }
    /// All of them.
    pub fn total(&self) -> u32 {
        (self.counts.iter()).fold(0, |sum: u32, &n| sum.saturating_add(n))
    }
}
