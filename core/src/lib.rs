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
//! Contact of an object held in the hand, computed by statics alone.

mod body;
mod coupling;
mod detect;
mod friction;
mod geometry;
mod hand;
mod jet;
mod list;
mod motion;
mod output;
mod real;
mod roots;
mod scene;
mod solver;
mod state;
mod support;
mod transition;

pub use geometry::{Angle, Vec2};
pub use hand::{Axis, Hand, Projection, TrackerSample};
pub use output::{Contact, Event, MAX_CONTACTS, MAX_EVENTS, Output, StateKind, Status, Wrench};
pub use real::Real;
pub use scene::{Description, Parameter, Scene, SceneError, SurfaceDescription};
pub use solver::{Evolution, Solver, State};
pub use transition::{Transition, Transitions};
