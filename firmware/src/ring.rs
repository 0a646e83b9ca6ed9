//! A bounded queue of bytes between two contexts, such as an interrupt and the rest of a program: one puts, the other takes.
//! No byte is lost or doubled as long as each side is a single one; nothing is unsafe, and nothing waits.

use core::sync::atomic::{AtomicU8, AtomicUsize, Ordering};

/// Room for N bytes; N is a power of two.
#[derive(Debug)]
pub struct Ring<const N: usize> {
    bytes: [AtomicU8; N],
    /// Bytes ever put, and ever taken, wrapping.
    put: AtomicUsize,
    taken: AtomicUsize,
}

impl<const N: usize> Ring<N> {
    const MASK: usize = {
        assert!(N.is_power_of_two());
        N.wrapping_sub(1)
    };

    /// Empty.
    pub const fn new() -> Self {
        Self {
            bytes: [const { AtomicU8::new(0) }; N],
            put: AtomicUsize::new(0),
            taken: AtomicUsize::new(0),
        }
    }

    /// How many bytes wait.
    pub fn len(&self) -> usize {
        let taken = self.taken.load(Ordering::Acquire);
        self.put.load(Ordering::Acquire).wrapping_sub(taken)
    }

    /// Nothing waits.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// For how many bytes there is room.
    pub fn room(&self) -> usize {
        N.saturating_sub(self.len())
    }

    /// Puts a byte at the end; false where there is no room for it. To be called by one context only.
    #[must_use]
    pub fn put(&self, byte: u8) -> bool {
        let put = self.put.load(Ordering::Relaxed);
        if put.wrapping_sub(self.taken.load(Ordering::Acquire)) >= N {
            return false;
        }
        if let Some(place) = self.bytes.get(put & Self::MASK) {
            place.store(byte, Ordering::Relaxed);
        }
        self.put.store(put.wrapping_add(1), Ordering::Release);
        true
    }

    /// Puts all of a frame or nothing: half a frame is of no use.
    #[must_use]
    pub fn put_all(&self, bytes: &[u8]) -> bool {
        bytes.len() <= self.room() && bytes.iter().all(|&byte| self.put(byte))
    }

    /// The first byte, which stays. To be called by the context that takes.
    pub fn peek(&self) -> Option<u8> {
        let taken = self.taken.load(Ordering::Relaxed);
        if self.put.load(Ordering::Acquire) == taken {
            return None;
        }
        Some(self.bytes.get(taken & Self::MASK)?.load(Ordering::Relaxed))
    }

    /// Takes the first byte. To be called by one context only.
    pub fn take(&self) -> Option<u8> {
        let byte = self.peek()?;
        let taken = self.taken.load(Ordering::Relaxed);
        self.taken.store(taken.wrapping_add(1), Ordering::Release);
        Some(byte)
    }
}

impl<const N: usize> Default for Ring<N> {
    fn default() -> Self {
        Self::new()
    }
}
