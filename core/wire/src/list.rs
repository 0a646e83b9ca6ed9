//! Lists within a payload: on one side the sender's items, on the other the bytes as received, without copying.

use crate::fault::FaultKind;
use crate::fields::{Fields, Sink, require};
use core::fmt;

/// An item of a list: a fixed number of bytes.
pub trait Item: Copy {
    /// The length in bytes.
    const BYTES: usize;
    /// Writes the item as bytes.
    fn put(&self, sink: &mut impl Sink);
    /// Reads an item from valid bytes.
    fn get(fields: &mut Fields<'_>) -> Self;
    /// Returns whether the flags and codes in these bytes have a meaning. If there are none, any bytes are valid.
    fn valid(_bytes: &[u8]) -> bool {
        true
    }
}

/// A list in a message. One that was received points into the receiver's buffer.
///
/// ```
/// use stiction_wire::List;
///
/// let vertices = List::from(&[[0.0, 0.0], [1.0, 0.0]]);
/// assert_eq!(vertices.len(), 2);
/// assert_eq!(vertices.iter().last(), Some([1.0, 0.0]));
/// ```
#[derive(Clone, Copy)]
pub struct List<'a, T> {
    items: Items<'a, T>,
}

#[derive(Clone, Copy)]
enum Items<'a, T> {
    Given(&'a [T]),
    Received { bytes: &'a [u8], count: usize },
}

impl<'a, T: Item> List<'a, T> {
    /// The next `count` items of a payload; fails if it is too short.
    pub(crate) fn take(fields: &mut Fields<'a>, count: usize) -> Result<Self, FaultKind> {
        let bytes = fields.bytes(count.saturating_mul(T::BYTES));
        require(bytes.chunks(T::BYTES).all(T::valid), FaultKind::Value)?;
        Ok(Self {
            items: Items::Received { bytes, count },
        })
    }
    /// The number of items.
    pub const fn len(&self) -> usize {
        match self.items {
            Items::Given(items) => items.len(),
            Items::Received { count, .. } => count,
        }
    }
    /// Returns whether there are no items.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The item at an index.
    pub fn get(&self, index: usize) -> Option<T> {
        match self.items {
            Items::Given(items) => items.get(index).copied(),
            Items::Received { bytes, .. } => {
                let rest = bytes.get(index.saturating_mul(T::BYTES)..)?;
                let one = rest.get(..T::BYTES)?;
                Some(T::get(&mut Fields::new(one)))
            }
        }
    }
    /// The items in order.
    pub fn iter(&self) -> impl Iterator<Item = T> + use<'a, T> {
        let list = *self;
        (0..list.len()).filter_map(move |i| list.get(i))
    }
    pub(crate) fn write(&self, sink: &mut impl Sink) {
        for item in self.iter() {
            item.put(sink);
        }
    }
}

impl<'a, T> From<&'a [T]> for List<'a, T> {
    fn from(items: &'a [T]) -> Self {
        Self {
            items: Items::Given(items),
        }
    }
}

impl<'a, T, const N: usize> From<&'a [T; N]> for List<'a, T> {
    fn from(items: &'a [T; N]) -> Self {
        Self::from(items.as_slice())
    }
}

impl<T: Item + PartialEq> PartialEq for List<'_, T> {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl<T: Item + fmt::Debug> fmt::Debug for List<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

/// The characters of a text.
const PRINTABLE: core::ops::RangeInclusive<u8> = b' '..=b'~';

/// Printable ASCII text at the end of a message.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub struct Text<'a> {
    bytes: &'a [u8],
}

impl<'a> Text<'a> {
    /// A text is cut to this many characters when it is sent.
    pub const LONGEST: usize = 200;

    /// A text; characters that are not printable ASCII are sent as `?`.
    pub const fn new(text: &'a str) -> Self {
        Self {
            bytes: text.as_bytes(),
        }
    }
    /// `None` if there are characters other than printable ASCII.
    pub(crate) fn read(bytes: &'a [u8]) -> Option<Self> {
        let valid = bytes.iter().all(|byte| PRINTABLE.contains(byte));
        valid.then_some(Self { bytes })
    }
    fn characters(&self) -> impl Iterator<Item = u8> + use<'a> {
        let printable = |byte: &u8| {
            if PRINTABLE.contains(byte) {
                *byte
            } else {
                b'?'
            }
        };
        self.bytes.iter().take(Self::LONGEST).map(printable)
    }
    pub(crate) fn write(&self, sink: &mut impl Sink) {
        for byte in self.characters() {
            sink.byte(byte);
        }
    }
}

impl PartialEq<&str> for Text<'_> {
    fn eq(&self, other: &&str) -> bool {
        self.bytes == other.as_bytes()
    }
}

impl fmt::Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use fmt::Write;
        self.characters()
            .try_for_each(|c| f.write_char(char::from(c)))
    }
}

impl fmt::Debug for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\"{self}\"")
    }
}
