//! STM32F405: USART2 at 921600 baud, PA2 out and PA3 in; the crystal has 8 MHz.

use core::cell::RefCell;

use cortex_m::peripheral::NVIC;
use critical_section::Mutex;
use embedded_hal_nb::serial::{Read, Write};
use stm32f4xx_hal::pac::{self, Interrupt, TIM5, USART2, interrupt};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::Config;
use stm32f4xx_hal::serial::{self, Rx, RxListen, Tx, TxISR, TxListen};
use stm32f4xx_hal::timer::CounterUs;
use stm32f4xx_hal::watchdog::IndependentWatchdog;

use crate::LINE;
use crate::setup::BAUD;

pub(crate) use cortex_m_rt::entry;

type Port = (Tx<USART2>, Rx<USART2>);

static PORT: Mutex<RefCell<Option<Port>>> = Mutex::new(RefCell::new(None));

pub(crate) type Timer = CounterUs<TIM5>;

/// Starts everything: the timer and the watchdog, which must be fed every 20 ms.
pub(crate) fn start() -> (Timer, IndependentWatchdog) {
    let Some(chip) = pac::Peripherals::take() else {
        loop {}
    };
    let config = Config::hse(8.MHz()).sysclk(168.MHz()).pclk1(42.MHz());
    let mut rcc = chip.RCC.freeze(config);
    let mut timer = chip.TIM5.counter_us(&mut rcc);
    let pins = chip.GPIOA.split(&mut rcc);
    let config = serial::Config::default().baudrate(BAUD.bps());
    let port = chip.USART2.serial((pins.pa2, pins.pa3), config, &mut rcc);
    let (Ok(port), Ok(())) = (port, timer.start(u32::MAX.micros())) else {
        loop {}
    };
    let (tx, mut rx) = port.split();
    rx.listen();
    critical_section::with(|cs| PORT.replace(cs, Some((tx, rx))));
    // SAFETY: the handler shares only data behind critical sections.
    unsafe { NVIC::unmask(Interrupt::USART2) };
    let mut watchdog = IndependentWatchdog::new(chip.IWDG);
    watchdog.start(20.millis());
    (timer, watchdog)
}

/// The time (wrapping).
pub(crate) fn now_us(timer: &Timer) -> u32 {
    timer.now().ticks()
}

/// There is something to send.
pub(crate) fn wake() {
    NVIC::pend(Interrupt::USART2);
}

/// A byte in, a byte out: this HAL uses an older embedded-io, and therefore transfers byte by byte.
#[interrupt]
fn USART2() {
    critical_section::with(|cs| {
        let mut port = PORT.borrow_ref_mut(cs);
        let Some((tx, rx)) = port.as_mut() else {
            return;
        };
        match rx.read() {
            Ok(byte) => LINE.receive(byte),
            Err(nb::Error::WouldBlock) => {}
            Err(nb::Error::Other(_)) => LINE.lose(),
        }
        if tx.is_tx_empty()
            && let Some(byte) = LINE.next()
        {
            let _ = tx.write(byte);
        }
        if LINE.has_to_send() {
            tx.listen();
        } else {
            tx.unlisten();
        }
    });
}
