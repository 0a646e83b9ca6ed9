//! `stiction-live` as WebAssembly, for JavaScript: [`Solver`] runs a scene sample by sample, [`Page`] is what `stiction view` is to
//! its page. Both are made with `wasm-bindgen`; `stiction-page` builds it.

mod page;
mod scenes;
mod solver;

pub use page::Page;
pub use scenes::{scene_names, scene_path, scene_text};
pub use solver::{Solver, state_names, status_names};
