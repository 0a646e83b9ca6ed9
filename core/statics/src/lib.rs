#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::indexing_slicing,
        clippy::arithmetic_side_effects
    )
)]
//! The statics of a body held in the hand.
#![allow(dead_code)]

mod bounds;
mod calm;
mod cone;
mod contact;
mod description;
mod errand;
mod events;
mod geometry;
mod joint;
mod law;
mod list;
mod log;
mod modes;
mod motion;
mod pair;
mod real;
mod search;
mod settle;
mod shares;
mod slip;
mod solver;
mod state;
mod step;
mod tangent;
mod thresholds;
mod touch;
mod world;
pub use solver::{Output, Solver, State, Tangent};
