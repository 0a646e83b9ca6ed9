//! What programs and tests that measure have in common: the boards in QEMU ([`board`]), what is in their images ([`image`]), which
//! programs do the work and what is missing ([`process`]), sections of a README ([`readme`]), files that are whole ([`files`]),
//! text in columns ([`table`]), the name of the machine ([`machine`]).

pub mod board;
pub mod files;
pub mod image;
pub mod machine;
pub mod process;
pub mod readme;
pub mod table;

use std::path::Path;

/// The folder of the workspace: there lies what images are built from.
pub fn workspace() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}
