//! The devices at the pins of the boards, a file of numbers for each: those of an example, to be replaced.

pub mod knob;
pub mod pantograph;
