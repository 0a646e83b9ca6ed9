//! stiction on the BBC micro:bit: in this folder `cargo run` flashes the board, `cargo emulate` starts QEMU.
//!
//! ```text
//! priority 3  UART0    a byte in, a byte out, by bounded queues; 6 bytes wait in the receiver, 0.5 ms
//! priority 2  TIMER0   the tick: bytes -> samples, commands -> solver -> safety -> force, reports -> bytes
//! idle                 logs
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
#[path = "../../log.rs"]
mod log;

/// This machine is none.
#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("an image for a board: type cargo run in firmware/boards/microbit");
    std::process::exit(2);
}

#[cfg(target_os = "none")]
mod scene {
    include!(concat!(env!("OUT_DIR"), "/scene.rs"));
}

#[cfg(target_os = "none")]
#[rtic::app(device = nrf51_hal::pac, peripherals = true)]
mod app {
    use crate::board::{self, Board, Clock, Uart, Watchdog};
    use crate::log::info;
    use crate::scene::{CompiledScene, OBSTACLES, SCENE};
    use nrf51_hal::pac::Interrupt;
    use stiction_core::frame::{Mode, NumberType};
    use stiction_core::{Evolution, Fixed};
    use stiction_firmware::device::{FromLine, NoActuators};
    use stiction_firmware::ring::Ring;
    use stiction_firmware::safety::Limits;
    use stiction_firmware::station::{Link, SceneType, Seen, Setup, Station, Watch};

    /// Room for so many vertices: what is compiled in, see build.rs.
    const V: usize = CompiledScene::VERTICES;
    /// Room for so many surfaces.
    const S: usize = CompiledScene::SURFACES;
    /// Ticks of a second.
    const RATE: u16 = 200;
    /// Units of work of a second: one takes 3430 cycles at most in a long step (host-sim/README.md, at 1.65 cycles of an instruction).
    /// Half of its time is for the interrupts of the line and what else a tick does.
    const WORK_RATE: u32 = 16_000_000 / 3_430 / 2;
    type Model = <CompiledScene as SceneType>::Model;
    type Program = Station<Fixed, V, S, Model, { CompiledScene::FRAME }>;

    static SETUP: Setup = Setup {
        name: "microbit",
        number: NumberType::Fixed,
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

    /// Bytes that wait, each way: 22 ms.
    const ROOM: usize = 256;

    static RECEIVED: Ring<ROOM> = Ring::new();
    static TO_SEND: Ring<ROOM> = Ring::new();
    static WATCH: Watch = Watch::new();

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        uart: Uart,
        clock: Clock,
        watchdog: Watchdog,
        program: Program,
    }

    #[init]
    fn init(cx: init::Context) -> (Shared, Local) {
        let Ok(program) = Program::among(&SETUP, OBSTACLES) else {
            board::stop()
        };
        let rate = SETUP.mode.tick_rate;
        let Board {
            uart,
            clock,
            watchdog,
        } = Board::start(cx.device, rate);
        info!("{=str}, {=u16} ticks a second", SETUP.name, rate);
        let local = Local {
            uart,
            clock,
            watchdog,
            program,
        };
        (Shared {}, local)
    }

    /// What comes first is what must not wait.
    #[task(binds = UART0, priority = 3, local = [uart])]
    fn serial(cx: serial::Context) {
        let uart = cx.local.uart;
        while let Some(byte) = uart.read() {
            if !RECEIVED.put(byte) {
                board::lost_a_byte();
            }
        }
        uart.write(|| TO_SEND.take());
    }

    /// The queues as a line.
    struct Queues<'a>(&'a mut Clock);

    impl Link for Queues<'_> {
        fn take(&mut self) -> Option<u8> {
            RECEIVED.take()
        }
        fn send(&mut self, frame: &[u8]) -> bool {
            let sent = TO_SEND.put_all(frame);
            rtic::pend(Interrupt::UART0);
            sent
        }
        fn now_ns(&mut self) -> u32 {
            self.0.now_ns()
        }
    }

    #[task(binds = TIMER0, priority = 2, local = [clock, watchdog, program])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources {
            clock,
            watchdog,
            program,
            ..
        } = cx.local;
        let now_us = clock.tick();
        // This board has no device.
        program.tick(now_us, &mut Queues(clock), &mut (FromLine, NoActuators));
        clock.set_rate(program.mode().tick_rate);
        WATCH.show(&program.health());
        // Last: a tick that did not do its work feeds nothing.
        watchdog.feed();
    }

    #[idle]
    fn idle(_: idle::Context) -> ! {
        let mut last = WATCH.seen();
        let mut drive = None;
        loop {
            let seen = WATCH.seen();
            if drive != Some(seen.drive) {
                info!("force: {=str}", seen.force());
                drive = Some(seen.drive);
            }
            if seen.ticks < last.ticks {
                info!("everything reset");
                last = seen;
            }
            if seen.ticks.saturating_sub(last.ticks) >= u32::from(SETUP.mode.tick_rate) {
                log(&seen);
                last = seen;
            }
            // No sleep: in one a debugger hears no log, and the emulator's clock leaps over ticks.
        }
    }

    fn log(seen: &Seen) {
        info!(
            "ticks: {=u32}, {=u32} missed, {=u32} ns the longest; samples: {=u32}; frames: {=u32} lost, {=u32} faulty, {=u32} not sent; bytes: {=u32} lost",
            seen.ticks,
            seen.missed_ticks,
            seen.worst_tick,
            seen.samples,
            seen.lost_frames,
            seen.faults,
            seen.unsent,
            board::lost_bytes()
        );
    }
}
