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
//! [`run`] executes all of this.
//!
//! `replay` runs a recording again and compares every answer bit for bit.
//!
//! [`check`] judges a trace by the laws alone.
//!
//! `list` shows the bundled scenes, and `new` writes a scene file to start from.
//!
//! `code` prints a scene as C, for the C library.
//!
//! [`trade`] runs many scenes in every setting of the solver, and reports the cost and accuracy of each setting.
//!
//! `sweep` runs scenes with many values of their parameters, and writes one table.
//!
//! [`board`] sends the hand's motion to a board in real time, in place of the solver on this computer or in parallel with it.
//!
//! `view` shows a scene in real time, with the mouse as the hand.
//!
//! `image` builds the image of a board, and writes it to a file for flashing.
//!
//! [`firmware`] has the images of boards and their emulators.

mod balance;
pub mod board;
pub mod check;
mod code;
pub mod columns;
pub mod command;
mod examples;
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
