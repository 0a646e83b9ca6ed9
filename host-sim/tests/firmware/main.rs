//! The images of the boards in QEMU, talked to over their serial lines.
#![cfg(unix)]

mod an505;
mod bench;
mod bits;
mod board;
mod budgets;
mod chip;
mod commands;
mod drags;
mod knob;
mod line;
mod log;
mod lost;
mod pantograph;
mod pantograph_pico;
mod pico;
mod pico2;
mod pico2_line;
mod pico2_setup;
mod rp2350;
mod scene;
mod session;
mod silence;
mod table;
mod talks;
mod template;
mod uf2;
mod wiring;
