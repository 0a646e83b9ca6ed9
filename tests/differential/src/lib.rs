//! Two solvers side by side on the same scenes and hands: which frames are equal, where a run first differs and whether both answers are
//! lawful there, and how each fares where rounding decides. It exists while the statics are replaced.
//!
//! A [`Solver`] makes a [`Subject`] of a scene, which answers hand poses with frames of the judge. A [`Family`] is a function from a seed to
//! a [`Case`]: scene and hand. [`command::run`] is the program for any list of solvers.

mod case;
pub mod command;
mod compare;
mod differences;
mod families;
mod lawful;
mod measures;
mod old;
mod statics;
mod subject;
mod tally;

pub use case::Case;
pub use compare::{Pair, compare};
pub use families::{FAMILIES, Family};
pub use old::OLD;
pub use statics::STATICS;
pub use subject::{Digits, Made, Solver, Subject};
