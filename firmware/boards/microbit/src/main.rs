//! stiction on the BBC micro:bit: in this folder `cargo run` flashes the board, `cargo emulate` starts QEMU.
//!
//! ```text
//! priority 3  UART0    a byte in, a byte out, by bounded queues; 6 bytes wait in the receiver, 0.5 ms
//! priority 2  TIMER0   the tick: hand measured -> safety -> force
//! priority 1  SWI0     a turn: bytes -> samples, commands -> solver -> demand of a force, reports -> bytes
//! idle                 logs
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
#[path = "../../log.rs"]
mod log;
#[cfg(target_os = "none")]
#[path = "../../stop.rs"]
mod stop;
#[cfg(target_os = "none")]
#[path = "../../work.rs"]
mod work;

/// Not for this machine.
#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("an image for a board: type cargo run in firmware/boards/microbit");
    std::process::exit(2);
}

#[cfg(target_os = "none")]
#[rtic::app(device = nrf51_hal::pac, peripherals = true)]
mod app {
    use crate::board::{self, Board, Uart};
    use crate::work::{self, CompiledScene, SCENE, SharedClock, SharedServo, Work};
    use nrf51_hal::pac::Interrupt;
    use stiction_core::Evolution;
    use stiction_firmware::line::Line;
    use stiction_firmware::safety::Limits;
    use stiction_firmware::speed::Processor;
    use stiction_firmware::station::{SceneType, Setup};
    use stiction_wire::Mode;

    /// Ticks per second.
    const RATE: u16 = 200;
    /// Units of work per second; half of the time is reserved for the interrupts of the line and the rest of a tick.
    const WORK_RATE: u32 = Processor::CORTEX_M0.work_rate(board::CLOCK, 4);

    static SETUP: Setup = Setup {
        name: "microbit",
        number: CompiledScene::NUMBER,
        line_rate: board::BAUD / 10,
        fastest_tick: 500,
        work_rate: WORK_RATE,
        limits: Limits::DEFAULT,
        passivity: None,
        mode: Mode {
            evolution: Evolution::Frame,
            tick_rate: RATE,
            ..Mode::DEFAULT
        },
        scene: SCENE,
    };

    /// Bytes that wait, in each direction: 22 ms.
    const ROOM: usize = 256;

    static LINE: Line<ROOM> = Line::new();

    #[shared]
    struct Shared {
        clock: SharedClock,
        servo: SharedServo,
    }

    #[local]
    struct Local {
        uart: Uart,
        work: Work,
    }

    #[init]
    fn init(cx: init::Context) -> (Shared, Local) {
        let program = work::program(&SETUP);
        let Board {
            uart,
            clock,
            servo,
            watchdog,
        } = Board::start(cx.device, SETUP.mode.tick_rate);
        let work = Work { program, watchdog };
        (Shared { clock, servo }, Local { uart, work })
    }

    /// The most urgent work first.
    #[task(binds = UART0, priority = 3, local = [uart])]
    fn serial(cx: serial::Context) {
        cx.local.uart.serve(&LINE);
    }

    #[task(binds = TIMER0, priority = 2, shared = [clock, servo])]
    fn tick(cx: tick::Context) {
        work::tick(cx.shared.clock, cx.shared.servo);
        rtic::pend(Interrupt::SWI0);
    }

    /// By an interrupt that nothing else uses.
    #[task(binds = SWI0, priority = 1, shared = [clock, servo], local = [work])]
    fn turn(cx: turn::Context) {
        let turn::SharedResources { clock, servo, .. } = cx.shared;
        let wake = || rtic::pend(Interrupt::UART0);
        cx.local.work.turn(clock, servo, &LINE, wake);
    }

    #[idle]
    fn idle(_: idle::Context) -> ! {
        // No sleep: during sleep a debugger receives no log, and the emulator's clock skips ticks.
        work::log(&SETUP, || LINE.lost(), || {})
    }
}
