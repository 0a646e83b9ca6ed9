//! The judge against traces that are lawful according to closed forms, and against the same traces with a fault: each fault
//! must be found, under the name of its law, in both formats.

mod bar;
mod drag;
mod faults;
mod jams;
mod known;
mod shapes;
mod slides;
mod table;
mod unusable;
mod write;
