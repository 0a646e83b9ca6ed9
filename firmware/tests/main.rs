//! The program of a board and its parts on this machine, against their requirements: FRAME.md, statics, mechanics.

mod bench;
mod bits;
mod count;
mod device;
mod knob;
mod line;
mod pantograph;
mod ring;
mod safety;
mod station;
