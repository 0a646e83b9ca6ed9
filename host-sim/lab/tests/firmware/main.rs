//! The images of the boards in QEMU, talked to over their serial lines.
#![cfg(unix)]

mod an505;
mod bench;
#[path = "../../../../firmware/tests/station/beside.rs"]
mod beside;
mod bits;
mod board;
mod budgets;
mod chip;
#[path = "../../../../firmware/tests/station/client.rs"]
mod client;
mod commands;
#[path = "../../../../firmware/tests/common/mod.rs"]
mod common;
mod drags;
#[path = "../../../../firmware/devices/pantograph.rs"]
mod example;
mod knob;
mod line;
mod log;
mod lost;
mod pantograph;
mod pantograph_pico;
mod pico;
mod pico2;
#[path = "../../../../firmware/tests/station/random.rs"]
mod random;
#[path = "../../../../firmware/tests/pantograph/reference.rs"]
mod reference;
mod scene;
mod session;
mod silence;
mod table;
mod template;
mod uf2;
mod wiring;
