//! The faults of frames that are not accepted, and their counts (FRAME 6).

use crate::Reference;

/// Why the bytes between two delimiters are not a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FaultKind {
    /// More bytes than the receiver has room for.
    TooLong,
    /// A COBS code byte points beyond the end of the frame.
    Cobs,
    /// The checksum is wrong, or the frame is too short to have one.
    Crc,
    /// The checksum is right, but the frame is of another version of this format.
    Version,
    /// A type that this side does not know or does not receive.
    UnknownType,
    /// Not the number of bytes that its type has.
    Length,
    /// A field holds a code without a meaning.
    Value,
}

impl FaultKind {
    /// All kinds, in the order in which a frame is tested for them.
    pub const ALL: [Self; 7] = [
        Self::TooLong,
        Self::Cobs,
        Self::Crc,
        Self::Version,
        Self::UnknownType,
        Self::Length,
        Self::Value,
    ];

    /// The name in a report.
    pub const fn name(self) -> &'static str {
        match self {
            Self::TooLong => "too-long",
            Self::Cobs => "cobs",
            Self::Crc => "crc",
            Self::Version => "version",
            Self::UnknownType => "unknown-type",
            Self::Length => "length",
            Self::Value => "value",
        }
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
    counts: [u32; FaultKind::ALL.len()],
}

impl Faults {
    /// None yet.
    pub const fn new() -> Self {
        Self {
            counts: [0; FaultKind::ALL.len()],
        }
    }
    /// Counts a fault.
    pub fn count(&mut self, kind: FaultKind) {
        for (_, count) in self.pairs().filter(|(k, _)| *k == kind) {
            *count = count.saturating_add(1);
        }
    }
    /// How many of a kind there were.
    pub fn of(&self, kind: FaultKind) -> u32 {
        let mut pairs = FaultKind::ALL.iter().zip(self.counts);
        pairs.find(|(k, _)| **k == kind).map_or(0, |(_, n)| n)
    }
    /// All of them.
    pub fn total(&self) -> u32 {
        let counts = self.counts.iter();
        counts.fold(0, |sum: u32, &n| sum.saturating_add(n))
    }
    /// The counts in the order of [`FaultKind::ALL`].
    pub(crate) const fn counts(&self) -> [u32; FaultKind::ALL.len()] {
        self.counts
    }
    pub(crate) const fn from_counts(counts: [u32; FaultKind::ALL.len()]) -> Self {
        Self { counts }
    }
    fn pairs(&mut self) -> impl Iterator<Item = (FaultKind, &mut u32)> {
        FaultKind::ALL.into_iter().zip(&mut self.counts)
    }
}
