//! The images of the boards in QEMU, talked to over their serial lines. The images are the same whatever these tests are
//! built with, so that they are not run again with `--release`.
#![cfg(all(unix, debug_assertions))]

#[path = "../station/beside.rs"]
mod beside;
mod bits;
mod board;
mod budgets;
mod chip;
#[path = "../station/client.rs"]
mod client;
mod image;
mod line;
mod log;
mod pantograph;
#[path = "../station/random.rs"]
mod random;
mod scene;
mod session;
mod table;
