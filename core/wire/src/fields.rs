//! The fields of a payload, one after the other, little-endian (FRAME 3).

use crate::fault::FaultKind;

/// Reads the fields of a payload. The length is checked first; beyond the end every field would be 0.
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
        let (bytes, rest) = self
            .rest
            .split_at_checked(count)
            .unwrap_or((self.rest, &[]));
        self.rest = rest;
        bytes
    }
    /// All remaining bytes.
    pub(crate) fn remaining(&mut self) -> &'a [u8] {
        self.bytes(self.rest.len())
    }
    pub(crate) fn u8(&mut self) -> u8 {
        let [value] = self.take();
        value
    }
    pub(crate) fn u16(&mut self) -> u16 {
        u16::from_le_bytes(self.take())
    }
    pub(crate) fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }
    pub(crate) fn i32(&mut self) -> i32 {
        i32::from_le_bytes(self.take())
    }
    /// The bits of an f32, unchanged.
    pub(crate) fn f32(&mut self) -> f32 {
        f32::from_le_bytes(self.take())
    }
    pub(crate) fn f32s<const N: usize>(&mut self) -> [f32; N] {
        core::array::from_fn(|_| self.f32())
    }
    /// 0 or 1.
    pub(crate) fn flag(&mut self) -> Result<bool, FaultKind> {
        match self.u8() {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(FaultKind::Value),
        }
    }
    /// A flag and a number, which is meaningless if the flag is 0.
    pub(crate) fn option(&mut self) -> Result<Option<f32>, FaultKind> {
        let given = self.flag()?;
        let value = self.f32();
        Ok(given.then_some(value))
    }
    /// The entry of a table at the index that follows.
    pub(crate) fn code<T: Copy>(&mut self, table: &[T]) -> Result<T, FaultKind> {
        at(table, self.u8())
    }
}

/// A destination for fields.
pub trait Sink {
    /// Appends bytes unchanged.
    fn put(&mut self, bytes: &[u8]);
    /// Marks the message as one that cannot be sent.
    fn refuse(&mut self);

    /// One byte.
    fn byte(&mut self, byte: u8) {
        self.put(&[byte]);
    }
    /// One byte from parts that have no bit in common.
    fn parts(&mut self, parts: &[u8]) {
        self.byte(parts.iter().fold(0, |byte, part| byte | part));
    }
    /// Two bytes, little-endian.
    fn u16(&mut self, value: u16) {
        self.put(&value.to_le_bytes());
    }
    /// Four bytes, little-endian.
    fn u32(&mut self, value: u32) {
        self.put(&value.to_le_bytes());
    }
    /// Four bytes, little-endian.
    fn i32(&mut self, value: i32) {
        self.put(&value.to_le_bytes());
    }
    /// The bits of a float, unchanged.
    fn f32(&mut self, value: f32) {
        self.put(&value.to_le_bytes());
    }
    /// Floats, one after the other.
    fn f32s(&mut self, values: &[f32]) {
        for &value in values {
            self.f32(value);
        }
    }
    /// A flag and a number, which is 0 if there is none.
    fn option(&mut self, value: Option<f32>) {
        self.byte(u8::from(value.is_some()));
        self.f32(value.unwrap_or_default());
    }
    /// The index of an entry of a table.
    fn code<T: PartialEq>(&mut self, table: &[T], entry: &T) {
        self.byte(index_of(table, entry));
    }
    /// A number of at most 255.
    fn count(&mut self, count: usize) {
        match u8::try_from(count) {
            Ok(count) => self.byte(count),
            Err(_) => self.refuse(),
        }
    }
}

/// Fails with a fault unless `holds`.
pub(crate) const fn require(holds: bool, fault: FaultKind) -> Result<(), FaultKind> {
    if holds { Ok(()) } else { Err(fault) }
}

/// The entry of a table at a code.
pub(crate) fn at<T: Copy>(table: &[T], code: u8) -> Result<T, FaultKind> {
    table
        .get(usize::from(code))
        .copied()
        .ok_or(FaultKind::Value)
}

/// The code of an entry of a table.
pub(crate) fn index_of<T: PartialEq>(table: &[T], entry: &T) -> u8 {
    let index = table.iter().position(|one| one == entry);
    index.and_then(|i| u8::try_from(i).ok()).unwrap_or(u8::MAX)
}
