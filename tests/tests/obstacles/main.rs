//! The solver among obstacles with corners: cases with known answers.

mod cases;
