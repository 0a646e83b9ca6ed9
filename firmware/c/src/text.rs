//! Errors as text, terminated by 0, cut if there is no room.

use core::fmt::{self, Write};

/// A text of C that is written from its beginning; one byte of it is reserved for the terminator.
pub(crate) struct Text<'a> {
    bytes: &'a mut [u8],
    length: usize,
}

impl<'a> Text<'a> {
    pub(crate) fn new(bytes: &'a mut [u8]) -> Self {
        let mut text = Self { bytes, length: 0 };
        text.end();
        text
    }

    fn end(&mut self) {
        if let Some(end) = self.bytes.get_mut(self.length) {
            *end = 0;
        }
    }
}

impl Write for Text<'_> {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        let last = self.bytes.len().saturating_sub(1);
        for &byte in more.as_bytes() {
            match self.bytes.get_mut(self.length) {
                Some(place) if self.length < last => *place = byte,
                _ => break,
            }
            self.length += 1;
        }
        self.end();
        Ok(())
    }
}
