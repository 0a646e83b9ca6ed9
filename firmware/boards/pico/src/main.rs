//! stiction on the Raspberry Pi Pico: in this folder `cargo run` flashes the board.
//!
//! ```text
//! priority 4  UART0    bytes in and out, by bounded queues; 32 bytes wait in the receiver, 350 µs
//! priority 3  TIMER    the tick: hand measured -> safety -> force
//! priority 2  RTC      a turn: bytes -> samples, commands -> solver -> demand of a force, reports -> bytes
//! priority 1  USB      packets in and out, by bounded queues; the computer waits during a turn
//! idle                 logs
//! ```
//!
//! One core does everything: no tick waits for USB or the solver, as it interrupts them; nor does a turn wait for USB, whose interrupt
//! stays pending as long as there is no room for a packet. The line is USB while a program has it open there, otherwise UART.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
mod flash;
#[cfg(target_os = "none")]
#[path = "../../log.rs"]
mod log;
#[cfg(target_os = "none")]
mod rp;
#[cfg(target_os = "none")]
#[path = "../../stop.rs"]
mod stop;
#[cfg(target_os = "none")]
#[path = "../../work.rs"]
mod work;

#[cfg(target_os = "none")]
use rp2040_hal as hal;

/// Not for this machine.
#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("an image for a board: type cargo run in firmware/boards/pico");
    std::process::exit(2);
}

#[cfg(target_os = "none")]
#[rtic::app(device = crate::hal::pac, peripherals = true)]
mod app {
    use crate::board::{self, Board};
    use crate::hal::pac::Interrupt;
    use crate::rp::uart::{self, Uart};
    use crate::rp::usb::{self, Bus, Usb};
    use crate::rp::{LIMITS, PASSIVITY};
    use crate::work::{self, CompiledScene, SCENE, SharedClock, SharedServo, Work};
    use stiction_firmware::line::Line;
    use stiction_firmware::speed::Processor;
    use stiction_firmware::station::{SceneType, Setup};
    use stiction_wire::Mode;

    /// Units of work per second; a quarter of the time is reserved for the interrupts of two lines and the rest of a tick.
    const WORK_RATE: u32 = Processor::CORTEX_M0_PLUS.work_rate(board::CLOCK, 6);

    static SETUP: Setup = Setup {
        name: "pico",
        number: CompiledScene::NUMBER,
        line_rate: uart::BAUD / 10,
        fastest_tick: 2_000,
        work_rate: WORK_RATE,
        limits: LIMITS,
        passivity: PASSIVITY,
        mode: Mode::DEFAULT,
        scene: SCENE,
    };

    /// Bytes that wait, in each direction: 11 ms.
    const ROOM: usize = 1_024;

    static UART: Line<ROOM> = Line::new();
    static USB: Line<ROOM> = Line::new();

    #[shared]
    struct Shared {
        clock: SharedClock,
        servo: SharedServo,
    }

    #[local]
    struct Local {
        uart: Uart,
        usb: Usb,
        work: Work,
    }

    #[init(local = [bus: Bus = Bus::new()])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let program = work::program(&SETUP);
        let Board {
            uart,
            usb,
            clock,
            servo,
            watchdog,
        } = Board::start(cx.device, cx.local.bus, SETUP.mode.tick_rate);
        let work = Work { program, watchdog };
        (Shared { clock, servo }, Local { uart, usb, work })
    }

    /// The most urgent work first.
    #[task(binds = UART0_IRQ, priority = 4, local = [uart])]
    fn serial(cx: serial::Context) {
        cx.local.uart.serve(&UART);
    }

    #[task(binds = USBCTRL_IRQ, priority = 1, local = [usb])]
    fn packets(cx: packets::Context) {
        cx.local.usb.serve(&USB);
    }

    #[task(binds = TIMER_IRQ_0, priority = 3, shared = [clock, servo])]
    fn tick(cx: tick::Context) {
        work::tick(cx.shared.clock, cx.shared.servo);
        rtic::pend(Interrupt::RTC_IRQ);
    }

    /// By the interrupt of the calendar, which nothing else uses. Those for programs only, SW0 to SW5, are missing in the emulator.
    #[task(binds = RTC_IRQ, priority = 2, shared = [clock, servo], local = [work])]
    fn turn(cx: turn::Context) {
        let turn::SharedResources { clock, servo, .. } = cx.shared;
        let (line, wake): (_, fn()) = if usb::is_open() {
            (&USB, || rtic::pend(Interrupt::USBCTRL_IRQ))
        } else {
            (&UART, || rtic::pend(Interrupt::UART0_IRQ))
        };
        cx.local.work.turn(clock, servo, line, wake);
    }

    #[idle]
    fn idle(_: idle::Context) -> ! {
        let lost = || UART.lost().saturating_add(USB.lost());
        // A debugger can read the memory of this chip during sleep, too.
        work::log(&SETUP, lost, cortex_m::asm::wfi)
    }
}
