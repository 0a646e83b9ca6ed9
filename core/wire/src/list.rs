//! Lists within a payload: on one side the sender's items, on the other the bytes as received, without copying.

use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink, require};
use core::fmt;
use stiction_core::{Parameter, SceneError};

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

impl<'a, T: Field> List<'a, T> {
    /// The next `count` items of a payload, which is long enough; fails if a flag or code in one of them has no meaning.
    pub(crate) fn take(fields: &mut Fields<'a>, count: usize) -> Result<Self, FaultKind> {
        let bytes = fields.bytes(count.saturating_mul(T::BYTES));
        let mut items = bytes.chunks(T::BYTES);
        items.try_for_each(|item| T::get(&mut Fields::new(item)).map(|_| ()))?;
        Ok(Self {
            items: Items::Received { bytes, count },
        })
    }
    /// The rest of a payload: the number of items, and the items; fails if the length does not match.
    pub(crate) fn rest(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        let count: usize = fields.get()?;
        fields.exactly(count.saturating_mul(T::BYTES))?;
        Self::take(fields, count)
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
                T::get(&mut Fields::new(one)).ok()
            }
        }
    }
    /// The items in order.
    pub fn iter(&self) -> impl Iterator<Item = T> + use<'a, T> {
        let list = *self;
        (0..list.len()).filter_map(move |i| list.get(i))
    }
    /// The items, copied to the given places.
    ///
    /// # Errors
    /// There are more than fit.
    pub(crate) fn copied<'b>(
        &self,
        parameter: Parameter,
        places: &'b mut [T],
    ) -> Result<&'b [T], SceneError<f32>> {
        copied(self.iter(), self.len(), parameter, places).map(|items| &*items)
    }
    pub(crate) fn write(&self, sink: &mut impl Sink) {
        for item in self.iter() {
            item.put(sink);
        }
    }
}

/// The items of a list, copied to the given places.
///
/// # Errors
/// There are more than fit.
pub(crate) fn copied<T>(
    items: impl Iterator<Item = T>,
    count: usize,
    parameter: Parameter,
    places: &mut [T],
) -> Result<&mut [T], SceneError<f32>> {
    let Some(places) = places.get_mut(..count) else {
        return Err(SceneError {
            parameter,
            value: u16::try_from(count).map_or(f32::INFINITY, f32::from),
            allowed: "at most the capacity of the board",
        });
    };
    for (place, item) in places.iter_mut().zip(items) {
        *place = item;
    }
    Ok(places)
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

impl<T: Field + PartialEq> PartialEq for List<'_, T> {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl<T: Field + fmt::Debug> fmt::Debug for List<'_, T> {
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
    /// The rest of a payload; fails if there are characters other than printable ASCII.
    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        let bytes = fields.remaining();
        let printable = bytes.iter().all(|byte| PRINTABLE.contains(byte));
        require(printable, FaultKind::Value)?;
        Ok(Self { bytes })
    }
    fn characters(&self) -> impl Iterator<Item = u8> + use<'a> {
        let sent = self.bytes.iter().take(Self::LONGEST);
        sent.map(|byte| match PRINTABLE.contains(byte) {
            true => *byte,
            false => b'?',
        })
    }
    pub(crate) fn write(&self, sink: &mut impl Sink) {
        for byte in self.characters() {
            byte.put(sink);
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
