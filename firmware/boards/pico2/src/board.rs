//! The RP2350 of the board, its Arm cores; its pins are defined in `rp`.
// For the section that the ROM looks for.
#![allow(unsafe_code)]

use crate::hal::block::ImageDef;
use crate::hal::clocks::{Clock as _, init_clocks_and_plls};
use crate::hal::gpio::Pins;
use crate::hal::rom_data::sys_info_api::chip_info;
use crate::hal::timer::{Alarm0, CopyableTimer0};
use crate::hal::uart::UartPeripheral;
use crate::hal::usb::UsbBus;
use crate::hal::{Sio, pac};
use crate::rp::uart::Uart;
use crate::rp::usb::{Bus, NUMBER, Usb};
use crate::rp::{Parts, pins};
pub(crate) use crate::speed::CLOCK;
use crate::stop::stop;
use crate::work::{SharedClock, SharedServo};

pub(crate) use crate::rp::clock::Clock;
pub(crate) use crate::rp::{Device, Watchdog, actuators_off};

/// The type of the image: the ROM of the chip runs no other (RP2350 datasheet, 5.9).
#[unsafe(link_section = ".start_block")]
#[used]
static IMAGE: ImageDef = ImageDef::secure_exe();

/// Frequency of the crystal (Hz).
const CRYSTAL: u32 = 12_000_000;
pub(crate) use stiction_firmware::usb::PICO_2 as PRODUCT_ID;
/// The name of the board on USB.
pub(crate) const PRODUCT: &str = "stiction on Pico 2";

pub(crate) type Timer = crate::hal::Timer<CopyableTimer0>;
pub(crate) type Alarm = Alarm0<CopyableTimer0>;

/// The number of the chip as its maker prints it: first its wafer. Zeros if the ROM does not return it.
fn chip_number() -> [u8; NUMBER] {
    let Ok(Some(chip)) = chip_info() else {
        return [0; NUMBER];
    };
    let number = u64::from(chip.wafer_id) << 32 | u64::from(chip.device_id);
    number.to_be_bytes()
}

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
        // The budget of a step relies on the frequency that the crate derives from the crystal.
        if clocks.system_clock.freq().to_Hz() != CLOCK {
            stop()
        }
        let sio = Sio::new(device.SIO);
        let pins = Pins::new(
            device.IO_BANK0,
            device.PADS_BANK0,
            sio.gpio_bank0,
            &mut device.RESETS,
        );
        let timer = Timer::new_timer0(device.TIMER0, &mut device.RESETS, &clocks);
        let (line, pins) = pins::split(pins);
        let uart = UartPeripheral::new(device.UART0, line, &mut device.RESETS);
        let uart = Uart::new(uart, &clocks);
        let usb = UsbBus::new(
            device.USB,
            device.USB_DPRAM,
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
            usb: Usb::start(bus, usb, chip_number()),
            clock: SharedClock(Clock::new(timer, rate)),
            servo: SharedServo::new(own),
            watchdog: Watchdog::start(watchdog),
        }
    }
}
