//! Whole evolutions with known answers. The values come from an independent calculation, to 12 digits; lengths,
//! stiffnesses and forces are of order 1, so every bound is absolute: 1e-9 in f64, 1e-4 in f32.
//!
//! Two quantities obey a square-root law and get their own bounds where they appear: the angle just before a fold,
//! which is a double root, and the part of a slip that depends on an angle close to a fold.

mod edge;
mod fold;
mod ladder;
mod vertex;
