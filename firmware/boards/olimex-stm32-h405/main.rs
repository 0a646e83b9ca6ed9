//! stiction on the Olimex STM32-H405: in this folder `cargo load` flashes it, `cargo emulate` starts QEMU.
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
#![no_std]
#![no_main]
#![allow(unsafe_code)]

#[cfg(feature = "pantograph")]
mod pantograph;

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use embedded_hal_nb::serial::{Read, Write};
use stiction_boards::elapsed::Elapsed;
use stiction_boards::work;
use stiction_boards::{Board, Parts, PartsOf, Port, Ticks, Watchdog, stop};
#[cfg(feature = "pantograph")]
use stiction_boards::{Joints, Tracks};
#[cfg(feature = "pantograph")]
use stiction_firmware::devices::pantograph::{LIMITS, TURN_F405_US, passivity};
use stiction_firmware::line::{self, Line};
use stiction_firmware::speed::Processor;
use stiction_firmware::station::Setup;
use stm32f4xx_hal::gpio::{PA2, PA3};
use stm32f4xx_hal::pac::{self, TIM1, TIM5, USART2};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::{Config, Enable, Rcc};
use stm32f4xx_hal::serial::{self, Rx, RxISR, RxListen, Tx, TxISR, TxListen};
use stm32f4xx_hal::watchdog::IndependentWatchdog;

// A byte stays in the receiver for 11 µs: its interrupt has some 50 instructions.
stiction_boards::app! {
    board: Olimex,
    chip: stm32f4xx_hal::pac,
    serial: USART2 at 3,
    tick: SysTick at 2,
    turn: EXTI0 at 1,
}

const BAUD: u32 = 921_600;
/// Clock of the core (Hz).
const CORE: u32 = 168_000_000;
/// Counts of TIM5 per µs: on the chip, and in QEMU, whose timers run at 1 GHz regardless of their clock.
const COUNTS: (u32, u32) = (84, 1_000);
/// A tick that does not come for this long ends in a reset (ms), within 50 % because of the watchdog's oscillator: the slowest tick is one
/// of 10 ms. A reset means zero force: all pins are inputs then.
const PATIENCE_MS: u32 = 20;

/// This board.
pub struct Olimex;

impl Board for Olimex {
    type Chip = pac::Peripherals;
    type Memory = ();
    type Clock = Clock;
    #[cfg(not(feature = "pantograph"))]
    type Device = work::NoDevice;
    #[cfg(feature = "pantograph")]
    type Device = pantograph::Device;
    type Uart = Uart;
    type Usb = ();
    type Watchdog = Iwdg;

    const SETUP: Setup = Setup {
        name: "olimex-stm32-h405",
        line_rate: BAUD / 10,
        fastest_tick: 5_000,
        // An eighth of the time is reserved for the interrupts of the line.
        work_rate: Processor::CORTEX_M4F.work_rate(CORE, 7),
        #[cfg(feature = "pantograph")]
        limits: LIMITS,
        #[cfg(feature = "pantograph")]
        passivity: Some(passivity(TURN_F405_US)),
        ..work::SETUP
    };
    /// 11 ms.
    const ROOM: usize = 1_024;
    const MEMORY: () = ();

    fn start(chip: pac::Peripherals, core: cortex_m::Peripherals, (): &mut ()) -> PartsOf<Self> {
        let mut systick = core.SYST;
        prime(&chip.RCC);
        let config = Config::hse(8.MHz())
            .sysclk(CORE.Hz())
            .pclk1(42.MHz())
            .pclk2(84.MHz());
        let mut rcc = chip.RCC.freeze(config);

        TIM5::enable(&mut rcc);
        chip.TIM5.cr1().modify(|_, w| w.cen().set_bit());

        systick.set_clock_source(SystClkSource::Core);
        let clock = Clock::start(chip.TIM5, systick, Self::SETUP.mode.tick_rate);

        let a = chip.GPIOA.split(&mut rcc);
        let uart = Uart::start(chip.USART2, (a.pa2, a.pa3), &mut rcc);

        #[cfg(not(feature = "pantograph"))]
        let device = work::NO_DEVICE;
        #[cfg(feature = "pantograph")]
        let device = {
            let b = chip.GPIOB.split(&mut rcc);
            let parts = pantograph::Wired {
                counters: Joints {
                    left: chip.TIM2,
                    right: chip.TIM3,
                    handle: chip.TIM4,
                },
                encoders: Joints {
                    left: Tracks { a: a.pa5, b: a.pa1 },
                    right: Tracks { a: a.pa6, b: a.pa7 },
                    handle: Tracks { a: b.pb6, b: b.pb7 },
                },
                hold: b.pb15,
                pwm: chip.TIM1,
                duties: Joints {
                    left: a.pa8,
                    right: a.pa9,
                    handle: a.pa10,
                },
                directions: Joints {
                    left: b.pb12,
                    right: b.pb13,
                    handle: b.pb14,
                },
            };
            match parts.start(&mut rcc) {
                Ok(device) => device,
                Err(_) => stop(),
            }
        };

        let mut watchdog = IndependentWatchdog::new(chip.IWDG);
        watchdog.start(PATIENCE_MS.millis());
        #[cfg(feature = "pantograph")]
        actuators_on();
        Parts {
            uart,
            usb: (),
            clock,
            device,
            watchdog: Iwdg(watchdog),
        }
    }

    fn actuators_off() {
        // SAFETY: bits of a timer that nothing else needs from now on: main output enable, by program and automatic.
        unsafe {
            (*TIM1::ptr())
                .bdtr()
                .modify(|_, w| w.aoe().clear_bit().moe().clear_bit());
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
pub struct Clock {
    systick: SYST,
    rate: u16,
    timer: TIM5,
    per_us: u32,
    elapsed: Elapsed,
}

impl Clock {
    /// Determines which of the two speeds the counter has, within two ticks; then the ticks become interrupts.
    fn start(timer: TIM5, systick: SYST, rate: u16) -> Self {
        let mut clock = Self {
            systick,
            rate: 0,
            per_us: 1,
            elapsed: Elapsed::since(0),
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
        clock.elapsed = Elapsed::since(clock.count());
        clock.systick.enable_interrupt();
        clock
    }

    fn wrapped(&mut self) {
        while !self.systick.has_wrapped() {}
    }

    fn count(&self) -> u32 {
        self.timer.cnt().read().bits()
    }
}

impl Ticks for Clock {
    /// From now on, at least 11.
    fn set_rate(&mut self, rate: u16) {
        if rate != self.rate {
            self.rate = rate;
            self.systick
                .set_reload((CORE / u32::from(rate.max(11))).saturating_sub(1));
            self.systick.clear_current();
        }
    }

    /// There must be one within 4 s.
    fn tick(&mut self) -> u32 {
        self.elapsed.us(self.count(), self.per_us)
    }
}

impl line::Clock for Clock {
    fn now_ns(&mut self) -> u32 {
        self.elapsed.ns(self.count(), self.per_us)
    }
}

/// The serial line.
pub struct Uart {
    tx: Tx<USART2>,
    rx: Rx<USART2>,
}

impl Port for Uart {
    /// A byte in, a byte out.
    fn serve<const N: usize>(&mut self, line: &Line<N>) {
        if self.rx.is_rx_not_empty() {
            self.receive(line);
        }
        self.send(line);
    }
}

impl Uart {
    fn start(usart: USART2, pins: (PA2, PA3), rcc: &mut Rcc) -> Self {
        let config = serial::Config::default().baudrate(BAUD.bps());
        // 42 MHz is fast enough for it.
        let Ok(line) = usart.serial(pins, config, rcc) else {
            stop()
        };
        let (tx, mut rx) = line.split();
        rx.listen();
        Self { tx, rx }
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

/// The watchdog.
pub struct Iwdg(IndependentWatchdog);

impl Watchdog for Iwdg {
    fn feed(&mut self) {
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
