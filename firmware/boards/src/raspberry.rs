//! The common part of the boards with a Raspberry Pi chip, RP2040 and RP2350: their crates are almost the same. The differences of the chips
//! are in [`chip`] and in each board's own files: boot, speed, and the source of the board's number.
//!
//! | what | where |
//! |---|---|
//! | serial line, 921600 8N1 | UART0: GP0 out, GP1 in |
//! | serial line over USB | the board's USB |
//! | ticks and clock | a timer, 1 MHz |
//! | motors | none, or those of the feature `knob` or `pantograph`; no pin but GP0 drives anything when it stops |
//!
//! The pins of a device are in `pins.rs`.
//!
//! One core does everything: no tick waits for USB or the solver, as it interrupts them; nor does a turn wait for USB, whose interrupt stays
//! pending as long as there is no room for a packet. 32 bytes wait in the receiver of the serial line, 350 µs.

pub mod clock;
#[cfg(any(feature = "knob", feature = "pantograph"))]
mod encoder;
#[cfg(feature = "knob")]
mod flash;
#[cfg(feature = "knob")]
mod knob;
#[cfg(any(feature = "knob", feature = "pantograph"))]
mod motor;
#[cfg(not(any(feature = "knob", feature = "pantograph")))]
mod no_device;
#[cfg(feature = "pantograph")]
mod pantograph;
pub mod pins;
pub mod uart;
pub mod usb;

use fugit::ExtU32;
use hal::Sio;
use hal::clocks::{Clock as _, init_clocks_and_plls};
use hal::gpio::Pins;
use hal::uart::UartPeripheral;
use hal::usb::UsbBus;
use hal::{fugit, pac};
use stiction_firmware::station::Setup;
#[cfg(feature = "knob")]
use stiction_wire::KnobNumbers;

use crate::{Board, Parts, PartsOf, Watchdog, stop, work};

pub use chip::hal;
use clock::Clock;
use uart::Uart;
use usb::{Memory, NUMBER, Usb};

#[cfg(feature = "knob")]
use knob as device;
#[cfg(not(any(feature = "knob", feature = "pantograph")))]
use no_device as device;
#[cfg(feature = "pantograph")]
use pantograph as device;

pub use device::Device;
use device::numbers;

/// The differences of the chips.
#[cfg(feature = "pico")]
pub mod chip {
    pub(super) use hal::Timer;
    pub(super) use hal::timer::Alarm0 as Alarm;
    /// The crate of the chip.
    pub use rp2040_hal as hal;
    pub(super) use stiction_firmware::usb::PICO as PRODUCT_ID;

    /// Clock of the processor (Hz).
    pub const CLOCK: u32 = 125_000_000;
    /// The name of the board on USB.
    pub(super) const PRODUCT: &str = "stiction on Pico";
}

/// The differences of the chips.
#[cfg(feature = "pico2")]
pub mod chip {
    use hal::timer::{Alarm0, CopyableTimer0};
    /// The crate of the chip.
    pub use rp235x_hal as hal;
    pub(super) use stiction_firmware::usb::PICO_2 as PRODUCT_ID;

    pub(super) type Timer = hal::Timer<CopyableTimer0>;
    pub(super) type Alarm = Alarm0<CopyableTimer0>;

    /// Clock of the processor (Hz).
    pub const CLOCK: u32 = crate::speed::PICO_2;
    /// The name of the board on USB.
    pub(super) const PRODUCT: &str = "stiction on Pico 2";
}

/// Frequency of the crystal (Hz).
const CRYSTAL: u32 = 12_000_000;
/// A tick that does not come for this long ends in a reset (ms).
const PATIENCE: u32 = 20;

/// In which these boards differ, besides [`chip`].
pub trait Pico {
    /// The name on the wire.
    const NAME: &str;
    /// The highest tick rate (Hz).
    const FASTEST_TICK: u16;
    /// Units of work per second.
    const WORK_RATE: u32;

    /// The unique number of the board. Called before any interrupt comes.
    fn number() -> [u8; NUMBER];
}

impl<B: Pico> Board for B {
    type Chip = pac::Peripherals;
    type Memory = Memory;
    type Clock = Clock;
    type Device = Device;
    type Uart = Uart;
    type Usb = Usb;
    type Watchdog = Dog;

    const SETUP: Setup = Setup {
        name: B::NAME,
        line_rate: uart::BAUD / 10,
        fastest_tick: B::FASTEST_TICK,
        work_rate: B::WORK_RATE,
        limits: numbers::LIMITS,
        passivity: device::PASSIVITY,
        ..work::SETUP
    };
    /// 11 ms.
    const ROOM: usize = 1_024;
    const MEMORY: Memory = Memory::EMPTY;

    fn start(
        chip: pac::Peripherals,
        _: cortex_m::Peripherals,
        memory: &'static mut Memory,
    ) -> PartsOf<Self> {
        start(chip, memory, &Self::SETUP, B::number)
    }

    #[cfg(feature = "knob")]
    fn setup(described: &'static Setup) -> &'static Setup {
        knob::setup(described)
    }

    #[cfg(feature = "knob")]
    fn restart_with(numbers: &KnobNumbers, watchdog: &mut Dog) -> ! {
        Self::actuators_off();
        flash::store(numbers, &mut watchdog.0)
    }

    /// No pin except the serial line drives anything any more.
    #[allow(unsafe_code)]
    fn actuators_off() {
        // SAFETY: one field of each register, whatever a task was doing with it.
        let pins = unsafe { &*pac::IO_BANK0::ptr() };
        // GP0 belongs to the line.
        for pin in pins.gpio_iter().skip(1) {
            pin.gpio_ctrl().modify(|_, w| w.funcsel().null());
        }
    }

    /// Sleeps: a debugger can read the memory of these chips during sleep, too.
    fn rest() {
        cortex_m::asm::wfi();
    }
}

fn start(
    mut chip: pac::Peripherals,
    memory: &'static mut Memory,
    described: &Setup,
    number: fn() -> [u8; NUMBER],
) -> Parts<Clock, Device, Uart, Usb, Dog> {
    let mut watchdog = hal::Watchdog::new(chip.WATCHDOG);
    let clocks = init_clocks_and_plls(
        CRYSTAL,
        chip.XOSC,
        chip.CLOCKS,
        chip.PLL_SYS,
        chip.PLL_USB,
        &mut chip.RESETS,
        &mut watchdog,
    );
    let Ok(clocks) = clocks else { stop() };
    // The budget of a step relies on the frequency that the crate derives from the crystal.
    if clocks.system_clock.freq().to_Hz() != chip::CLOCK {
        stop()
    }
    let (sio, resets) = (Sio::new(chip.SIO), &mut chip.RESETS);
    let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, sio.gpio_bank0, resets);
    #[cfg(feature = "pico")]
    let (timer, registers, packets) = (
        chip::Timer::new(chip.TIMER, resets, &clocks),
        chip.USBCTRL_REGS,
        chip.USBCTRL_DPRAM,
    );
    #[cfg(feature = "pico2")]
    let (timer, registers, packets) = (
        chip::Timer::new_timer0(chip.TIMER0, resets, &clocks),
        chip.USB,
        chip.USB_DPRAM,
    );
    let (line, pins) = pins::split(pins);
    let uart = UartPeripheral::new(chip.UART0, line, resets);
    let uart = Uart::new(uart, &clocks);
    let bus = UsbBus::new(registers, packets, clocks.usb_clock, true, resets);
    let wired = Wired {
        pio: chip.PIO0,
        pwm: chip.PWM,
        pins,
        resets,
        was_reset: Dog::has_reset(),
        described,
    };
    let Ok(device) = device::start(wired) else {
        stop()
    };
    Parts {
        uart,
        usb: Usb::start(memory, bus, number()),
        clock: Clock::new(timer, described.mode.tick_rate),
        device,
        watchdog: Dog::start(watchdog),
    }
}

// A device uses a part of it.
#[allow(dead_code)]
struct Wired<'a> {
    pio: pac::PIO0,
    pwm: pac::PWM,
    pins: pins::DevicePins,
    resets: &'a mut pac::RESETS,
    /// The watchdog has reset the board since it was switched on.
    was_reset: bool,
    /// The board without what it has stored.
    described: &'a Setup,
}

/// The watchdog.
pub struct Dog(hal::Watchdog);

impl Dog {
    /// Returns whether it has reset the board since that was switched on, or was reset by hand.
    #[allow(unsafe_code)]
    fn has_reset() -> bool {
        // SAFETY: a read-only register.
        let reason = unsafe { &*pac::WATCHDOG::ptr() }.reason().read();
        reason.bits() != 0
    }

    fn start(mut watchdog: hal::Watchdog) -> Self {
        watchdog.start(PATIENCE.millis());
        Self(watchdog)
    }
}

impl Watchdog for Dog {
    fn feed(&mut self) {
        self.0.feed();
    }
}
