//! The judge against traces that are lawful by closed forms, and against the same with a fault in them: each must be found,
//! by the name of its law, in both formats.

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
