//! The program of a board on this machine, against the requirements of FRAME.md and statics.

mod bed;
mod bits;
mod commands;
mod faulty_line;
mod flood;
mod knob;
mod late_turns;
mod modes;
mod no_commands;
mod obstacles;
mod pantograph;
mod rig;
mod scenes;
mod silence;
mod tracker;
