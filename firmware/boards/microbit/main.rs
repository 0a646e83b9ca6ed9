//! stiction on the BBC micro:bit: in this folder `cargo load` flashes it, `cargo emulate` starts QEMU.
//!
//! | what | where |
//! |---|---|
//! | serial line, 115200 8N1, over USB | UART0: P0.24 out, P0.25 in |
//! | ticks and clock | TIMER0, 32 bits, 16 MHz |
//! | motors | none; all pins become inputs when it stops |
#![no_std]
#![no_main]
#![allow(unsafe_code)]

use nrf51_hal::clocks::Clocks;
use nrf51_hal::pac::{self, GPIO, TIMER0, UART0, WDT};
use nrf51_hal::wdt::handles::Hdl0;
use nrf51_hal::wdt::{self, WatchdogHandle};
use stiction_boards::elapsed::Elapsed;
use stiction_boards::work::{self, NO_DEVICE, NoDevice};
use stiction_boards::{Board, Parts, PartsOf, Port, Ticks, Watchdog};
use stiction_core::Evolution;
use stiction_firmware::line::{self, Line};
use stiction_firmware::speed::Processor;
use stiction_firmware::station::Setup;
use stiction_wire::Mode;

// 6 bytes wait in the receiver, 0.5 ms.
stiction_boards::app! {
    board: Microbit,
    chip: nrf51_hal::pac,
    serial: UART0 at 3,
    tick: TIMER0 at 2,
    turn: SWI0 at 1,
}

const BAUD: u32 = 115_200;
/// Clock of the processor and of TIMER0 (Hz), and per µs.
const CLOCK: u32 = 16_000_000;
const PER_US: u32 = 16;
const TX: u32 = 24;
const RX: u32 = 25;
/// A tick that does not come for this long ends in a reset, in ticks of 32 768 Hz: 50 ms.
const PATIENCE: u32 = 1_638;

/// This board.
pub struct Microbit;

impl Board for Microbit {
    type Chip = pac::Peripherals;
    type Memory = ();
    type Clock = Clock;
    type Device = NoDevice;
    type Uart = Uart;
    type Usb = ();
    type Watchdog = Wdt;

    const SETUP: Setup = Setup {
        name: "microbit",
        line_rate: BAUD / 10,
        fastest_tick: 500,
        // Half of the time is reserved for the interrupts of the line and the rest of a tick.
        work_rate: Processor::CORTEX_M0.work_rate(CLOCK, 4),
        mode: Mode {
            evolution: Evolution::Frame,
            tick_rate: 200,
            ..Mode::DEFAULT
        },
        ..work::SETUP
    };
    /// 22 ms.
    const ROOM: usize = 256;
    const MEMORY: () = ();

    fn start(chip: pac::Peripherals, _: cortex_m::Peripherals, (): &mut ()) -> PartsOf<Self> {
        // The crystal: the internal oscillator is too inaccurate for a serial line.
        let _ = Clocks::new(chip.CLOCK).enable_ext_hfosc();
        Parts {
            uart: Uart::new(chip.UART0, &chip.GPIO),
            usb: (),
            clock: Clock::new(chip.TIMER0, Self::SETUP.mode.tick_rate),
            watchdog: Wdt::new(chip.WDT),
            device: NO_DEVICE,
        }
    }

    /// No pin except the serial line drives anything any more.
    fn actuators_off() {
        // SAFETY: one register, written once.
        unsafe { (*GPIO::ptr()).dirclr.write(|w| w.bits(!(1 << TX))) };
    }
}

/// Ticks and time, both from one counter that never stops.
pub struct Clock {
    timer: TIMER0,
    rate: u16,
    /// Counts between two ticks.
    period: u32,
    next: u32,
    elapsed: Elapsed,
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
            elapsed: Elapsed::since(0),
        }
    }

    fn count(&self) -> u32 {
        // SAFETY: copies the counter to CC[1].
        unsafe { self.timer.tasks_capture[1].write(|w| w.bits(1)) };
        self.timer.cc[1].read().bits()
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
}

impl Ticks for Clock {
    /// Beginning with the next one.
    fn set_rate(&mut self, rate: u16) {
        if rate != self.rate {
            self.next = self.next.wrapping_sub(self.period);
            self.rate = rate;
            self.period = period(rate);
            let now = self.count();
            self.arm(now);
        }
    }

    fn tick(&mut self) -> u32 {
        let now = self.count();
        self.arm(now);
        // Last: as long as the compare value is the present one, a capture in QEMU sets the event again.
        self.timer.events_compare[0].reset();
        self.elapsed.us(now, PER_US)
    }
}

impl line::Clock for Clock {
    fn now_ns(&mut self) -> u32 {
        self.elapsed.ns(self.count(), PER_US)
    }
}

fn period(rate: u16) -> u32 {
    CLOCK / u32::from(rate.max(1))
}

/// The serial line.
pub struct Uart {
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

    fn read(&mut self) -> Option<u8> {
        if self.uart.events_rxdrdy.read().bits() == 0 {
            return None;
        }
        self.uart.events_rxdrdy.reset();
        Some(self.uart.rxd.read().rxd().bits())
    }

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

impl Port for Uart {
    /// All bytes in, a byte out.
    fn serve<const N: usize>(&mut self, line: &Line<N>) {
        while let Some(byte) = self.read() {
            line.receive(byte);
        }
        self.send(line);
    }
}

/// The watchdog, if it can be used.
pub struct Wdt(Option<WatchdogHandle<Hdl0>>);

impl Wdt {
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
}

impl Watchdog for Wdt {
    fn feed(&mut self) {
        if let Some(handle) = &mut self.0 {
            handle.pet();
        }
    }
}
