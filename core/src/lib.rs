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
//! Contact of an object held in the hand, computed by statics alone: no inertia, no velocities, no time step. At every
//! pose of the hand the object sits where forces and moments balance; it sticks, slips to a new balance, tips, lands on an
//! edge, snaps, jams. The equations and rules are in `STATICS.md` among the sources of this crate; the documentation cites its
//! sections and numbers, as (E3), (R21) or STATICS 3.
//!
//! A [`Scene`] is checked once, a [`Solver`] never changes, a [`State`] is plain data, [`Solver::step`] never fails. The crate uses no
//! heap and no `unsafe`, and does not panic. The same input gives the same bits on every machine:
//!
//! ```
//! use stiction_core::{Description, Evolution, Hand, Scene, Solver, StateKind, SurfaceDescription};
//!
//! // A box of 0.10 m x 0.06 m on a floor, in single precision, with room for 4 vertices and 1 surface.
//! let scene: Scene<f32, 4, 1> = Scene::new(&Description {
//!     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]], // m
//!     start: [0.0, 0.03, 0.0], // x, y (m), theta (rad)
//!     weight: 0.0, // N
//!     holding_point: Some([0.0, 0.02]), // m, in the body's frame
//!     reach: 0.0, // m
//!     stiffness_translation: 500.0, // N/m
//!     stiffness_rotation: 0.5, // N·m/rad
//!     surfaces: &[SurfaceDescription {
//!         normal: [0.0, 1.0],
//!         offset: 0.0, // m
//!         friction_static: 0.5,
//!         friction_dynamic: 0.3,
//!         memory: None,
//!     }],
//!     obstacles: &[],
//! })?;
//! let solver = Solver::new(scene, Evolution::Path);
//! let (mut state, _) = solver.start(Hand::new(0.0, 0.05, 0.0)); // x, y (m), phi (rad)
//!
//! // The hand goes down by 10 mm: the floor bears 500 N/m · 0.01 m.
//! let output = solver.step(&mut state, Hand::new(0.0, 0.04, 0.0));
//! assert_eq!(output.state, StateKind::Edge);
//! let contacts = solver.contacts(&state);
//! let borne: f32 = contacts.iter().map(|contact| contact.normal).sum();
//! assert!((borne - 5.0).abs() < 1e-4);
//!
//! // Along by 2 mm, and the box stays where it is: friction of 1 N is less than 0.5 · 5 N.
//! let output = solver.step(&mut state, Hand::new(0.002, 0.04, 0.0));
//! assert_eq!(output.position[0], 0.0); // m
//! let felt = solver.wrench(&state).feedback().force[0]; // N, on the hand
//! assert!((felt + 1.0).abs() < 1e-4);
//! # Ok::<(), stiction_core::SceneError<f32>>(())
//! ```
//!
//! All quantities of the public interface are in SI units, in a right-handed world frame, angles in radians and counter-clockwise.
//! Forces are those on the body; the force that a device outputs to the hand is [`Wrench::feedback`].
//!
//! | To | see |
//! |---|---|
//! | describe a scene and learn what is wrong with it | [`Description`], [`SceneError`] |
//! | add a table with an edge, a step, a post or a hole | [`ObstacleDescription`], [`Touch`] |
//! | choose between exact and cheap | [`Evolution`], [`Solver`] |
//! | keep and replay a run | [`State`] |
//! | change the scene or its parameters in mid-contact | [`Solver::carry`], [`Present`] |
//! | read forces, for a device or a display | [`Wrench`], [`Contact`] |
//! | know what happened and what limited the answer | [`Output`], [`Event`], [`Status`] |
//! | release and grasp the body, feed a tracker | [`Hand`], [`Projection`] |
//! | run without a floating-point unit, or leave code out | [`Fixed`], the capacities of [`Scene`] |
//! | communicate with a board | the package `stiction-wire` |
//!
//! # Contact states
//!
#![doc = include_str!("../states.svg")]
//!
//! # Inside
//!
//! ```text
//! TrackerSample --Projection--> Hand
//!                                |  grasp.rs        samples that can be used, taking hold, letting go
//!                                v
//!                              step.rs              along the hand's displacement: calm.rs, or search.rs to the first event
//!                                |  law.rs          what follows from an event: new signs, or settle.rs at the frozen hand
//!                                v
//!                              Output               pose, events, status; forces on demand
//! ```
//!
//! Every quantity is non-dimensional: lengths / L (the largest distance of two vertices), forces / (k_h L), moments
//! / (k_h L²). A contact is a pair of a feature of the body and a feature of the surroundings: a vertex and a half-plane or a side of an
//! obstacle, or a corner of an obstacle and a side of the body.

/// The example in the README, as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod answer;
mod bounds;
mod bracket;
mod calm;
mod carry;
mod components;
mod cone;
mod contact;
mod couple;
mod driven;
mod edge;
mod ending;
mod errand;
mod event;
mod events;
mod evolution;
mod factor;
mod fly;
mod forces;
mod found;
mod frame;
mod geometry;
mod grasp;
mod halt;
mod hand;
mod hold;
mod jam;
mod joint;
mod judge;
mod judging;
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
mod sample;
mod scene;
mod search;
mod settle;
mod shares;
mod si;
mod slip;
mod solver;
mod state;
mod step;
mod tangent;
#[cfg(test)]
mod tests;
mod thresholds;
mod touch;
mod units;
mod values;
mod window;
mod world;

pub use carry::{Carried, CarryError, Present, reach_again};
pub use contact::MAX_CONTACTS;
pub use event::{Event, MAX_EVENTS, StateKind, Status};
pub use evolution::Evolution;
pub use forces::{Contact, Contacts, Touch, Wrench};
pub use geometry::Angle;
pub use hand::{Axis, Hand, Projection, TrackerSample};
pub use hold::Hold;
pub use output::{Output, Tangent};
#[cfg(feature = "comparison")]
pub use real::{CordicFixed, LibmSingle, MicromathSingle};
pub use real::{Fixed, Real};
pub use scene::{
    Description, ObstacleDescription, Parameter, Scene, SceneError, SurfaceDescription,
};
pub use si::{SiFloat, narrow_hand};
pub use solver::{Solver, State};
