//! A bounded queue of bytes between two contexts, such as an interrupt and the rest of a program: one puts, the other takes. No byte is
//! lost or duplicated as long as each side is a single one; nothing is unsafe, and nothing waits.

use core::sync::atomic::{AtomicU8, AtomicUsize, Ordering};

/// Room for N bytes; N is a power of two.
#[derive(Debug)]
pub struct Ring<const N: usize> {
    bytes: [AtomicU8; N],
    /// The numbers of bytes ever put, and ever taken, wrapping.
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

    /// The number of bytes that wait.
    pub fn len(&self) -> usize {
        let taken = self.taken.load(Ordering::Acquire);
        self.put.load(Ordering::Acquire).wrapping_sub(taken)
    }

    /// Returns whether no byte waits.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of bytes for which there is room.
    pub fn room(&self) -> usize {
        N.saturating_sub(self.len())
    }

    /// Puts a byte at the end; returns false if there is no room for it. Only one context may call it.
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

    /// Puts all bytes of a frame or none: half a frame is useless.
    #[must_use]
    pub fn put_all(&self, bytes: &[u8]) -> bool {
        bytes.len() <= self.room() && bytes.iter().all(|&byte| self.put(byte))
    }

    /// The first byte, which remains in the queue. Only the context that takes may call it.
    pub fn peek(&self) -> Option<u8> {
        let taken = self.taken.load(Ordering::Relaxed);
        if self.put.load(Ordering::Acquire) == taken {
            return None;
        }
        Some(self.bytes.get(taken & Self::MASK)?.load(Ordering::Relaxed))
    }

    /// Takes the first byte. Only one context may call it.
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
