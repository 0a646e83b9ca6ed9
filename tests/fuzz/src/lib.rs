//! Arbitrary bytes, and the properties that must hold for them: [`wire`] (a line to a board and from it), [`scene_file`], [`hand_path`],
//! [`solver`] (a scene, its parameters and a hand's path: every frame obeys the laws), and [`obstacles`] (the same among obstacles, with
//! the laws of single frames). Each takes bytes and panics if a property is violated. cargo-fuzz searches for such bytes; its finds, and
//! inputs that reach deep into the code, are under `corpus/` and are checked by the tests.
//!
//! ```sh
//! tests/fuzz/run.sh solver 60
//! ```

mod case;
mod clamp;
mod draw;
mod hand_path;
mod obstacles;
mod scene_file;
mod solver;
mod station;
mod wire;

pub use hand_path::hand_path;
pub use obstacles::obstacles;
pub use scene_file::scene_file;
pub use solver::{as_files, solver};
pub use wire::wire;
