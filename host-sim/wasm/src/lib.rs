//! `stiction-live` as WebAssembly, for JavaScript: [`Solver`] runs a scene sample by sample, [`Page`] is what `stiction view` is to
//! its page. Both are made with `wasm-bindgen`; `stiction-page` builds it.

mod page;
#[cfg(feature = "package")]
mod scenes;
#[cfg(feature = "package")]
mod solver;

pub use page::Page;
#[cfg(feature = "package")]
pub use scenes::{scene_names, scene_path, scene_text};
#[cfg(feature = "package")]
pub use solver::{Solver, state_names, status_names};
