//! Scene files: from TOML to a scene of the solver, to the model that it needs, and to the code that is compiled into a board;
//! and the hand's motion, from keyframes or a recorded file to samples.
//!
//! ```text
//! scene.toml ─ Source ─ document.rs ─ check.rs ─┬─ WrittenScene ─┬─ scene_in ─ Scene of the solver, or locate.rs: the key
//!                                               │                │             (obstacles cut to size by clip.rs)
//!                                               │                ├─ SceneModel: the smallest that it runs in, and why
//!                                               │                ├─ board.rs, compile.rs, code.rs: scene.rs in a board's build
//!                                               │                └─ c_code.rs: the same for the C library
//!                                               └─ hand_section.rs: [hand] ─┐
//! hand.csv ─── Source ─ hand_path/recorded.rs ─ hand_path/placement.rs ─────┴─ HandPath: samples, resampled
//! ```
//!
//! [`SceneFile`] is a written scene with its `[hand]`. Files are opened and read with limits by [`text`].

mod board;
mod c_code;
mod check;
mod clip;
mod code;
mod compile;
mod document;
mod friction;
mod hand_path;
mod hand_section;
mod locate;
mod model;
mod name;
mod obstacle;
mod outline;
mod scene_file;
mod source;
mod surface;
pub mod text;
mod written;

pub use board::BoardBuild;
pub use c_code::c_source;
pub use clip::Indices;
pub use code::rust_source;
pub use compile::code;
pub use hand_path::{AngleUnit, HandPath, LivePlacement, Placement, Sample, doubts, fitted};
pub use hand_section::{HandSection, Motion};
pub use model::SceneModel;
pub use obstacle::ObstacleInfo;
pub use scene_file::{HostScene, HostSolver, SceneFile};
pub use source::{InputError, Source, story};
pub use stiction_wire::NumberType;
pub use surface::SurfaceInfo;
pub use written::{CORNERS, OBSTACLES, SURFACES, VERTICES, WrittenScene};
