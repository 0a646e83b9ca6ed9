//! The numbers of a knob in the flash of its board: each time in the other one of two sectors, so that a loss of power leaves the former
//! numbers or the new ones.
//!
//! The first page of a sector is the frame of the command ([`Command::Knob`]) as it is on the wire, with its version and its checksum, and
//! then the bytes of an erased flash. First the new sector is written, then the former one is erased.

use crate::station::Setup;
use stiction_wire::{Command, Decoder, Frame, KnobInfo, KnobNumbers, KnobSource, frame_bytes};

/// Bytes of a page, the unit in which a flash is programmed.
pub const PAGE: usize = 256;
/// A byte of an erased flash.
const ERASED: u8 = 0xFF;
/// Bytes of the payload of the command (FRAME 4.9).
const PAYLOAD: usize = 34;

/// The page with these numbers.
pub fn page(numbers: &KnobNumbers) -> [u8; PAGE] {
    let mut page = [ERASED; PAGE];
    let frame = Frame {
        sequence: 0,
        time: 0,
        message: Command::Knob(*numbers),
    };
    // There is room: the frame of this command is not longer than 47 bytes.
    let _ = frame.encode(&mut page);
    page
}

/// What both sectors contain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored {
    /// The numbers; `None` if there are none, or those that were there are damaged.
    numbers: Option<KnobNumbers>,
    is_damaged: bool,
    /// The sector for other numbers, 0 or 1.
    pub free: usize,
}

impl Stored {
    /// Reads the first page of each sector.
    pub fn read([first, second]: [&[u8; PAGE]; 2]) -> Self {
        let is_erased = |page: &[u8; PAGE]| page.iter().all(|&byte| byte == ERASED);
        let (in_first, in_second) = (numbers(first), numbers(second));
        let found = in_first.or(in_second);
        Self {
            numbers: found,
            is_damaged: found.is_none() && !(is_erased(first) && is_erased(second)),
            free: usize::from(in_first.is_some()),
        }
    }

    /// The numbers of a board that is compiled with other ones and begins with a setup.
    pub fn info(&self, compiled_in: &KnobNumbers, setup: &Setup) -> KnobInfo {
        let is_usable = |numbers: &KnobNumbers| setup.admits(numbers).is_ok();
        let (source, numbers) = match self.numbers {
            Some(numbers) if is_usable(&numbers) => (KnobSource::Stored, numbers),
            Some(_) => (KnobSource::Unusable, *compiled_in),
            None if self.is_damaged => (KnobSource::Unusable, *compiled_in),
            None => (KnobSource::CompiledIn, *compiled_in),
        };
        KnobInfo { source, numbers }
    }
}

/// The numbers in a page; `None` if it does not begin with an undamaged frame of them.
fn numbers(page: &[u8; PAGE]) -> Option<KnobNumbers> {
    let mut decoder = Decoder::<{ frame_bytes(PAYLOAD) }>::new();
    for &byte in page {
        if let Some(received) = decoder.push::<Command<'_>>(byte) {
            return match received.ok()?.message {
                Command::Knob(numbers) => Some(numbers),
                _ => None,
            };
        }
    }
    None
}
