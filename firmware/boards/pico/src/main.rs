//! stiction on the Raspberry Pi Pico: in this folder `cargo run` flashes the board.
//!
//! ```text
//! priority 4  UART0    bytes in and out, by bounded queues; 32 bytes wait in the receiver, 350 µs
//! priority 3  TIMER    the tick: bytes -> samples, commands -> solver -> safety -> force, reports -> bytes
//! priority 2  USB      packets in and out, by bounded queues; the computer waits where a tick goes on
//! idle                 logs
//! ```
//!
//! One core does all: no tick waits for USB, as it interrupts it, and USB loses nothing, as the computer sends again what is not
//! taken. The line is USB while a program has it open there, else UART.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
mod flash;
#[cfg(target_os = "none")]
#[path = "../../log.rs"]
mod log;
#[cfg(target_os = "none")]
#[path = "../../stop.rs"]
mod stop;

/// This machine is none.
#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("an image for a board: type cargo run in firmware/boards/pico");
    std::process::exit(2);
}

#[cfg(target_os = "none")]
mod scene {
    include!(concat!(env!("OUT_DIR"), "/scene.rs"));
}

#[cfg(target_os = "none")]
#[rtic::app(device = rp2040_hal::pac, peripherals = true)]
mod app {
    use crate::board::{self, Board, Bus, Clock, Uart, Usb, Watchdog};
    use crate::log::{self, info};
    use crate::scene::{CompiledScene, OBSTACLES, SCENE};
    use crate::stop::stop;
    use rp2040_hal::pac::Interrupt;
    use stiction_core::Fixed;
    use stiction_core::frame::{Mode, NumberType};
    use stiction_firmware::device::{FromLine, NoActuators};
    use stiction_firmware::line::Line;
    use stiction_firmware::safety::Limits;
    use stiction_firmware::station::{Log, SceneType, Setup, Station, Watch};

    /// Room for so many vertices: what is compiled in, see build.rs.
    const V: usize = CompiledScene::VERTICES;
    /// Room for so many surfaces.
    const S: usize = CompiledScene::SURFACES;
    /// Units of work of a second: one takes 3430 cycles at most in a long step (host-sim/README.md, at 1.65 cycles of an instruction).
    /// A quarter of its time is for the interrupts of the lines and what else a tick does.
    const WORK_RATE: u32 = board::CLOCK / 3_430 / 4 * 3;
    type Model = <CompiledScene as SceneType>::Model;
    type Program = Station<Fixed, V, S, Model, { CompiledScene::FRAME }>;

    static SETUP: Setup = Setup {
        name: "pico",
        number: NumberType::Fixed,
        line_rate: board::BAUD / 10,
        fastest_tick: 2_000,
        work_rate: WORK_RATE,
        limits: Limits::DEFAULT,
        passivity: None,
        mode: Mode::DEFAULT,
        scene: SCENE,
    };

    /// Bytes that wait, each way: 11 ms.
    const ROOM: usize = 1_024;

    static UART: Line<ROOM> = Line::new();
    static USB: Line<ROOM> = Line::new();
    static WATCH: Watch = Watch::new();

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        uart: Uart,
        usb: Usb,
        clock: Clock,
        watchdog: Watchdog,
        program: Program,
    }

    #[init(local = [bus: Bus = Bus::new()])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let Ok(program) = Program::among(&SETUP, OBSTACLES) else {
            stop()
        };
        let rate = SETUP.mode.tick_rate;
        let Board {
            uart,
            usb,
            clock,
            watchdog,
        } = Board::start(cx.device, cx.local.bus, rate);
        info!("{=str}, {=u16} ticks a second", SETUP.name, rate);
        let local = Local {
            uart,
            usb,
            clock,
            watchdog,
            program,
        };
        (Shared {}, local)
    }

    /// What comes first is what must not wait.
    #[task(binds = UART0_IRQ, priority = 4, local = [uart])]
    fn serial(cx: serial::Context) {
        cx.local.uart.serve(&UART);
    }

    #[task(binds = USBCTRL_IRQ, priority = 2, local = [usb])]
    fn usb(cx: usb::Context) {
        cx.local.usb.serve(&USB);
    }

    #[task(binds = TIMER_IRQ_0, priority = 3, local = [clock, watchdog, program])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources {
            clock,
            watchdog,
            program,
            ..
        } = cx.local;
        let now_us = clock.tick();
        let mut line = if board::usb_is_open() {
            USB.link(clock, || rtic::pend(Interrupt::USBCTRL_IRQ))
        } else {
            UART.link(clock, || rtic::pend(Interrupt::UART0_IRQ))
        };
        // This board has no device.
        program.tick(now_us, &mut line, &mut (FromLine, NoActuators));
        clock.set_rate(program.mode().tick_rate);
        WATCH.show(&program.health());
        // Last: a tick that did not do its work feeds nothing.
        watchdog.feed();
    }

    #[idle]
    fn idle(_: idle::Context) -> ! {
        let mut news = Log::new(&WATCH, SETUP.mode.tick_rate);
        loop {
            let lost = UART.lost().saturating_add(USB.lost());
            news.look(&WATCH, |news| log::tell(news, lost));
            // A debugger reads the memory of this chip in its sleep, too.
            cortex_m::asm::wfi();
        }
    }
}
