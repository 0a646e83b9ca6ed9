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

mod answer;
mod bounds;
mod calm;
mod carry;
mod cone;
mod contact;
mod description;
mod driven;
mod ending;
mod errand;
mod events;
mod frame;
mod geometry;
mod hold;
mod jam;
mod joint;
mod judge;
mod law;
mod list;
mod log;
mod modes;
mod motion;
mod obstacles;
mod output;
mod pair;
mod pair_bounds;
mod place;
mod real;
mod rebalance;
mod sample;
mod search;
mod settle;
mod shares;
mod slip;
mod solver;
mod state;
mod step;
mod tangent;
#[cfg(test)]
mod tests;
mod thresholds;
mod touch;
mod values;
mod window;
mod world;

pub use carry::Carried;
pub use output::{Output, Tangent};
pub use solver::{Solver, State};
