//! stiction in place of a Raspberry Pi Pico 2: QEMU does not emulate its chip, but another one with the same processor, a Cortex-M33, in its
//! secure state: an FPGA image of Arm (AN505) on the board MPS2+. It runs the same program as the Pico 2, at the same rate; clock, line and
//! pins are its own. In this folder `cargo emulate` starts it.
//!
//! | what | where |
//! |---|---|
//! | serial line, as fast as QEMU takes bytes | UART0 |
//! | ticks | SysTick, 20 MHz |
//! | clock | the first half of the dual timer, 32 bits, 20 MHz |
//! | motors, watchdog | none |
#![no_std]
#![no_main]
#![allow(unsafe_code)]

use core::ptr::{with_exposed_provenance, with_exposed_provenance_mut};

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
// Its start-up code.
use cortex_m_rt as _;
use stiction_boards::elapsed::Elapsed;
use stiction_boards::work::{self, NO_DEVICE, NoDevice};
use stiction_boards::{Board, Parts, PartsOf, Port, Ticks, Watchdog, speed};
use stiction_firmware::line::{self, Line};
use stiction_firmware::station::Setup;

stiction_boards::app! {
    board: An505,
    chip: crate::chip,
    serial: UART0 at 3,
    tick: SysTick at 2,
    turn: SPARE at 1,
}

/// Baud rate of the serial line of the Pico 2; this one has no rate.
const BAUD: u32 = 921_600;
/// Clock of SysTick and the dual timer (Hz).
const COUNTS: u32 = 20_000_000;
const PER_US: u32 = COUNTS / 1_000_000;

/// What RTIC requires of a chip.
pub(crate) mod chip {
    use cortex_m::interrupt::InterruptNumber;

    /// Fewer than the chip has.
    pub const NVIC_PRIO_BITS: u8 = 3;

    /// The interrupts that are used.
    #[derive(Clone, Copy)]
    #[repr(u16)]
    #[allow(clippy::upper_case_acronyms)]
    pub enum Interrupt {
        /// Receiver and sender.
        UART0 = 42,
        /// The interrupt of an unused line: for turns.
        SPARE = 43,
    }

    pub use Interrupt as interrupt;

    // SAFETY: the numbers are those of the chip.
    unsafe impl InterruptNumber for Interrupt {
        fn number(self) -> u16 {
            self as u16
        }
    }

    /// No peripherals to take: registers are accessed by their addresses.
    pub struct Peripherals;

    impl Peripherals {
        /// Called once, before anything runs.
        pub const unsafe fn steal() -> Self {
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

/// This board.
pub struct An505;

impl Board for An505 {
    type Chip = chip::Peripherals;
    type Memory = ();
    type Clock = Clock;
    type Device = NoDevice;
    type Uart = Uart;
    type Usb = ();
    type Watchdog = NoWatchdog;

    const SETUP: Setup = Setup {
        name: "mps2-an505",
        line_rate: BAUD / 10,
        fastest_tick: speed::FASTEST_TICK,
        work_rate: speed::WORK_RATE,
        ..work::SETUP
    };
    /// 11 ms.
    const ROOM: usize = 1_024;
    const MEMORY: () = ();

    fn start(_: chip::Peripherals, core: cortex_m::Peripherals, (): &mut ()) -> PartsOf<Self> {
        Parts {
            uart: Uart::start(),
            usb: (),
            clock: Clock::start(core.SYST, Self::SETUP.mode.tick_rate),
            watchdog: NoWatchdog,
            device: NO_DEVICE,
        }
    }

    fn actuators_off() {}
}

fn read(at: usize) -> u32 {
    // SAFETY: all addresses here are those of registers; reading one has only the side effects of that register.
    unsafe { with_exposed_provenance::<u32>(at).read_volatile() }
}

fn write(at: usize, value: u32) {
    // SAFETY: all addresses here are those of registers, which change no memory.
    unsafe { with_exposed_provenance_mut::<u32>(at).write_volatile(value) };
}

/// Ticks, and time from a counter of its own: SysTick alone does not show how many ticks were missed.
pub struct Clock {
    systick: SYST,
    rate: u16,
    elapsed: Elapsed,
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
            elapsed: Elapsed::since(Self::count()),
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
}

impl Ticks for Clock {
    /// From now on, at least 2.
    fn set_rate(&mut self, rate: u16) {
        if rate != self.rate {
            self.rate = rate;
            let counts = COUNTS / u32::from(rate.max(2));
            self.systick.set_reload(counts.saturating_sub(1));
            self.systick.clear_current();
        }
    }

    /// There must be one within 200 s.
    fn tick(&mut self) -> u32 {
        self.elapsed.us(Self::count(), PER_US)
    }
}

impl line::Clock for Clock {
    fn now_ns(&mut self) -> u32 {
        self.elapsed.ns(Self::count(), PER_US)
    }
}

/// The serial line.
pub struct Uart;

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
}

impl Port for Uart {
    /// A byte in, a byte out, after which the line requests an interrupt again.
    fn serve<const N: usize>(&mut self, line: &Line<N>) {
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
pub struct NoWatchdog;

impl Watchdog for NoWatchdog {
    fn feed(&mut self) {}
}
