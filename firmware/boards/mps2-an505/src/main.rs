//! stiction in place of a Raspberry Pi Pico 2: QEMU does not emulate its chip, but another one with the same processor, a Cortex-M33. It
//! runs the same program as the Pico 2, at the same rate; clock, line and pins are its own. In this folder `cargo emulate` starts it.
//!
//! ```text
//! priority 3  UART0    a byte in, a byte out, by bounded queues
//! priority 2  SysTick  the tick: hand measured -> safety -> force
//! priority 1  SPARE    a turn: bytes -> samples, commands -> solver -> demand of a force, reports -> bytes
//! idle                 logs
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
#[path = "../../log.rs"]
mod log;
#[cfg(target_os = "none")]
#[path = "../../pico2/src/speed.rs"]
mod speed;
#[cfg(target_os = "none")]
#[path = "../../stop.rs"]
mod stop;
#[cfg(target_os = "none")]
#[path = "../../work.rs"]
mod work;

/// Not for this machine.
#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("an image for an emulator: type cargo emulate in firmware/boards/mps2-an505");
    std::process::exit(2);
}

#[cfg(target_os = "none")]
#[rtic::app(device = crate::board::chip, peripherals = true)]
mod app {
    use crate::board::chip::Interrupt;
    use crate::board::{self, Board, Uart};
    use crate::speed;
    use crate::work::{self, CompiledScene, SCENE, SharedClock, SharedServo, Work};
    use stiction_firmware::line::Line;
    use stiction_firmware::safety::Limits;
    use stiction_firmware::station::{SceneType, Setup};
    use stiction_wire::Mode;

    static SETUP: Setup = Setup {
        name: "mps2-an505",
        number: CompiledScene::NUMBER,
        line_rate: board::BAUD / 10,
        fastest_tick: speed::FASTEST_TICK,
        work_rate: speed::WORK_RATE,
        limits: Limits::DEFAULT,
        passivity: None,
        mode: Mode::DEFAULT,
        scene: SCENE,
    };

    /// Bytes that wait, in each direction: 11 ms.
    const ROOM: usize = 1_024;

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
        } = Board::start(cx.core.SYST, SETUP.mode.tick_rate);
        let work = Work { program, watchdog };
        (Shared { clock, servo }, Local { uart, work })
    }

    /// The most urgent work first.
    #[task(binds = UART0, priority = 3, local = [uart])]
    fn serial(cx: serial::Context) {
        cx.local.uart.serve(&LINE);
    }

    #[task(binds = SysTick, priority = 2, shared = [clock, servo])]
    fn tick(cx: tick::Context) {
        work::tick(cx.shared.clock, cx.shared.servo);
        rtic::pend(Interrupt::SPARE);
    }

    /// By an interrupt that nothing else uses.
    #[task(binds = SPARE, priority = 1, shared = [clock, servo], local = [work])]
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
