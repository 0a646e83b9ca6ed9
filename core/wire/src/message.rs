//! What both directions have in common: a message has a type and a payload.

use crate::fault::FaultKind;
use crate::field::{Fields, Sink};

/// A message of one direction: [`Command`](crate::Command), to the board, or [`Report`](crate::Report), from it.
pub trait Message<'a>: Wire<'a> {}

impl<'a, T: Wire<'a>> Message<'a> for T {}

/// Conversion to and from the bytes of a payload.
pub trait Wire<'a>: Sized {
    /// The type byte.
    fn code(&self) -> u8;
    /// The payload.
    fn write(&self, sink: &mut impl Sink);
    /// Reads a message from its type and payload.
    fn read(code: u8, fields: Fields<'a>) -> Result<Self, FaultKind>;
}
