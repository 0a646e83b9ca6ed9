//! Clock and line of QEMU's machine mps2-an505, an FPGA image of Arm (AN505) on the board MPS2+; the processor is in its secure state.
//!
//! | what | where |
//! |---|---|
//! | serial line, as fast as QEMU takes bytes | UART0 |
//! | ticks | SysTick, 20 MHz |
//! | clock | the first half of the dual timer, 32 bits, 20 MHz |
//! | motors, watchdog | none |
#![allow(unsafe_code)]

use core::ptr::{with_exposed_provenance, with_exposed_provenance_mut};

// Its start-up code.
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt as _;
use stiction_firmware::device::{FromLine, NoActuators};
use stiction_firmware::line::{self, Line};

use crate::work::{SharedClock, SharedServo};

/// Baud rate of the serial line of the Pico 2; this one has no rate.
pub(crate) const BAUD: u32 = 921_600;
/// Clock of SysTick and the dual timer (Hz).
const COUNTS: u32 = 20_000_000;
const PER_US: u32 = COUNTS / 1_000_000;
const NS: u32 = 1_000_000_000 / COUNTS;

/// What RTIC requires of a chip.
pub(crate) mod chip {
    use cortex_m::interrupt::InterruptNumber;

    /// Fewer than the chip has.
    pub(crate) const NVIC_PRIO_BITS: u8 = 3;

    /// The interrupts that are used.
    #[derive(Clone, Copy)]
    #[repr(u16)]
    #[allow(clippy::upper_case_acronyms)]
    pub(crate) enum Interrupt {
        /// Receiver and sender.
        UART0 = 42,
        /// The interrupt of an unused line: for turns.
        SPARE = 43,
    }

    pub(crate) use Interrupt as interrupt;

    // SAFETY: the numbers are those of the chip.
    unsafe impl InterruptNumber for Interrupt {
        fn number(self) -> u16 {
            self as u16
        }
    }

    /// No peripherals to take: registers are accessed by their addresses.
    pub(crate) struct Peripherals;

    impl Peripherals {
        /// Called once, before anything runs.
        pub(crate) const unsafe fn steal() -> Self {
            Self
        }
    }

    unsafe extern "C" {
        fn DefaultHandler();
        fn UART0();
        fn SPARE();
    }

    const LAST: usize = Interrupt::SPARE as usize;

    /// The table in which the processor finds the interrupts.
    #[unsafe(link_section = ".vector_table.interrupts")]
    #[unsafe(no_mangle)]
    static __INTERRUPTS: [unsafe extern "C" fn(); LAST + 1] = {
        let mut vectors = [DefaultHandler as unsafe extern "C" fn(); LAST + 1];
        vectors[Interrupt::UART0 as usize] = UART0;
        vectors[LAST] = SPARE;
        vectors
    };
}

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
    pub(crate) fn start(systick: SYST, rate: u16) -> Self {
        Self {
            uart: Uart::start(),
            clock: SharedClock(Clock::start(systick, rate)),
            watchdog: Watchdog,
            servo: SharedServo::new((FromLine, NoActuators)),
        }
    }
}

/// Reads a register.
fn read(at: usize) -> u32 {
    // SAFETY: all addresses here are those of registers; reading one has only the side effects of that register.
    unsafe { with_exposed_provenance::<u32>(at).read_volatile() }
}

/// Writes a register.
fn write(at: usize, value: u32) {
    // SAFETY: all addresses here are those of registers, which change no memory.
    unsafe { with_exposed_provenance_mut::<u32>(at).write_volatile(value) };
}

/// Ticks, and time from a counter of its own: SysTick alone does not show how many ticks were missed.
pub(crate) struct Clock {
    systick: SYST,
    /// Ticks per second.
    rate: u16,
    last: u32,
    /// Counts that do not make up a µs yet.
    rest: u32,
    now_us: u32,
}

impl Clock {
    /// Registers of the dual timer.
    const TIMER: usize = 0x5000_2000;
    const VALUE: usize = Self::TIMER + 0x04;
    const CONTROL: usize = Self::TIMER + 0x08;
    /// It counts with all 32 bits, and restarts by itself.
    const RUNS_WHOLE: u32 = 1 << 7 | 1 << 1;

    fn start(mut systick: SYST, rate: u16) -> Self {
        write(Self::CONTROL, Self::RUNS_WHOLE);
        systick.set_clock_source(SystClkSource::Core);
        let mut clock = Self {
            systick,
            rate: 0,
            last: Self::count(),
            rest: 0,
            now_us: 0,
        };
        clock.set_rate(rate);
        clock.systick.enable_counter();
        clock.systick.enable_interrupt();
        clock
    }

    /// It counts down.
    fn count() -> u32 {
        !read(Self::VALUE)
    }

    /// Sets the ticks per second from now on, at least 2.
    pub(crate) fn set_rate(&mut self, rate: u16) {
        if rate != self.rate {
            self.rate = rate;
            let counts = COUNTS / u32::from(rate.max(2));
            self.systick.set_reload(counts.saturating_sub(1));
            self.systick.clear_current();
        }
    }

    /// A tick has come: returns the time (µs, wrapping). There must be one within 200 s.
    pub(crate) fn tick(&mut self) -> u32 {
        let count = Self::count();
        let counts = count.wrapping_sub(self.last).saturating_add(self.rest);
        self.last = count;
        self.rest = counts % PER_US;
        self.now_us = self.now_us.wrapping_add(counts / PER_US);
        self.now_us
    }
}

impl line::Clock for Clock {
    fn now_ns(&mut self) -> u32 {
        Self::count().wrapping_mul(NS)
    }
}

/// The serial line.
pub(crate) struct Uart;

impl Uart {
    const DATA: usize = 0x5020_0000;
    const STATE: usize = Self::DATA + 0x04;
    const CONTROL: usize = Self::DATA + 0x08;
    /// Pending interrupts; writing a bit clears it.
    const ASKED: usize = Self::DATA + 0x0C;
    const DIVIDER: usize = Self::DATA + 0x10;
    /// In the state register: bytes wait.
    const SENDS: u32 = 1 << 0;
    const RECEIVED: u32 = 1 << 1;
    /// Both directions, with an interrupt each.
    const BOTH: u32 = 0b1111;
    /// The smallest divider that the line accepts.
    const LEAST_DIVIDER: u32 = 16;

    fn start() -> Self {
        write(Self::DIVIDER, Self::LEAST_DIVIDER);
        write(Self::CONTROL, Self::BOTH);
        Self
    }

    /// A byte in, a byte out, after which the line requests an interrupt again.
    pub(crate) fn serve<const N: usize>(&mut self, line: &Line<N>) {
        write(Self::ASKED, read(Self::ASKED));
        let state = read(Self::STATE);
        if state & Self::RECEIVED != 0 {
            line.receive(read(Self::DATA) as u8);
        }
        if state & Self::SENDS == 0
            && let Some(byte) = line.next()
        {
            write(Self::DATA, byte.into());
        }
    }
}

/// None: an emulated board needs no reset.
pub(crate) struct Watchdog;

impl Watchdog {
    pub(crate) const fn feed(&mut self) {}
}

/// There are none.
pub(crate) const fn actuators_off() {}
