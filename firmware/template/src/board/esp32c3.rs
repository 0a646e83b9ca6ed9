//! ESP32-C3: UART0 at 921600 baud, GPIO21 out and GPIO20 in, as on most boards.

use core::cell::RefCell;

use critical_section::Mutex;
use esp_hal::clock::CpuClock;
use esp_hal::peripherals::TIMG0;
use esp_hal::time::{Duration, Instant};
use esp_hal::timer::timg::{MwdtStage, Wdt};
use esp_hal::uart::{Config, Uart, UartInterrupt};
use esp_hal::{Blocking, handler};

use crate::LINE;
use crate::setup::BAUD;

pub(crate) use esp_hal::main as entry;

esp_bootloader_esp_idf::esp_app_desc!();

static PORT: Mutex<RefCell<Option<Uart<'static, Blocking>>>> = Mutex::new(RefCell::new(None));

/// Starts everything: the timer, and the watchdog, which must be fed every 20 ms.
pub(crate) fn start() -> ((), Wdt<TIMG0<'static>>) {
    let chip = esp_hal::init(esp_hal::Config::default().with_cpu_clock(CpuClock::max()));
    let Ok(port) = Uart::new(chip.UART0, Config::default().with_baudrate(BAUD)) else {
        loop {}
    };
    let mut port = port.with_rx(chip.GPIO20).with_tx(chip.GPIO21);
    port.set_interrupt_handler(serial);
    port.listen(UartInterrupt::RxFifoFull | UartInterrupt::RxTimeout);
    critical_section::with(|cs| PORT.replace(cs, Some(port)));
    let mut watchdog = Wdt::new();
    watchdog.set_timeout(MwdtStage::Stage0, Duration::from_millis(20));
    watchdog.enable();
    ((), watchdog)
}

/// The time (wrapping). The caller has time to send: the line has no interrupt for that.
pub(crate) fn now_us(_: &()) -> u32 {
    wake();
    Instant::now().duration_since_epoch().as_micros() as u32
}

/// Takes the bytes that arrived, and sends as many as the line has room for.
pub(crate) fn wake() {
    critical_section::with(|cs| {
        if let Some(port) = PORT.borrow_ref_mut(cs).as_mut() {
            port.clear_interrupts(UartInterrupt::RxFifoFull | UartInterrupt::RxTimeout);
            LINE.serve(port);
        }
    });
}

#[handler]
fn serial() {
    wake();
}
