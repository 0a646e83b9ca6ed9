//! The program of a board on this machine, from what FRAME.md and statics ask of it.

mod beside;
mod bits;
mod client;
mod commands;
mod faulty_line;
mod flood;
mod modes;
mod random;
mod rig;
mod silence;
mod tracker;
