//! RP2040: UART0 at 921600 baud, GP0 out and GP1 in; the crystal has 12 MHz.

use core::cell::RefCell;

use critical_section::Mutex;
use rp2040_hal::clocks::{Clock as _, init_clocks_and_plls};
use rp2040_hal::fugit::{ExtU32, RateExtU32};
use rp2040_hal::gpio::bank0::{Gpio0, Gpio1};
use rp2040_hal::gpio::{FunctionUart, Pin, Pins, PullDown};
use rp2040_hal::pac::{self, Interrupt, UART0, interrupt};
use rp2040_hal::uart::{DataBits, Enabled, StopBits, UartConfig, UartPeripheral};
use rp2040_hal::{Sio, Timer, Watchdog};

use crate::LINE;
use crate::setup::BAUD;

pub(crate) use rp2040_hal::entry;

/// The second boot stage: it lets the chip run code from its flash.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

type Out = Pin<Gpio0, FunctionUart, PullDown>;
type In = Pin<Gpio1, FunctionUart, PullDown>;
type Port = UartPeripheral<Enabled, UART0, (Out, In)>;

static PORT: Mutex<RefCell<Option<Port>>> = Mutex::new(RefCell::new(None));

/// Starts everything: the timer and the watchdog, which must be fed every 20 ms.
pub(crate) fn start() -> (Timer, Watchdog) {
    let Some(mut chip) = pac::Peripherals::take() else {
        loop {}
    };
    let mut watchdog = Watchdog::new(chip.WATCHDOG);
    let Ok(clocks) = init_clocks_and_plls(
        12_000_000,
        chip.XOSC,
        chip.CLOCKS,
        chip.PLL_SYS,
        chip.PLL_USB,
        &mut chip.RESETS,
        &mut watchdog,
    ) else {
        loop {}
    };
    let bank = Sio::new(chip.SIO).gpio_bank0;
    let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, bank, &mut chip.RESETS);
    let pins = (pins.gpio0.into_function(), pins.gpio1.into_function());
    let config = UartConfig::new(BAUD.Hz(), DataBits::Eight, None, StopBits::One);
    let port = UartPeripheral::new(chip.UART0, pins, &mut chip.RESETS);
    let Ok(mut port) = port.enable(config, clocks.peripheral_clock.freq()) else {
        loop {}
    };
    port.set_fifos(true);
    port.enable_rx_interrupt();
    critical_section::with(|cs| PORT.replace(cs, Some(port)));
    // SAFETY: the handler shares only data behind critical sections.
    unsafe { pac::NVIC::unmask(Interrupt::UART0_IRQ) };
    watchdog.start(20.millis());
    let timer = Timer::new(chip.TIMER, &mut chip.RESETS, &clocks);
    (timer, watchdog)
}

/// The time (wrapping).
pub(crate) fn now_us(timer: &Timer) -> u32 {
    timer.get_counter_low()
}

/// There is something to send.
pub(crate) fn wake() {
    pac::NVIC::pend(Interrupt::UART0_IRQ);
}

#[interrupt]
fn UART0_IRQ() {
    critical_section::with(|cs| {
        if let Some(port) = PORT.borrow_ref_mut(cs).as_mut() {
            LINE.serve(port);
            if LINE.has_to_send() {
                port.enable_tx_interrupt();
            } else {
                port.disable_tx_interrupt();
            }
        }
    });
}
