//! Runs scene files through `stiction-core` on a computer. From a scene file and a hand's path to a trace:
//!
//! ```text
//! scene.toml ─ scene_file ─┐
//!                          ├─ simulate ─ record ─┬─ trace (JSON Lines, CSV)
//! hand.csv ─── hand_path ──┘                     ├─ summary
//!                                                └─ plot
//! ```

pub mod emulator;
pub mod hand_path;
pub mod number;
pub mod plot;
pub mod record;
mod report;
pub mod run;
pub mod scene_file;
pub mod scenes;
pub mod simulate;
pub mod source;
pub mod summary;
pub mod trace;
