//! stiction on your own board: its loop. The description of the board is in `setup.rs`; its pins, clocks and line are
//! in `board`.
#![no_std]
#![no_main]

#[cfg_attr(target_abi = "eabihf", path = "board/stm32f405.rs")]
#[cfg_attr(target_abi = "eabi", path = "board/rp2040.rs")]
#[cfg_attr(target_arch = "riscv32", path = "board/esp32c3.rs")]
mod board;
mod setup;

use setup::{Program, SETUP};
use stiction_firmware::device::{FromLine, NoActuators, Servo};
use stiction_firmware::line::{Line, Micros};
use stiction_firmware::pace::Pace;

/// Bytes between the interrupt of the line and the ticks.
static LINE: Line<1_024> = Line::new();

#[board::entry]
fn main() -> ! {
    // Some chips change their watchdog when it is fed.
    #[allow(unused_mut)]
    let (timer, mut watchdog) = board::start();
    let now_us = || board::now_us(&timer);
    // A scene or limits that cannot be used: nothing feeds the watchdog.
    let Ok(mut program) = Program::new(&SETUP) else {
        loop {}
    };
    // The device that measures the hand and outputs forces: the traits `Source` and `Actuators`.
    let mut servo = Servo::new((FromLine, NoActuators));
    let mut pace = Pace::new(SETUP.mode.tick_rate, now_us());
    let mut clock = Micros(now_us);
    loop {
        if pace.is_due(now_us()) {
            let mut line = LINE.link(&mut clock, board::wake);
            program.tick(now_us(), &mut line, &mut servo);
            pace.set_rate(program.mode().tick_rate);
            watchdog.feed();
        }
    }
}

/// Turn your motors off here: the watchdog resets the board only later.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
