//! The fields of a record of fixed size, one after the other, little-endian.

/// Writes fields to a record of N bytes; fields beyond the end are dropped, the remainder is 0.
pub(super) struct Record<const N: usize> {
    bytes: [u8; N],
    filled: usize,
}

impl<const N: usize> Record<N> {
    pub(super) const fn new() -> Self {
        Self {
            bytes: [0; N],
            filled: 0,
        }
    }
    pub(super) fn bytes(&self) -> [u8; N] {
        self.bytes
    }
    pub(super) fn put<const M: usize>(&mut self, field: [u8; M]) -> &mut Self {
        let rest = self.bytes.get_mut(self.filled..).unwrap_or_default();
        if let Some((place, _)) = rest.split_first_chunk_mut() {
            *place = field;
            self.filled += M;
        }
        self
    }
    pub(super) fn u8(&mut self, value: u8) -> &mut Self {
        self.put([value])
    }
    pub(super) fn u32(&mut self, value: u32) -> &mut Self {
        self.put(value.to_le_bytes())
    }
    pub(super) fn i32(&mut self, value: i32) -> &mut Self {
        self.put(value.to_le_bytes())
    }
    pub(super) fn f64(&mut self, value: f64) -> &mut Self {
        self.put(value.to_le_bytes())
    }
}

/// Reads fields from bytes; beyond their end they are 0.
pub(super) struct Fields<'a> {
    rest: &'a [u8],
}

impl<'a> Fields<'a> {
    pub(super) const fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }
    pub(super) fn take<const M: usize>(&mut self) -> [u8; M] {
        match self.rest.split_first_chunk() {
            Some((field, rest)) => {
                self.rest = rest;
                *field
            }
            None => [0; M],
        }
    }
    pub(super) fn u8(&mut self) -> u8 {
        let [value] = self.take();
        value
    }
    pub(super) fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }
    pub(super) fn i32(&mut self) -> i32 {
        i32::from_le_bytes(self.take())
    }
    pub(super) fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }
}
