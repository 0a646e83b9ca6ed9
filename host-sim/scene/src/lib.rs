//! Scene files: from TOML to a scene of the solver, to the model that it needs, and to the code that is compiled into a board.
//!
//! ```text
//! scene.toml ─ Source ─ document.rs ─ check.rs ─ WrittenScene ─┬─ scene_in ─ Scene of the solver, or locate.rs: the key
//!                                                              ├─ SceneModel: the smallest that it runs in, and why
//!                                                              └─ board.rs, compile.rs, code.rs: scene.rs in a board's build
//! ```
//!
//! A program that runs scenes reads [`WrittenScene::hand`] as well, with the same [`Check`].

mod board;
mod check;
mod code;
mod compile;
mod document;
mod locate;
mod model;
mod source;
mod surface;
mod written;

pub use board::BoardBuild;
pub use check::Check;
pub use code::{BoardNumber, rust_source};
pub use compile::code;
pub use document::{Hand, Number, Numbers};
pub use model::SceneModel;
pub use source::{InputError, Source, excerpt};
pub use surface::SurfaceInfo;
pub use written::{SURFACES, VERTICES, WrittenScene};
