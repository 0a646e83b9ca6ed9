//! Runs scene files through `stiction-core` on a computer. From a scene file and a hand's path to a trace:
//!
//! ```text
//! scene.toml ─ SceneFile ─┐
//!                         ├─ simulate ─ record ─┬─ trace (JSON Lines, CSV)
//! hand.csv ─── HandPath ──┘                     ├─ summary
//!                                               └─ plot
//! ```
//!
//! Both are read by `stiction-scene`.
//!
//! [`run`] executes all of this. The other commands have a module each, and [`command`] lists them; [`firmware`] has the images of boards
//! and their emulators.

mod balance;
pub mod board;
pub mod check;
mod code;
pub mod columns;
pub mod command;
mod examples;
mod figure_options;
mod figures;
mod files;
pub mod firmware;
mod image;
pub mod input;
mod list;
mod mistakes;
mod new;
mod options;
pub mod plot;
mod progress;
mod recording;
mod replay;
mod report;
pub mod run;
mod settings;
mod shell;
mod stop;
mod summary;
mod sweep;
pub mod trace;
pub mod trade;
mod view;
