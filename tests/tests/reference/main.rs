//! The slow reference among obstacles: against cases with known answers, against the laws on random scenes, and against itself where
//! physics says that two scenes are one. No solver takes part.

mod cases;
mod corners;
mod lawful;
mod symmetry;
mod worlds;
