//! `stiction-live` as WebAssembly, for JavaScript: [`Solver`] runs a scene sample by sample, [`Page`] does for a page what
//! `stiction view` does. Both are bound with `wasm-bindgen`; `stiction-page` builds them.

mod arguments;
mod page;
mod scenes;
mod solver;

pub use page::Page;
pub use scenes::{scene_names, scene_path, scene_text};
pub use solver::{Solver, state_names, status_names};
