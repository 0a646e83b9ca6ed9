//! The RP2040 of the board; its pins are defined in `rp`.
// For the section of the second boot stage.
#![allow(unsafe_code)]

use crate::flash;
use crate::hal::clocks::init_clocks_and_plls;
use crate::hal::gpio::Pins;
use crate::hal::uart::UartPeripheral;
use crate::hal::usb::UsbBus;
use crate::hal::{Sio, pac};
use crate::rp::uart::Uart;
use crate::rp::usb::{Bus, Usb};
use crate::rp::{Parts, pins};
use crate::stop::stop;
use crate::work::{SharedClock, SharedServo};

pub(crate) use crate::hal::Timer;
pub(crate) use crate::hal::timer::Alarm0 as Alarm;
pub(crate) use crate::rp::clock::Clock;
pub(crate) use crate::rp::{Device, Watchdog, actuators_off};

/// The second boot stage: it lets the chip run code from its flash.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_GENERIC_03H;

/// Frequency of the crystal (Hz).
const CRYSTAL: u32 = 12_000_000;
/// Clock of the processor (Hz).
pub(crate) const CLOCK: u32 = 125_000_000;
pub(crate) use stiction_firmware::usb::PICO as PRODUCT_ID;
/// The name of the board on USB.
pub(crate) const PRODUCT: &str = "stiction on Pico";

/// The resources of the tasks.
pub(crate) struct Board {
    pub(crate) uart: Uart,
    pub(crate) usb: Usb,
    pub(crate) clock: SharedClock,
    pub(crate) servo: SharedServo,
    pub(crate) watchdog: Watchdog,
}

impl Board {
    /// Starts everything, with this many ticks per second.
    pub(crate) fn start(mut device: pac::Peripherals, bus: &'static mut Bus, rate: u16) -> Self {
        let mut watchdog = crate::hal::Watchdog::new(device.WATCHDOG);
        let clocks = init_clocks_and_plls(
            CRYSTAL,
            device.XOSC,
            device.CLOCKS,
            device.PLL_SYS,
            device.PLL_USB,
            &mut device.RESETS,
            &mut watchdog,
        );
        let Ok(clocks) = clocks else { stop() };
        let sio = Sio::new(device.SIO);
        let pins = Pins::new(
            device.IO_BANK0,
            device.PADS_BANK0,
            sio.gpio_bank0,
            &mut device.RESETS,
        );
        let timer = Timer::new(device.TIMER, &mut device.RESETS, &clocks);
        let (line, pins) = pins::split(pins);
        let uart = UartPeripheral::new(device.UART0, line, &mut device.RESETS);
        let uart = Uart::new(uart, &clocks);
        let usb = UsbBus::new(
            device.USBCTRL_REGS,
            device.USBCTRL_DPRAM,
            clocks.usb_clock,
            true,
            &mut device.RESETS,
        );
        let own = crate::rp::start(Parts {
            pio: device.PIO0,
            pwm: device.PWM,
            pins,
            resets: &mut device.RESETS,
            was_reset: Watchdog::has_reset(),
        });
        let Ok(own) = own else { stop() };
        Self {
            uart,
            usb: Usb::start(bus, usb, flash::number(BOOT2)),
            clock: SharedClock(Clock::new(timer, rate)),
            servo: SharedServo::new(own),
            watchdog: Watchdog::start(watchdog),
        }
    }
}
