//! Pins, clocks and interrupts.
//!
//! | what | where |
//! |---|---|
//! | serial line, 115200 8N1, over USB | UART0: P0.24 out, P0.25 in |
//! | ticks and clock | TIMER0, 32 bits, 16 MHz |
//! | motors | none; all pins become inputs when it stops |
#![allow(unsafe_code)]

use nrf51_hal::clocks::Clocks;
use nrf51_hal::pac::{self, GPIO, TIMER0, UART0, WDT};
use nrf51_hal::wdt::handles::Hdl0;
use nrf51_hal::wdt::{self, WatchdogHandle};
use stiction_firmware::device::{FromLine, NoActuators};
use stiction_firmware::line::{self, Line};

use crate::work::{SharedClock, SharedServo};

/// Baud rate of the serial line.
pub(crate) const BAUD: u32 = 115_200;
/// Clock of the processor and of TIMER0 (Hz), and per µs.
pub(crate) const CLOCK: u32 = 16_000_000;
const PER_US: u32 = 16;
const TX: u32 = 24;
const RX: u32 = 25;
/// A tick that does not come for this long ends in a reset, in ticks of 32 768 Hz: 50 ms.
const PATIENCE: u32 = 1_638;

/// This board has no device.
pub(crate) type Device = (FromLine, NoActuators);

/// The resources of the tasks.
pub(crate) struct Board {
    pub(crate) uart: Uart,
    pub(crate) clock: SharedClock,
    pub(crate) servo: SharedServo,
    pub(crate) watchdog: Watchdog,
}

impl Board {
    /// Starts everything, with this many ticks per second.
    pub(crate) fn start(device: pac::Peripherals, rate: u16) -> Self {
        // The crystal: the internal oscillator is too inaccurate for a serial line.
        let _ = Clocks::new(device.CLOCK).enable_ext_hfosc();
        Self {
            uart: Uart::new(device.UART0, &device.GPIO),
            clock: SharedClock(Clock::new(device.TIMER0, rate)),
            watchdog: Watchdog::new(device.WDT),
            servo: SharedServo::new((FromLine, NoActuators)),
        }
    }
}

/// Ticks and time, both from one counter that never stops.
pub(crate) struct Clock {
    timer: TIMER0,
    /// Ticks per second.
    rate: u16,
    /// Counts between them.
    period: u32,
    /// The count of the next tick.
    next: u32,
    last: u32,
    /// Counts that do not make up a µs yet.
    rest: u32,
    now_us: u32,
    /// The count at the last call of [`Self::now_ns`].
    looked: u32,
    now_ns: u32,
}

impl Clock {
    fn new(timer: TIMER0, rate: u16) -> Self {
        let period = period(rate);
        timer.mode.write(|w| w.mode().timer());
        timer.bitmode.write(|w| w.bitmode()._32bit());
        // SAFETY: 0 is one of the prescaler's values, and every compare value is allowed.
        unsafe {
            timer.prescaler.write(|w| w.prescaler().bits(0));
            timer.cc[0].write(|w| w.bits(period));
        }
        timer.intenset.write(|w| w.compare0().set());
        // SAFETY: starts the timer.
        unsafe {
            timer.tasks_clear.write(|w| w.bits(1));
            timer.tasks_start.write(|w| w.bits(1));
        }
        Self {
            timer,
            rate,
            period,
            next: period,
            last: 0,
            rest: 0,
            now_us: 0,
            looked: 0,
            now_ns: 0,
        }
    }

    fn count(&self) -> u32 {
        // SAFETY: copies the counter to CC[1].
        unsafe { self.timer.tasks_capture[1].write(|w| w.bits(1)) };
        self.timer.cc[1].read().bits()
    }

    /// Sets the ticks per second, beginning with the next one.
    pub(crate) fn set_rate(&mut self, rate: u16) {
        if rate != self.rate {
            self.next = self.next.wrapping_sub(self.period);
            self.rate = rate;
            self.period = period(rate);
            let now = self.count();
            self.arm(now);
        }
    }

    /// The next tick is a whole number of periods after the previous one, and not before now: a compare value in the past would match only
    /// after 4 minutes.
    // Flash is limited.
    #[inline(never)]
    fn arm(&mut self, now: u32) {
        self.next = self.next.wrapping_add(self.period);
        // Time enough to write the compare value.
        const MARGIN: u32 = 20 * PER_US;
        while self.next.wrapping_sub(now.wrapping_add(MARGIN)) > i32::MAX as u32 {
            self.next = self.next.wrapping_add(self.period);
        }
        // SAFETY: every compare value is allowed.
        unsafe { self.timer.cc[0].write(|w| w.bits(self.next)) };
    }

    /// A tick has come: returns the time (µs, wrapping).
    pub(crate) fn tick(&mut self) -> u32 {
        let now = self.count();
        self.arm(now);
        // Last: as long as the compare value is the present one, a capture in QEMU sets the event again.
        self.timer.events_compare[0].reset();
        let counts = now.wrapping_sub(self.last).saturating_add(self.rest);
        self.last = now;
        self.rest = counts % PER_US;
        self.now_us = self.now_us.wrapping_add(counts / PER_US);
        self.now_us
    }
}

impl line::Clock for Clock {
    fn now_ns(&mut self) -> u32 {
        let count = self.count();
        // 62.5 ns each; the half may be left out.
        let passed = count.wrapping_sub(self.looked).saturating_mul(125) / 2;
        self.looked = count;
        self.now_ns = self.now_ns.wrapping_add(passed);
        self.now_ns
    }
}

/// Counts between the ticks of a rate.
fn period(rate: u16) -> u32 {
    CLOCK / u32::from(rate.max(1))
}

/// The serial line.
pub(crate) struct Uart {
    uart: UART0,
    sending: bool,
}

impl Uart {
    fn new(uart: UART0, gpio: &GPIO) -> Self {
        // SAFETY: pins of the board that nothing else uses, and the tasks that start the line.
        unsafe {
            gpio.outset.write(|w| w.bits(1 << TX));
            gpio.dirset.write(|w| w.bits(1 << TX));
            uart.pseltxd.write(|w| w.bits(TX));
            uart.pselrxd.write(|w| w.bits(RX));
            uart.baudrate.write(|w| w.baudrate().baud115200());
            uart.enable.write(|w| w.enable().enabled());
            uart.intenset.write(|w| w.rxdrdy().set().txdrdy().set());
            uart.tasks_starttx.write(|w| w.bits(1));
            uart.tasks_startrx.write(|w| w.bits(1));
        }
        Self {
            uart,
            sending: false,
        }
    }

    /// Takes the bytes that arrived, and sends a byte.
    pub(crate) fn serve<const N: usize>(&mut self, line: &Line<N>) {
        while let Some(byte) = self.read() {
            line.receive(byte);
        }
        self.send(line);
    }

    /// The byte that arrived, if any.
    fn read(&mut self) -> Option<u8> {
        if self.uart.events_rxdrdy.read().bits() == 0 {
            return None;
        }
        self.uart.events_rxdrdy.reset();
        Some(self.uart.rxd.read().rxd().bits())
    }

    /// Sends the next byte if the line is free.
    fn send<const N: usize>(&mut self, line: &Line<N>) {
        if self.uart.events_txdrdy.read().bits() != 0 {
            self.uart.events_txdrdy.reset();
            self.sending = false;
        }
        if !self.sending
            && let Some(byte) = line.next()
        {
            self.sending = true;
            // SAFETY: any byte may be sent.
            unsafe { self.uart.txd.write(|w| w.txd().bits(byte)) };
        }
    }
}

/// Resets the chip unless it is fed.
pub(crate) struct Watchdog(Option<WatchdogHandle<Hdl0>>);

impl Watchdog {
    fn new(device: WDT) -> Self {
        let handle = match wdt::Watchdog::try_new(device) {
            Ok(mut watchdog) => {
                watchdog.set_lfosc_ticks(PATIENCE);
                watchdog.run_during_debug_halt(false);
                Some(watchdog.activate::<wdt::count::One>().handles.0)
            }
            // It has been running since before a soft reset: use the same handle.
            Err(device) => match wdt::Watchdog::try_recover::<wdt::count::One>(device) {
                Ok(parts) => Some(parts.handles.0),
                Err(_) => None,
            },
        };
        Self(handle)
    }

    pub(crate) fn feed(&mut self) {
        if let Some(handle) = &mut self.0 {
            handle.pet();
        }
    }
}

/// No pin except the serial line drives anything any more.
pub(crate) fn actuators_off() {
    // SAFETY: one register, written once.
    unsafe { (*GPIO::ptr()).dirclr.write(|w| w.bits(!(1 << TX))) };
}
