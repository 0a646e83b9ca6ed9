//! The fields of a payload, one after the other, little-endian (FRAME 1): numbers, flags, codes, and structs made of them.

use crate::fault::FaultKind;
use crate::layout::{codes, layout};
use stiction_core::{Angle, Axis, Contact, Event, Evolution, Hand, SurfaceDescription};
use stiction_core::{Touch, TrackerSample, Wrench};

/// The unread rest of a payload. Its length is checked first; beyond the end every field would be 0.
#[derive(Clone, Copy, Debug)]
pub struct Fields<'a> {
    rest: &'a [u8],
}

impl<'a> Fields<'a> {
    pub(crate) const fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }
    /// Checks that exactly this many bytes are left.
    pub(crate) fn exactly(&self, bytes: usize) -> Result<(), FaultKind> {
        require(self.rest.len() == bytes, FaultKind::Length)
    }
    /// Checks that at least this many bytes are left.
    pub(crate) fn at_least(&self, bytes: usize) -> Result<(), FaultKind> {
        require(self.rest.len() >= bytes, FaultKind::Length)
    }
    pub(crate) fn take<const N: usize>(&mut self) -> [u8; N] {
        match self.rest.split_first_chunk() {
            Some((field, rest)) => {
                self.rest = rest;
                *field
            }
            None => [0; N],
        }
    }
    /// The next `count` bytes, or as many as there are.
    pub(crate) fn bytes(&mut self, count: usize) -> &'a [u8] {
        let (bytes, rest) = (self.rest.split_at_checked(count)).unwrap_or((self.rest, &[]));
        self.rest = rest;
        bytes
    }
    /// All remaining bytes.
    pub(crate) fn remaining(&mut self) -> &'a [u8] {
        self.bytes(self.rest.len())
    }
    /// The next field; fails if its bytes have no meaning.
    pub(crate) fn get<T: Field>(&mut self) -> Result<T, FaultKind> {
        T::get(self)
    }
    /// The only field of a payload; fails if its length is not the field's, or if its bytes have no meaning.
    pub(crate) fn only<T: Field>(&mut self) -> Result<T, FaultKind> {
        self.exactly(T::BYTES)?;
        self.get()
    }
}

/// A destination for fields.
pub trait Sink {
    /// Appends bytes unchanged.
    fn put(&mut self, bytes: &[u8]);
    /// Marks the message as one that cannot be sent.
    fn refuse(&mut self);
}

/// A value of a fixed number of bytes.
pub trait Field: Copy {
    /// The number of bytes.
    const BYTES: usize;
    /// Appends the bytes.
    fn put(&self, sink: &mut impl Sink);
    /// Reads the bytes, of which there are enough.
    ///
    /// # Errors
    /// [`FaultKind::Value`] if a flag or code among them has no meaning.
    fn get(fields: &mut Fields<'_>) -> Result<Self, FaultKind>;
}

/// Fails with a fault unless `holds`.
pub(crate) const fn require(holds: bool, fault: FaultKind) -> Result<(), FaultKind> {
    if holds { Ok(()) } else { Err(fault) }
}

/// The code of an entry of a table, its index; 255 if it has none.
pub(crate) fn code_of<T: PartialEq>(table: &[T], entry: &T) -> u8 {
    let index = table.iter().position(|one| one == entry);
    index.and_then(|i| u8::try_from(i).ok()).unwrap_or(u8::MAX)
}

/// The entry of a table with this code.
pub(crate) fn entry_of<T: Copy>(table: &[T], code: u8) -> Result<T, FaultKind> {
    let entry = table.get(usize::from(code)).copied();
    entry.ok_or(FaultKind::Value)
}

/// Numbers: their bits, unchanged.
macro_rules! numbers {
    ($($number:ty)+) => {$(
        impl Field for $number {
            const BYTES: usize = size_of::<Self>();
            fn put(&self, sink: &mut impl Sink) {
                sink.put(&self.to_le_bytes());
            }
            fn get(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
                Ok(Self::from_le_bytes(fields.take()))
            }
        }
    )+};
}
numbers!(u8 i8 u16 u32 i32 f32);

codes!(Event Evolution);

/// A number of at most 255, one byte.
impl Field for usize {
    const BYTES: usize = 1;
    fn put(&self, sink: &mut impl Sink) {
        match u8::try_from(*self) {
            Ok(count) => sink.put(&[count]),
            Err(_) => sink.refuse(),
        }
    }
    fn get(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        let [count] = fields.take();
        Ok(Self::from(count))
    }
}

/// 0 or 1.
impl Field for bool {
    const BYTES: usize = 1;
    fn put(&self, sink: &mut impl Sink) {
        sink.put(&[u8::from(*self)]);
    }
    fn get(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        let [flag] = fields.take();
        entry_of(&[false, true], flag)
    }
}

/// A flag and a number, which is 0 if there is none, and then has no meaning.
impl Field for Option<f32> {
    const BYTES: usize = 5;
    fn put(&self, sink: &mut impl Sink) {
        self.is_some().put(sink);
        self.unwrap_or_default().put(sink);
    }
    fn get(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        let (given, value): (bool, f32) = (fields.get()?, fields.get()?);
        Ok(given.then_some(value))
    }
}

impl<T: Field + Default, const N: usize> Field for [T; N] {
    const BYTES: usize = T::BYTES * N;
    fn put(&self, sink: &mut impl Sink) {
        for value in self {
            value.put(sink);
        }
    }
    fn get(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        let mut values = [T::default(); N];
        for value in &mut values {
            *value = fields.get()?;
        }
        Ok(values)
    }
}

/// 0, 1, 2: +x, +y, +z; with bit 2, which is the sign: -x, -y, -z.
impl Field for Axis {
    const BYTES: usize = 1;
    fn put(&self, sink: &mut impl Sink) {
        let sign = if self.negative { NEGATIVE } else { 0 };
        match u8::try_from(self.index) {
            Ok(index @ 0..=2) => sink.put(&[index | sign]),
            _ => sink.refuse(),
        }
    }
    fn get(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        let [code] = fields.take();
        let index = usize::from(code & !NEGATIVE);
        require(index < 3, FaultKind::Value)?;
        let negative = code & NEGATIVE != 0;
        Ok(Self { index, negative })
    }
}

const NEGATIVE: u8 = 4;

layout! { Angle<f32> { rest: f32, turns: i32 } }
layout! { Hand<f32> { position: [f32; 2], angle: Angle<f32>, depth: f32, held: bool; tilted = false } }
layout! { TrackerSample<f32> { position: [f32; 3], orientation: [f32; 4], held: bool } }
layout! { Wrench<f32> { force: [f32; 2], moment: f32 } }
layout! {
    Contact<f32> {
        touch: Touch, direction: [f32; 2], point: [f32; 2], normal: f32, friction: f32, sliding: i8
    } if |contact| (-1..=1).contains(&contact.sliding)
}
layout! {
    SurfaceDescription<f32> {
        normal: [f32; 2], offset: f32, friction_static: f32, friction_dynamic: f32,
        memory: Option<f32>
    }
}
