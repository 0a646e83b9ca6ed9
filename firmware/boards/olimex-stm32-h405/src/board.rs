//! Pins, clocks and interrupts.
//!
//! | what | where |
//! |---|---|
//! | serial line, 921600 8N1 | USART2: PA2 out, PA3 in |
//! | ticks | SysTick |
//! | clock | TIM5, 32 bits, 84 MHz |
//!
//! With the feature `pantograph`, all of them at 3.3 V; left and right as in the drawing of the mechanism:
//!
//! | what | left | right | handle |
//! |---|---|---|---|
//! | encoder, tracks A and B, pulled up | PA5, PA1 (TIM2) | PA6, PA7 (TIM3) | PB6, PB7 (TIM4) |
//! | PWM of the motor, 20 kHz, low: no torque | PA8 (TIM1) | PA9 (TIM1) | PA10 (TIM1) |
//! | direction of the motor | PB12 | PB13 | PB14 |
//!
//! The hold switch is between PB15 and ground. In a reset all pins are inputs: the motors' drivers need resistors of their own that pull
//! the PWM low.
#![allow(unsafe_code)]

#[cfg(feature = "pantograph")]
mod pantograph;

#[cfg(feature = "pantograph")]
pub(crate) use pantograph::Device;

use crate::stop::stop;
use crate::work::{SharedClock, SharedServo};
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use embedded_hal_nb::serial::{Read, Write};
#[cfg(not(feature = "pantograph"))]
use stiction_firmware::device::{FromLine, NoActuators};
use stiction_firmware::line::{self, Line};
use stm32f4xx_hal::pac::{self, TIM1, TIM5, USART2};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::{Config, Enable};
use stm32f4xx_hal::serial::{self, Rx, RxISR, RxListen, Tx, TxISR, TxListen};
use stm32f4xx_hal::watchdog::IndependentWatchdog;

/// Baud rate of the serial line.
pub(crate) const BAUD: u32 = 921_600;
/// Clock of the core (Hz).
pub(crate) const CORE: u32 = 168_000_000;
/// Counts of TIM5 per µs: on the chip, and in QEMU, whose timers run at 1 GHz regardless of their clock.
const COUNTS: (u32, u32) = (84, 1_000);
/// A tick that does not come for this long ends in a reset (ms), within 50 % because of the watchdog's oscillator: the slowest tick is one
/// of 10 ms. A reset means zero force: all pins are inputs then.
const PATIENCE_MS: u32 = 20;

/// The device of this board: none.
#[cfg(not(feature = "pantograph"))]
pub(crate) type Device = (FromLine, NoActuators);

/// The resources of the tasks.
pub(crate) struct Board {
    pub(crate) uart: Uart,
    pub(crate) clock: SharedClock,
    pub(crate) servo: SharedServo,
    pub(crate) watchdog: Watchdog,
}

impl Board {
    /// Starts everything, with this many ticks per second, and no motor driven.
    pub(crate) fn start(device: pac::Peripherals, mut systick: SYST, rate: u16) -> Self {
        prime(&device.RCC);
        let config = Config::hse(8.MHz())
            .sysclk(CORE.Hz())
            .pclk1(42.MHz())
            .pclk2(84.MHz());
        let mut rcc = device.RCC.freeze(config);

        TIM5::enable(&mut rcc);
        device.TIM5.cr1().modify(|_, w| w.cen().set_bit());

        systick.set_clock_source(SystClkSource::Core);
        let clock = Clock::start(device.TIM5, systick, rate);

        let a = device.GPIOA.split(&mut rcc);
        let config = serial::Config::default().baudrate(BAUD.bps());
        // 42 MHz is fast enough for it.
        let Ok(line) = device.USART2.serial((a.pa2, a.pa3), config, &mut rcc) else {
            stop()
        };
        let (tx, mut rx) = line.split();
        rx.listen();

        #[cfg(not(feature = "pantograph"))]
        let own = (FromLine, NoActuators);
        #[cfg(feature = "pantograph")]
        let own = {
            let b = device.GPIOB.split(&mut rcc);
            let parts = pantograph::Parts {
                counters: (device.TIM2, device.TIM3, device.TIM4),
                encoders: ((a.pa5, a.pa1), (a.pa6, a.pa7), (b.pb6, b.pb7)),
                hold: b.pb15,
                pwm: device.TIM1,
                duties: (a.pa8, a.pa9, a.pa10),
                directions: (b.pb12, b.pb13, b.pb14),
            };
            match parts.start(&mut rcc) {
                Ok(own) => own,
                Err(_) => stop(),
            }
        };

        let mut watchdog = IndependentWatchdog::new(device.IWDG);
        watchdog.start(PATIENCE_MS.millis());
        #[cfg(feature = "pantograph")]
        actuators_on();
        Self {
            uart: Uart { tx, rx },
            clock: SharedClock(clock),
            servo: SharedServo::new(own),
            watchdog: Watchdog(watchdog),
        }
    }
}

/// The emulator's clock control is plain memory, in which nothing ever becomes ready: mark it as ready from the beginning. On the chip
/// these bits are read-only.
fn prime(rcc: &pac::RCC) {
    const HSIRDY_HSERDY_PLLRDY: u32 = 1 << 1 | 1 << 17 | 1 << 25;
    const SWS_PLL: u32 = 0b10 << 2;
    // SAFETY: no reserved bit is changed.
    unsafe {
        rcc.cr()
            .modify(|r, w| w.bits(r.bits() | HSIRDY_HSERDY_PLLRDY));
        rcc.cfgr().modify(|r, w| w.bits(r.bits() | SWS_PLL));
    }
}

/// Ticks, and time from a counter of its own: SysTick alone does not show how many ticks were missed.
pub(crate) struct Clock {
    systick: SYST,
    /// Ticks per second.
    rate: u16,
    timer: TIM5,
    per_us: u32,
    last: u32,
    /// Counts that do not make up a µs yet.
    rest: u32,
    now_us: u32,
    /// The count at the last call of [`Self::now_ns`].
    looked: u32,
    now_ns: u32,
}

impl Clock {
    /// Determines which of the two speeds the counter has, within two ticks; then the ticks become interrupts.
    fn start(timer: TIM5, systick: SYST, rate: u16) -> Self {
        let mut clock = Self {
            systick,
            rate: 0,
            per_us: 1,
            last: 0,
            rest: 0,
            now_us: 0,
            looked: 0,
            now_ns: 0,
            timer,
        };
        clock.set_rate(rate);
        clock.systick.enable_counter();
        clock.wrapped();
        let begun = clock.count();
        clock.wrapped();
        let counts = clock.count().wrapping_sub(begun);
        let (chip, emulator) = COUNTS;
        let middle = (chip + emulator) / 2 * (1_000_000 / u32::from(rate.max(1)));
        clock.per_us = if counts < middle { chip } else { emulator };
        clock.last = clock.count();
        clock.looked = clock.last;
        clock.systick.enable_interrupt();
        clock
    }

    fn wrapped(&mut self) {
        while !self.systick.has_wrapped() {}
    }

    fn count(&self) -> u32 {
        self.timer.cnt().read().bits()
    }

    /// Sets the ticks per second from now on, at least 11.
    pub(crate) fn set_rate(&mut self, rate: u16) {
        if rate != self.rate {
            self.rate = rate;
            self.systick
                .set_reload((CORE / u32::from(rate.max(11))).saturating_sub(1));
            self.systick.clear_current();
        }
    }

    /// A tick has come: returns the time (µs, wrapping). There must be one within 4 s.
    pub(crate) fn tick(&mut self) -> u32 {
        let count = self.count();
        let passed = count.wrapping_sub(self.last);
        self.last = count;
        let counts = passed.saturating_add(self.rest);
        // Neither of the two speeds is 0.
        let per_us = self.per_us.max(1);
        self.rest = counts % per_us;
        self.now_us = self.now_us.wrapping_add(counts / per_us);
        self.now_us
    }
}

impl line::Clock for Clock {
    fn now_ns(&mut self) -> u32 {
        let count = self.count();
        let passed = count.wrapping_sub(self.looked).saturating_mul(1_000);
        self.looked = count;
        self.now_ns = self.now_ns.wrapping_add(passed / self.per_us.max(1));
        self.now_ns
    }
}

/// The serial line.
pub(crate) struct Uart {
    tx: Tx<USART2>,
    rx: Rx<USART2>,
}

impl Uart {
    /// A byte in, a byte out.
    pub(crate) fn serve<const N: usize>(&mut self, line: &Line<N>) {
        if self.rx.is_rx_not_empty() {
            self.receive(line);
        }
        self.send(line);
    }

    fn receive<const N: usize>(&mut self, line: &Line<N>) {
        match self.rx.read() {
            Ok(byte) => line.receive(byte),
            Err(nb::Error::WouldBlock) => {}
            // It arrived too fast.
            Err(nb::Error::Other(_)) => line.lose(),
        }
    }

    /// Sends the next byte if the line is free, and requests another call as long as there are bytes.
    fn send<const N: usize>(&mut self, line: &Line<N>) {
        if !self.tx.is_tx_empty() {
            return self.tx.listen();
        }
        match line.next() {
            // The register is empty.
            Some(byte) => {
                let _ = self.tx.write(byte);
                self.tx.listen();
            }
            None => self.tx.unlisten(),
        }
    }
}

/// Resets the chip unless it is fed.
pub(crate) struct Watchdog(IndependentWatchdog);

impl Watchdog {
    pub(crate) fn feed(&mut self) {
        self.0.feed();
    }
}

/// The outputs of the PWM follow their duties; when turned off they are low, and stay off. The driver of the PWM lets them come on again by
/// themselves with the next period.
#[cfg(feature = "pantograph")]
fn actuators_on() {
    // SAFETY: the bits of the outputs alone, and no interrupt is on yet.
    unsafe {
        (*TIM1::ptr())
            .bdtr()
            .write(|w| w.ossi().set_bit().aoe().clear_bit().moe().set_bit());
    }
}

/// No motor is driven any more, whatever else is going on.
pub(crate) fn actuators_off() {
    // SAFETY: bits of a timer that nothing else needs from now on: main output enable, by program and automatic.
    unsafe {
        (*TIM1::ptr())
            .bdtr()
            .modify(|_, w| w.aoe().clear_bit().moe().clear_bit());
    }
}
