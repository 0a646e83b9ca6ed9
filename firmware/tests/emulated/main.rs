//! The images of the boards in QEMU, talked to over their serial lines.
#![cfg(unix)]

mod bits;
mod board;
mod budgets;
#[path = "../station/client.rs"]
#[allow(dead_code)]
mod client;
mod image;
mod line;
