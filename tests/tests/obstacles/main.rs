//! The solver among obstacles with corners: cases with known answers, the laws of single frames on random scenes, closed rooms, and
//! the cases under the judge of traces.

mod alike;
mod budget;
mod cases;
mod exchange;
mod ground;
mod judged;
mod lawful;
mod level;
mod pegs;
mod rests;
mod seams;
