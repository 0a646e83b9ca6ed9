//! The program of a board on this machine, from what FRAME.md and statics ask of it.

mod bits;
mod client;
mod commands;
mod faulty_line;
mod flood;
mod modes;
mod rig;
mod silence;
mod tracker;
