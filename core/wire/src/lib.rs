#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::indexing_slicing,
        clippy::arithmetic_side_effects
    )
)]
//! The messages between a board and its client on a serial line, to bytes and back. The format is in `FRAME.md` among the sources of
//! this crate; the code cites its sections. Both directions accept any bytes: invalid messages are counted and skipped. The crate uses
//! no heap and no `unsafe`, and does not panic.
//!
//! ```text
//! Command --Frame::encode--> bytes --line--> Decoder::push::<Command> --> the board
//! Report  <--Decoder::push::<Report>  <--line-- bytes <--Frame::encode--  the board
//! ```
//!
//! Data that can be read in place is not copied: a message is encoded straight into the sender's buffer, and the lists of a received one
//! point into the buffer of the receiver.
//!
//! ```
//! use stiction_wire::{Decoder, Drive, Frame, Health, Report};
//!
//! let health = Health { ticks: 1000, drive: Drive::Silent, ..Health::default() };
//! let mut wire = [0; 128];
//! let wire = Frame { sequence: 3, time: 0, message: Report::Health(health) }.encode(&mut wire).unwrap();
//!
//! let mut client = Decoder::<512>::new();
//! for &byte in wire {
//!     if let Some(received) = client.push::<Report>(byte) {
//!         assert_eq!(received.unwrap().message, Report::Health(health));
//!     }
//! }
//! assert_eq!(client.faults().total(), 0);
//! ```

mod command;
mod fault;
mod field;
mod forces;
mod health;
mod info;
mod knob;
mod layout;
mod line;
mod list;
mod logitech;
mod message;
mod mode;
mod obstacles;
mod pose;
mod reply;
mod report;
mod scene;
mod touch;

pub use command::{Command, Parameters, Reset};
pub use fault::{Fault, FaultKind, Faults};
pub use forces::{Events, Forces};
pub use health::{Drive, Health};
pub use info::{Info, NumberType};
pub use knob::{KnobInfo, KnobNumber, KnobNumbers, KnobSource};
pub use line::{CRC_BYTES, Decoder, HEAD_BYTES, frame_bytes, wire_bytes};
pub use list::{List, Text};
pub use logitech::{LogitechDecoder, LogitechRecord, REQUEST as LOGITECH_REQUEST};
pub use message::Message;
pub use mode::{Mode, Stepping};
pub use obstacles::{ObstacleList, ObstacleRow};
pub use pose::{EventSet, Pose};
pub use reply::{Reason, Reply, Subject};
pub use report::{LONGEST_REPORT, Pong, Report};
pub use scene::{SceneCommand, scene_bytes};

/// The version of the format, which is the first byte of every frame.
pub const VERSION: u8 = 4;

/// A message with what every frame has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<M> {
    /// Increases by one with every frame that is sent in its direction, of whatever type; 0 follows 255.
    pub sequence: u8,
    /// The sender's clock (µs); wraps after 71.6 minutes. For poses, forces and events: the tick of their step.
    pub time: u32,
    /// The message.
    pub message: M,
}

/// Which frame: its type and sequence number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Reference {
    /// The type byte.
    pub code: u8,
    /// The sequence number.
    pub sequence: u8,
}

layout::layout! { Reference { code: u8, sequence: u8 } }

/// Follows the sequence numbers of received frames and counts how many were lost between them.
///
/// ```
/// let mut line = stiction_wire::Sequence::new();
/// assert_eq!(line.lost_before(254), 0, "the first one");
/// assert_eq!(line.lost_before(255), 0);
/// assert_eq!(line.lost_before(2), 2, "0 and 1 did not come");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sequence {
    last: Option<u8>,
}

impl Sequence {
    /// Nothing received yet.
    pub const fn new() -> Self {
        Self { last: None }
    }
    /// How many frames are missing before this one; after 256 lost in a row it is 0, and only `time` shows the gap.
    pub const fn lost_before(&mut self, sequence: u8) -> u8 {
        let lost = match self.last {
            Some(last) => sequence.wrapping_sub(last).wrapping_sub(1),
            None => 0,
        };
        self.last = Some(sequence);
        lost
    }
}
