//! The solver among obstacles with corners: cases with known answers, and before the judge of traces.

mod cases;
mod judged;
