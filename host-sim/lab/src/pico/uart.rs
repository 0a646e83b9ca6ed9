//! UART0 of the chip, a PL011 (RP2040 datasheet, section 4.2): bytes travel over its line at its baud rate, in both directions.

use std::collections::VecDeque;

/// Its registers, by offset.
const DATA: u32 = 0x00;
const ERRORS: u32 = 0x04;
const FLAGS: u32 = 0x18;
const DIVISOR: u32 = 0x24;
const FRACTION: u32 = 0x28;
const LINE_CONTROL: u32 = 0x2C;
const CONTROL: u32 = 0x30;
const LEVELS: u32 = 0x34;
const MASK: u32 = 0x38;
const RAISED: u32 = 0x3C;
const MASKED: u32 = 0x40;
const CLEAR: u32 = 0x44;

const CAN_RECEIVE: u32 = 1 << 4;
const CAN_SEND: u32 = 1 << 5;
const TIMEOUT: u32 = 1 << 6;
const OVERRUN: u32 = 1 << 10;

/// The capacity of each of its two queues (bytes), if they are enabled.
const DEPTH: usize = 32;
/// Bits per byte on the line: a start bit, 8 data bits, a stop bit.
const BITS: u64 = 10;
/// Received bytes are reported after this many bit times without another byte.
const SILENT_BITS: u64 = 32;

/// Its registers, and the line.
#[derive(Debug, Default)]
pub(crate) struct Uart {
    divisor: u32,
    fraction: u32,
    line_control: u32,
    control: u32,
    levels: u32,
    mask: u32,
    /// Causes that remain until they are cleared.
    raised: u32,
    received: VecDeque<u8>,
    to_send: VecDeque<u8>,
    /// A byte arrived when the queue was full.
    overrun: bool,
    /// When the byte on the line is complete, in each direction, and when the line has been silent long enough (cycles).
    next_in: Option<u64>,
    next_out: Option<u64>,
    silent_at: Option<u64>,
    /// Bytes in transit to the chip, and those that have left it.
    coming: VecDeque<u8>,
    gone: Vec<u8>,
}

impl Uart {
    /// Bytes that arrive over the line from now (cycles) on, one after another.
    pub(crate) fn bring(&mut self, bytes: &[u8], now: u64) {
        self.coming.extend(bytes);
        if self.next_in.is_none() && !self.coming.is_empty() {
            self.next_in = Some(now + self.cycles(BITS));
        }
    }

    /// The number of bytes in transit to the chip.
    pub(crate) fn coming(&self) -> usize {
        self.coming.len()
    }

    /// The bytes that have left the chip since the last call.
    pub(crate) fn gone(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.gone)
    }

    pub(crate) fn reset(&mut self) {
        *self = Self {
            next_in: self.next_in,
            coming: std::mem::take(&mut self.coming),
            gone: std::mem::take(&mut self.gone),
            ..Self::default()
        };
    }

    /// The next time at which it does something on its own (cycles).
    pub(crate) fn due(&self) -> u64 {
        let times = [self.next_in, self.next_out, self.silent_at];
        times.into_iter().flatten().min().unwrap_or(u64::MAX)
    }

    /// Whether it requests its interrupt.
    pub(crate) fn interrupts(&self) -> bool {
        self.causes() & self.mask != 0
    }

    /// Processes everything that happens up to now (cycles).
    pub(crate) fn advance(&mut self, now: u64) {
        while let Some(at) = self.next_in.filter(|at| *at <= now) {
            self.arrive(at);
        }
        while let Some(at) = self.next_out.filter(|at| *at <= now) {
            self.gone.extend(self.to_send.pop_front());
            if self.to_send.len() == self.send_level() {
                self.raised |= CAN_SEND;
            }
            self.next_out = (!self.to_send.is_empty()).then(|| at + self.cycles(BITS));
        }
        if self.silent_at.is_some_and(|at| at <= now) {
            self.silent_at = None;
            self.raised |= TIMEOUT;
        }
    }

    /// A byte on the line is complete.
    fn arrive(&mut self, at: u64) {
        let byte = self.coming.pop_front();
        self.next_in = (!self.coming.is_empty()).then(|| at + self.cycles(BITS));
        /// Bits of the control register: the line is enabled, and receives.
        const ON: u32 = 1 | 1 << 9;
        if self.control & ON != ON {
            return;
        }
        if self.received.len() < self.depth() {
            self.received.extend(byte);
            self.silent_at = Some(at + self.cycles(SILENT_BITS));
        } else {
            self.overrun = true;
            self.raised |= OVERRUN;
        }
    }

    /// The time of a number of bits: a bit takes 16 times its divisor, whose fraction counts in 64ths.
    fn cycles(&self, bits: u64) -> u64 {
        let divisor = u64::from(self.divisor * 64 + self.fraction);
        (bits * 16 * divisor / 64).max(1)
    }

    fn depth(&self) -> usize {
        const QUEUES: u32 = 1 << 4;
        if self.line_control & QUEUES == 0 {
            1
        } else {
            DEPTH
        }
    }

    /// The fill level of a queue at which it requests attention, from the field of its register.
    fn level(&self, field: u32) -> usize {
        self.depth() * [1, 2, 4, 6, 7, 4, 4, 4][field as usize % 8] / 8
    }

    fn send_level(&self) -> usize {
        self.level(self.levels)
    }

    fn causes(&self) -> u32 {
        let receive_level = self.level(self.levels >> 3).max(1);
        let can_receive = self.received.len() >= receive_level;
        self.raised | (u32::from(can_receive) * CAN_RECEIVE)
    }

    pub(crate) fn read(&mut self, offset: u32) -> u32 {
        match offset {
            DATA => self.take(),
            ERRORS => u32::from(self.overrun) << 3,
            FLAGS => self.flags(),
            MASKED => self.causes() & self.mask,
            _ => self.stored(offset),
        }
    }

    /// The contents of a register that can be written bit by bit.
    pub(crate) fn stored(&self, offset: u32) -> u32 {
        match offset {
            DIVISOR => self.divisor,
            FRACTION => self.fraction,
            LINE_CONTROL => self.line_control,
            CONTROL => self.control,
            LEVELS => self.levels,
            MASK => self.mask,
            RAISED => self.causes(),
            _ => 0,
        }
    }

    /// Writes a register, at a time (cycles).
    pub(crate) fn write(&mut self, offset: u32, value: u32, now: u64) {
        match offset {
            DATA => self.put(value as u8, now),
            ERRORS => self.overrun = false,
            DIVISOR => self.divisor = value,
            FRACTION => self.fraction = value,
            LINE_CONTROL => self.line_control = value,
            CONTROL => self.control = value,
            LEVELS => self.levels = value,
            MASK => self.mask = value,
            CLEAR => self.raised &= !value,
            _ => {}
        }
    }

    /// The next received byte; the overrun is reported with it.
    fn take(&mut self) -> u32 {
        let byte = self.received.pop_front().unwrap_or_default();
        if self.received.is_empty() {
            self.silent_at = None;
            self.raised &= !TIMEOUT;
        }
        u32::from(byte) | u32::from(self.overrun) << 11
    }

    fn put(&mut self, byte: u8, now: u64) {
        if self.to_send.len() < self.depth() {
            self.to_send.push_back(byte);
        }
        if self.to_send.len() > self.send_level() {
            self.raised &= !CAN_SEND;
        }
        if self.next_out.is_none() {
            self.next_out = Some(now + self.cycles(BITS));
        }
    }

    fn flags(&self) -> u32 {
        let (received, to_send) = (self.received.len(), self.to_send.len());
        let flag = |is_set: bool, bit: u32| u32::from(is_set) << bit;
        flag(to_send > 0, 3)
            | flag(received == 0, 4)
            | flag(to_send >= self.depth(), 5)
            | flag(received >= self.depth(), 6)
            | flag(to_send == 0, 7)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A UART at 921 600 baud and 125 MHz: divisor 8 and 31/64.
    fn on() -> Uart {
        let mut uart = Uart::default();
        uart.write(DIVISOR, 8, 0);
        uart.write(FRACTION, 31, 0);
        uart.write(LINE_CONTROL, 0x70, 0);
        uart.write(CONTROL, 0x301, 0);
        uart.write(MASK, CAN_RECEIVE | TIMEOUT | CAN_SEND, 0);
        uart
    }

    #[test]
    fn a_byte_takes_its_time_on_the_line() {
        let mut uart = on();
        let byte = uart.cycles(BITS);
        let expected = 125e6 * 10.0 / 921_600.0;
        assert!((byte as f64 - expected).abs() < 2.0, "{byte}");
        uart.bring(&[7, 8], 1_000);
        uart.advance(1_000 + byte - 1);
        assert_ne!(uart.read(FLAGS) & 1 << 4, 0, "nothing has come");
        uart.advance(1_000 + 2 * byte);
        assert_eq!([uart.read(DATA), uart.read(DATA)], [7, 8]);
        (0..3).for_each(|value| uart.write(DATA, value, 10_000));
        uart.advance(10_000 + 2 * byte);
        assert_eq!(uart.gone(), [0, 1]);
    }

    #[test]
    fn it_interrupts_when_much_came_or_nothing_more() {
        let mut uart = on();
        let byte = uart.cycles(BITS);
        uart.bring(&[1, 2, 3, 4], 0);
        uart.advance(3 * byte);
        assert!(!uart.interrupts(), "an eighth of its queue is four");
        uart.advance(4 * byte);
        assert!(uart.interrupts());
        while uart.read(FLAGS) & 1 << 4 == 0 {
            uart.read(DATA);
        }
        assert!(!uart.interrupts());
        uart.bring(&[5], 4 * byte);
        uart.advance(5 * byte + uart.cycles(SILENT_BITS) - 1);
        assert!(!uart.interrupts());
        uart.advance(5 * byte + uart.cycles(SILENT_BITS));
        assert!(uart.interrupts());
        uart.read(DATA);
        assert!(!uart.interrupts());
    }

    #[test]
    fn what_does_not_fit_is_lost_and_said() {
        let mut uart = on();
        uart.bring(&[3; 40], 0);
        uart.advance(40 * uart.cycles(BITS));
        assert_eq!(uart.received.len(), DEPTH);
        assert_eq!(uart.read(ERRORS), 8);
        assert_eq!(uart.read(DATA), 3 | 1 << 11);
        uart.write(ERRORS, 0, 0);
        assert_eq!(uart.read(DATA), 3);
    }

    #[test]
    fn there_is_room_to_send_when_half_has_left() {
        let mut uart = on();
        let byte = uart.cycles(BITS);
        uart.write(LEVELS, 2, 0);
        (0..40).for_each(|value| uart.write(DATA, value, 0));
        assert_ne!(uart.read(FLAGS) & 1 << 5, 0, "full");
        uart.advance(15 * byte);
        assert!(!uart.interrupts());
        uart.advance(16 * byte);
        assert!(uart.interrupts());
        uart.write(CLEAR, CAN_SEND, 0);
        assert!(!uart.interrupts());
    }
}
