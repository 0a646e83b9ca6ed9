//! The line of a board, between the interrupt that moves its bytes and the tick that needs them.

use core::sync::atomic::{AtomicU32, Ordering};

use crate::ring::Ring;
use crate::station::Link;

/// Room for N bytes each way; N is a power of two.
#[derive(Debug, Default)]
pub struct Line<const N: usize> {
    received: Ring<N>,
    to_send: Ring<N>,
    lost: AtomicU32,
}

/// A clock of a board.
pub trait Clock {
    /// The time (ns, wrapping), for what takes no longer than 50 ms.
    fn now_ns(&mut self) -> u32;
}

impl<const N: usize> Line<N> {
    /// Nothing came yet.
    pub const fn new() -> Self {
        Self {
            received: Ring::new(),
            to_send: Ring::new(),
            lost: AtomicU32::new(0),
        }
    }

    /// A byte came. To be called by the interrupt only.
    pub fn receive(&self, byte: u8) {
        if !self.received.put(byte) {
            self.lose();
        }
    }

    /// A byte came too fast. To be called by the interrupt only.
    pub fn lose(&self) {
        // Nobody else writes it, and a Cortex-M0 cannot add to it at once.
        let lost = self.lost.load(Ordering::Relaxed).saturating_add(1);
        self.lost.store(lost, Ordering::Relaxed);
    }

    /// The next byte that is to be sent. To be called by the interrupt only.
    pub fn next(&self) -> Option<u8> {
        self.to_send.take()
    }

    /// The same, which stays the next.
    pub fn peek(&self) -> Option<u8> {
        self.to_send.peek()
    }

    /// For how many more bytes there is room.
    pub fn room(&self) -> usize {
        self.received.room()
    }

    /// Bytes that came when there was no room for them, or too fast.
    pub fn lost(&self) -> u32 {
        self.lost.load(Ordering::Relaxed)
    }

    /// What the tick has of it; `wake` lets the interrupt come when there is something to send.
    pub const fn link<'a, C: Clock>(&'a self, clock: &'a mut C, wake: fn()) -> LineLink<'a, C, N> {
        LineLink {
            line: self,
            clock,
            wake,
        }
    }
}

/// A line as the tick has it.
#[derive(Debug)]
pub struct LineLink<'a, C, const N: usize> {
    line: &'a Line<N>,
    clock: &'a mut C,
    wake: fn(),
}

impl<C: Clock, const N: usize> Link for LineLink<'_, C, N> {
    fn take(&mut self) -> Option<u8> {
        self.line.received.take()
    }

    fn send(&mut self, frame: &[u8]) -> bool {
        let sent = self.line.to_send.put_all(frame);
        (self.wake)();
        sent
    }

    fn now_ns(&mut self) -> u32 {
        self.clock.now_ns()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Stopped;

    impl Clock for Stopped {
        fn now_ns(&mut self) -> u32 {
            7
        }
    }

    #[test]
    fn bytes_go_both_ways_and_those_without_room_are_counted() {
        let (line, mut clock) = (Line::<4>::new(), Stopped);
        (0..6).for_each(|byte| line.receive(byte));
        let mut link = line.link(&mut clock, || {});
        let taken: [_; 5] = core::array::from_fn(|_| link.take());
        assert_eq!(taken, [Some(0), Some(1), Some(2), Some(3), None]);
        assert!(link.send(&[8, 9, 10]) && !link.send(&[11, 12]));
        assert_eq!(link.now_ns(), 7);
        let sent: [_; 4] = core::array::from_fn(|_| line.next());
        assert_eq!(sent, [Some(8), Some(9), Some(10), None]);
        assert_eq!(line.lost(), 2);
    }
}
