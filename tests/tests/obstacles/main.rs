//! The solver among obstacles with corners: cases with known answers, the laws of single frames on random scenes, closed rooms.

mod cases;
mod judge;
mod lawful;
