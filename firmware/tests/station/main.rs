//! The program of a board on this machine, against the requirements of FRAME.md and statics.

mod bed;
#[path = "../pantograph/bench.rs"]
mod bench;
mod beside;
mod bits;
mod client;
mod commands;
#[path = "../common/mod.rs"]
mod common;
#[path = "../../devices/pantograph.rs"]
mod example;
mod faulty_line;
mod flood;
mod late_turns;
mod modes;
mod no_commands;
mod obstacles;
mod pantograph;
mod random;
#[path = "../pantograph/reference.rs"]
mod reference;
mod rig;
mod scenes;
mod silence;
mod tracker;
