//! stiction on the Raspberry Pi Pico: in this folder `cargo load` flashes it. Its pins are defined in `src/raspberry`.
#![no_std]
#![no_main]
// For the section of the second boot stage.
#![allow(unsafe_code)]

mod flash;

use stiction_boards::raspberry::chip::CLOCK;
use stiction_boards::raspberry::usb::NUMBER;
use stiction_firmware::speed::Processor;

// The turn by the interrupt of the calendar, which nothing else uses: those for programs only, SW0 to SW5, are missing in the emulator.
stiction_boards::app! {
    board: Pico,
    chip: rp2040_hal::pac,
    serial: UART0_IRQ at 4,
    tick: TIMER_IRQ_0 at 3,
    turn: RTC_IRQ at 2,
    usb: USBCTRL_IRQ at 1,
}

/// The second boot stage: it lets the chip run code from its flash.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// This board.
pub struct Pico;

impl stiction_boards::raspberry::Pico for Pico {
    const NAME: &str = "pico";
    const FASTEST_TICK: u16 = 2_000;
    // A quarter of the time is reserved for the interrupts of two lines and the rest of a tick.
    const WORK_RATE: u32 = Processor::CORTEX_M0_PLUS.work_rate(CLOCK, 6);

    fn number() -> [u8; NUMBER] {
        flash::number(BOOT2)
    }
}
