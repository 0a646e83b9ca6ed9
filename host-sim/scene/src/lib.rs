//! Scene files: from TOML to a scene of the solver, to the model that it needs, and to the code that is compiled into a board;
//! and the hand's motion, from keyframes or a recorded file to samples.
//!
//! ```text
//! scene.toml ─ Source ─ document.rs ─ check.rs ─┬─ WrittenScene ─┬─ scene_in ─ Scene of the solver, or locate.rs: the key
//!                                               │                ├─ SceneModel: the smallest that it runs in, and why
//!                                               │                └─ board.rs, compile.rs, code.rs: scene.rs in a board's build
//!                                               └─ hand_section.rs: [hand] ─┐
//! hand.csv ─── Source ─ hand_path/recorded.rs ─ hand_path/placement.rs ─────┴─ HandPath: samples, resampled
//! ```
//!
//! [`SceneFile`] is a written scene with its `[hand]`.

mod board;
mod check;
mod code;
mod compile;
mod document;
mod hand_path;
mod hand_section;
mod locate;
mod model;
mod scene_file;
mod source;
mod surface;
mod written;

pub use board::BoardBuild;
pub use code::rust_source;
pub use compile::code;
pub use hand_path::{HandPath, LivePlacement, Placement, Sample};
pub use hand_section::{HandSection, Motion};
pub use model::SceneModel;
pub use scene_file::{HostScene, HostSolver, SceneFile};
pub use source::{InputError, Source};
pub use stiction_core::frame::NumberType;
pub use surface::SurfaceInfo;
pub use written::{SURFACES, VERTICES, WrittenScene};
