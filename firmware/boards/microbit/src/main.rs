//! stiction on the BBC micro:bit: in this folder `cargo run` flashes the board, `cargo emulate` starts QEMU.
//!
//! ```text
//! priority 3  UART0    a byte in, a byte out, by bounded queues; 6 bytes wait in the receiver, 0.5 ms
//! priority 2  TIMER0   the tick: sample -> solver -> safety -> force
//! idle                 frames from bytes and back, commands, logs
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
mod log;

/// This machine is none.
#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("an image for a board: type cargo run in firmware/boards/microbit");
    std::process::exit(2);
}

#[cfg(target_os = "none")]
#[rtic::app(device = nrf51_hal::pac, peripherals = true)]
mod app {
    use crate::board::{self, Board, Clock, Uart, Watchdog};
    use crate::log::info;
    use core::sync::atomic::{AtomicU32, Ordering};
    use nrf51_hal::pac::Interrupt;
    use stiction_firmware::ring::Ring;
    use stiction_firmware::safety::Ticks;

    /// Ticks of a second.
    const RATE: u32 = 1_000;
    /// Bytes that wait, each way: 22 ms at 115200 baud.
    const ROOM: usize = 256;

    static RECEIVED: Ring<ROOM> = Ring::new();
    static TO_SEND: Ring<ROOM> = Ring::new();

    /// Ticks done and missed, for whoever wants to know: no context waits for another one.
    static DONE: AtomicU32 = AtomicU32::new(0);
    static MISSED: AtomicU32 = AtomicU32::new(0);

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        uart: Uart,
        clock: Clock,
        ticks: Ticks,
        watchdog: Watchdog,
    }

    #[init]
    fn init(cx: init::Context) -> (Shared, Local) {
        let Board {
            uart,
            clock,
            watchdog,
        } = Board::start(cx.device, RATE);
        info!("microbit, {=u32} ticks a second", RATE);
        let local = Local {
            uart,
            clock,
            ticks: Ticks::new(1_000_000 / RATE),
            watchdog,
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

    #[task(binds = TIMER0, priority = 2, local = [clock, ticks, watchdog])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources {
            clock,
            ticks,
            watchdog,
            ..
        } = cx.local;
        ticks.tick(clock.tick());
        DONE.store(ticks.done, Ordering::Relaxed);
        MISSED.store(ticks.missed, Ordering::Relaxed);
        watchdog.feed();
    }

    /// Every byte goes back.
    #[idle]
    fn idle(_: idle::Context) -> ! {
        let mut next = RATE;
        loop {
            while TO_SEND.room() > 0
                && let Some(byte) = RECEIVED.take()
            {
                // There is room.
                let _ = TO_SEND.put(byte);
                rtic::pend(Interrupt::UART0);
            }
            let done = DONE.load(Ordering::Relaxed);
            if done >= next {
                next = done.saturating_add(RATE);
                let (missed, lost) = (MISSED.load(Ordering::Relaxed), board::lost_bytes());
                info!(
                    "{=u32} ticks, {=u32} missed, {=u32} bytes lost",
                    done, missed, lost
                );
            }
            // No sleep: in one a debugger hears no log, and the emulator's clock leaps over ticks.
        }
    }
}
