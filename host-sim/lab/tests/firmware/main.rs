//! The images of the boards in emulators, talked to over their serial lines.
#![cfg(unix)]

mod an505;
mod bench;
mod bits;
mod board;
mod budgets;
mod chip;
mod commands;
mod drags;
mod flash;
mod knob;
mod knob_numbers;
mod line;
mod log;
mod lost;
mod pantograph;
mod pantograph_pico;
mod pico;
mod pico2;
mod scene;
mod session;
mod silence;
mod table;
mod template;
mod wiring;
