//! The judge against traces that are lawful according to closed forms, and against the same traces with a fault: each fault
//! must be found, under the name of its law, in both formats. And the meter of a peg in a hole against known results.

mod bar;
mod drag;
mod faults;
mod jams;
mod known;
mod peg_and_hole;
mod shapes;
mod slides;
mod table;
mod unusable;
mod whitney;
mod write;
