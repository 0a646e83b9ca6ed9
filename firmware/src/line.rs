//! The line of a board, between the interrupt that transfers its bytes and the tick that needs them.

use core::sync::atomic::{AtomicU32, Ordering};

use embedded_io::{Read, ReadReady, Write, WriteReady};

use crate::ring::Ring;
use crate::station::Link;

/// Room for N bytes in each direction; N is a power of two.
#[derive(Debug, Default)]
pub struct Line<const N: usize> {
    received: Ring<N>,
    to_send: Ring<N>,
    lost: AtomicU32,
}

/// Bytes that are read from a port at a time.
const PIECE: usize = 32;

/// A clock of a board.
pub trait Clock {
    /// The time (ns, wrapping), for durations of up to 50 ms.
    fn now_ns(&mut self) -> u32;
}

/// A clock that returns µs, wrapping.
#[derive(Clone, Copy, Debug)]
pub struct Micros<F>(pub F);

impl<F: FnMut() -> u32> Clock for Micros<F> {
    fn now_ns(&mut self) -> u32 {
        (self.0)().wrapping_mul(1_000)
    }
}

impl<const N: usize> Line<N> {
    /// Empty.
    pub const fn new() -> Self {
        Self {
            received: Ring::new(),
            to_send: Ring::new(),
            lost: AtomicU32::new(0),
        }
    }

    /// Stores a byte that arrived. Only the interrupt may call it.
    pub fn receive(&self, byte: u8) {
        if !self.received.put(byte) {
            self.lose();
        }
    }

    /// Stores bytes that arrived, one after the other. Only the interrupt may call it.
    pub fn receive_all<'a>(&self, bytes: impl IntoIterator<Item = &'a u8>) {
        bytes.into_iter().for_each(|&byte| self.receive(byte));
    }

    /// Counts a byte that arrived too fast. Only the interrupt may call it.
    pub fn lose(&self) {
        // Nothing else writes it, and a Cortex-M0 has no atomic addition.
        let lost = self.lost.load(Ordering::Relaxed).saturating_add(1);
        self.lost.store(lost, Ordering::Relaxed);
    }

    /// The next byte to be sent. Only the interrupt may call it.
    pub fn next(&self) -> Option<u8> {
        self.to_send.take()
    }

    /// The next byte to be sent, which remains the next one. Only the interrupt may call it.
    pub fn peek(&self) -> Option<u8> {
        self.to_send.peek()
    }

    /// The number of further bytes for which there is room.
    pub fn room(&self) -> usize {
        self.received.room()
    }

    /// Bytes that arrived when there was no room for them, or too fast.
    pub fn lost(&self) -> u32 {
        self.lost.load(Ordering::Relaxed)
    }

    /// Transfers bytes without waiting: from a port while there is room for them, and to it while it accepts them. Only the interrupt may
    /// call it, or, if the driver of the port has buffers of its own, the program between ticks.
    pub fn serve<P: Read + ReadReady + Write + WriteReady>(&self, port: &mut P) {
        let mut bytes = [0; PIECE];
        // Bytes for which there is no room stay in the port.
        while self.room() >= PIECE && port.read_ready().unwrap_or(false) {
            match port.read(&mut bytes) {
                Ok(0) => break,
                Ok(count) => self.receive_all(bytes.iter().take(count)),
                Err(_) => return self.lose(),
            }
        }
        while let Some(byte) = self.peek()
            && port.write_ready().unwrap_or(false)
            && matches!(port.write(&[byte]), Ok(1))
        {
            self.next();
        }
    }

    /// Returns whether something is to be sent.
    pub fn has_to_send(&self) -> bool {
        self.peek().is_some()
    }

    /// The tick's end of the line; `wake` triggers the interrupt when there is something to send.
    pub const fn link<'a, C: Clock>(&'a self, clock: &'a mut C, wake: fn()) -> LineLink<'a, C, N> {
        LineLink {
            line: self,
            clock,
            wake,
        }
    }
}

/// A line as seen by the tick.
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

    /// At 7 µs before it wraps.
    const STOPPED: Micros<fn() -> u32> = Micros(|| u32::MAX - 6);

    /// A port whose other side is two arrays: bytes come from `came`, and those for which there is room go to `went`.
    struct Port<'a> {
        came: &'a [u8],
        went: heapless::Vec<u8, 3>,
        fails: bool,
    }

    impl embedded_io::ErrorType for Port<'_> {
        type Error = embedded_io::ErrorKind;
    }

    impl Read for Port<'_> {
        fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Self::Error> {
            if core::mem::take(&mut self.fails) {
                return Err(embedded_io::ErrorKind::Other);
            }
            // As a receiver of 5 bytes returns them.
            let count = self.came.len().min(bytes.len()).min(5);
            assert!(count > 0, "a read that waits");
            bytes[..count].copy_from_slice(&self.came[..count]);
            self.came = &self.came[count..];
            Ok(count)
        }
    }

    impl ReadReady for Port<'_> {
        fn read_ready(&mut self) -> Result<bool, Self::Error> {
            Ok(self.fails || !self.came.is_empty())
        }
    }

    impl Write for Port<'_> {
        fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> {
            assert!(!self.went.is_full(), "a write that waits");
            let taken = bytes.iter().map_while(|&b| self.went.push(b).ok());
            Ok(taken.count())
        }

        fn flush(&mut self) -> Result<(), Self::Error> {
            unreachable!("a flush waits")
        }
    }

    impl WriteReady for Port<'_> {
        fn write_ready(&mut self) -> Result<bool, Self::Error> {
            Ok(!self.went.is_full())
        }
    }

    #[test]
    fn a_port_is_served_without_waiting_and_what_finds_no_room_stays_with_it() {
        let (line, mut clock) = (Line::<64>::new(), STOPPED);
        let came: [u8; 80] = core::array::from_fn(|i| i as u8);
        let mut port = Port {
            came: &came,
            went: heapless::Vec::new(),
            fails: false,
        };
        assert!(line.link(&mut clock, || {}).send(&[1, 2, 3, 4, 5]));
        line.serve(&mut port);
        assert_eq!(port.went, [1, 2, 3]);
        // Reads while there is room for a whole piece.
        assert_eq!(port.came, &came[35..]);
        port.went.clear();
        let mut taken: heapless::Vec<u8, 80> = heapless::Vec::new();
        for _ in 0..3 {
            let mut link = line.link(&mut clock, || {});
            taken.extend(core::iter::from_fn(|| link.take()));
            line.serve(&mut port);
        }
        assert_eq!(port.went, [4, 5]);
        assert_eq!((taken.as_slice(), line.lost()), (came.as_slice(), 0));
    }

    #[test]
    fn an_error_of_a_port_is_a_lost_byte_and_the_next_call_goes_on() {
        let line = Line::<64>::new();
        let mut port = Port {
            came: &[9],
            went: heapless::Vec::new(),
            fails: true,
        };
        line.serve(&mut port);
        assert_eq!((line.lost(), line.room()), (1, 64));
        line.serve(&mut port);
        assert_eq!((line.lost(), line.room()), (1, 63));
    }

    #[test]
    fn bytes_go_both_ways_and_those_without_room_are_counted() {
        let (line, mut clock) = (Line::<4>::new(), STOPPED);
        line.receive_all(&[0, 1, 2, 3, 4, 5]);
        let mut link = line.link(&mut clock, || {});
        let taken: [_; 5] = core::array::from_fn(|_| link.take());
        assert_eq!(taken, [Some(0), Some(1), Some(2), Some(3), None]);
        assert!(link.send(&[8, 9, 10]) && !link.send(&[11, 12]));
        assert_eq!(link.now_ns().wrapping_add(7_000), 0);
        let sent: [_; 4] = core::array::from_fn(|_| line.next());
        assert_eq!(sent, [Some(8), Some(9), Some(10), None]);
        assert_eq!(line.lost(), 2);
    }
}
