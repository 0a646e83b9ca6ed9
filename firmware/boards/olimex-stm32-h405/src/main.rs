//! stiction on the Olimex STM32-H405: in this folder `cargo run` flashes the board, `cargo emulate` starts QEMU.
//!
//! ```text
//! priority 3  USART2   a byte in, a byte out, by bounded queues; some 50 instructions, or at 921600 baud bytes are lost
//! priority 2  SysTick  the tick: hand measured -> safety -> force
//! priority 1  EXTI0    a turn: bytes -> samples, commands -> solver -> demand of a force, reports -> bytes
//! idle                 logs
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;
#[cfg(all(target_os = "none", feature = "pantograph"))]
#[path = "../../../devices/pantograph.rs"]
mod device;
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
    eprintln!("an image for a board: type cargo run in firmware/boards/olimex-stm32-h405");
    std::process::exit(2);
}

/// No device.
#[cfg(all(target_os = "none", not(feature = "pantograph")))]
mod device {
    use stiction_firmware::safety::{Limits, Passivity};

    pub(crate) const LIMITS: Limits = Limits::DEFAULT;
    pub(crate) const PASSIVITY: Option<Passivity> = None;
}

#[cfg(target_os = "none")]
#[rtic::app(device = stm32f4xx_hal::pac, peripherals = true)]
mod app {
    use crate::board::{self, Board, Uart};
    use crate::device::{LIMITS, PASSIVITY};
    use crate::work::{self, CompiledScene, SCENE, SharedClock, SharedServo, Work};
    use stiction_firmware::line::Line;
    use stiction_firmware::speed::Processor;
    use stiction_firmware::station::{SceneType, Setup};
    use stiction_wire::Mode;
    use stm32f4xx_hal::pac::Interrupt;

    /// Units of work per second; an eighth of the time is reserved for the interrupts of the line.
    const WORK_RATE: u32 = Processor::CORTEX_M4F.work_rate(board::CORE, 7);

    static SETUP: Setup = Setup {
        name: "olimex-stm32-h405",
        number: CompiledScene::NUMBER,
        line_rate: board::BAUD / 10,
        fastest_tick: 5_000,
        work_rate: WORK_RATE,
        limits: LIMITS,
        passivity: PASSIVITY,
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
        } = Board::start(cx.device, cx.core.SYST, SETUP.mode.tick_rate);
        let work = Work { program, watchdog };
        (Shared { clock, servo }, Local { uart, work })
    }

    /// The most urgent work first: a byte stays in the receiver for 11 µs.
    #[task(binds = USART2, priority = 3, local = [uart])]
    fn serial(cx: serial::Context) {
        cx.local.uart.serve(&LINE);
    }

    #[task(binds = SysTick, priority = 2, shared = [clock, servo])]
    fn tick(cx: tick::Context) {
        work::tick(cx.shared.clock, cx.shared.servo);
        rtic::pend(Interrupt::EXTI0);
    }

    /// By an interrupt that nothing else uses.
    #[task(binds = EXTI0, priority = 1, shared = [clock, servo], local = [work])]
    fn turn(cx: turn::Context) {
        let turn::SharedResources { clock, servo, .. } = cx.shared;
        let wake = || rtic::pend(Interrupt::USART2);
        cx.local.work.turn(clock, servo, &LINE, wake);
    }

    #[idle]
    fn idle(_: idle::Context) -> ! {
        // No sleep: during sleep a debugger receives no log, and the emulator's clock skips ticks.
        work::log(&SETUP, || LINE.lost(), || {})
    }
}
