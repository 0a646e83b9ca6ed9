//! The solver from outside. It is one program, so that every number type is compiled only once.

mod bench;
mod closed;
mod hand;
mod runs;
mod slow;
mod transitions;
