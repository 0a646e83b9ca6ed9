//! The number type of the solver.

pub(crate) use stiction_core::Real;
