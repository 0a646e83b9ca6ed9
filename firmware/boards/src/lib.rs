//! The program of every board, on RTIC: ticks interrupt turns, and the line interrupts both. A board implements `Board` in its folder, with
//! its pins, its clocks and its watchdog, and `app!` binds its interrupts.
//!
//! ```text
//! app.rs        the tasks and their priorities
//! work.rs       ticks, turns and the log while there is nothing else to do
//! elapsed.rs    time from a counter
//! speed.rs      the speed of the Pico 2, and of the emulated board in its place
//! log.rs        words of the log, by the features `rtt` and `semihosting`
//! stop.rs       the response to a panic or a fault
//! raspberry.rs  the common part of the Pico and the Pico 2
//! ```
#![cfg(target_os = "none")]
#![no_std]

mod app;
pub mod elapsed;
pub mod log;
#[cfg(feature = "raspberry")]
pub mod raspberry;
pub mod speed;
mod stop;
pub mod work;

use stiction_firmware::device::{Actuators, Source};
use stiction_firmware::line::{self, Line};
use stiction_firmware::station::Setup;
use stiction_wire::KnobNumbers;

#[cfg(any(
    all(feature = "knob", feature = "pantograph"),
    all(feature = "knob", not(feature = "raspberry")),
    all(
        feature = "pantograph",
        not(any(feature = "raspberry", feature = "olimex-stm32-h405"))
    ),
))]
compile_error!("the board has no pins for this device, or for both of them");

pub use stop::stop;
pub use {cortex_m, stiction_firmware};

/// A board: its description, its start, and its end.
pub trait Board {
    /// What the crate of the chip calls its peripherals.
    type Chip;
    /// What must stay in place as long as the program runs.
    type Memory;
    /// Its clock.
    type Clock: Ticks;
    /// Its source of samples and its actuators.
    type Device: Source + Actuators;
    /// Its serial line.
    type Uart: Port;
    /// Its serial line over USB; `()` if it has none.
    type Usb;
    /// Its watchdog.
    type Watchdog: Watchdog;

    /// Its description.
    const SETUP: Setup;
    /// Bytes that wait at its serial line, in each direction: a power of two.
    const ROOM: usize;
    /// The memory before the start.
    const MEMORY: Self::Memory;

    /// Starts everything, with the ticks per second of [`Self::SETUP`], and no motor driven.
    fn start(
        chip: Self::Chip,
        core: cortex_m::Peripherals,
        memory: &'static mut Self::Memory,
    ) -> PartsOf<Self>;

    /// Its description with what it has stored; nothing by default.
    fn setup(described: &'static Setup) -> &'static Setup {
        described
    }

    /// Stores other numbers of its knob and restarts. Called by a board that has such numbers, when its motor is off.
    fn restart_with(_: &KnobNumbers, _: &mut Self::Watchdog) -> ! {
        stop()
    }

    /// No motor is driven any more, whatever else is going on.
    fn actuators_off();

    /// Called while there is nothing to do. Without sleep: during sleep a debugger receives no log from most chips, and the clock of QEMU
    /// skips ticks.
    fn rest() {}
}

/// The parts of a board that its tasks use.
#[derive(Debug)]
pub struct Parts<C, D, U, P, W> {
    /// The clock.
    pub clock: C,
    /// Source and actuators.
    pub device: D,
    /// The serial line.
    pub uart: U,
    /// The serial line over USB.
    pub usb: P,
    /// The watchdog, which runs.
    pub watchdog: W,
}

/// The parts of a board by its name.
pub type PartsOf<B> = Parts<
    <B as Board>::Clock,
    <B as Board>::Device,
    <B as Board>::Uart,
    <B as Board>::Usb,
    <B as Board>::Watchdog,
>;

/// What a device has at its left joint, its right joint and its handle.
#[derive(Debug)]
pub struct Joints<L, R, H> {
    /// At the left joint.
    pub left: L,
    /// At the right joint.
    pub right: R,
    /// At the handle.
    pub handle: H,
}

/// Both tracks of an encoder.
#[derive(Debug)]
pub struct Tracks<A, B> {
    /// Track A.
    pub a: A,
    /// Track B.
    pub b: B,
}

/// Ticks, and the time.
pub trait Ticks: line::Clock {
    /// Sets the ticks per second.
    fn set_rate(&mut self, rate: u16);

    /// A tick has come: returns the time (µs, wrapping).
    fn tick(&mut self) -> u32;
}

/// The hardware of a line. Only its interrupt uses it.
pub trait Port {
    /// Takes bytes that arrived, and sends bytes that wait, without waiting.
    fn serve<const N: usize>(&mut self, line: &Line<N>);
}

/// Resets the chip unless it is fed.
pub trait Watchdog {
    /// Feeds it.
    fn feed(&mut self);
}
