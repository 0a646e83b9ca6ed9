//! The slow reference among obstacles: against cases with known answers, against the laws on random scenes, under the judge of
//! traces, and against itself where physics says that two scenes are equivalent. The solver takes no part.

mod cases;
mod judged;
mod traced;
mod worlds;
