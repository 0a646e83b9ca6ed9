//! What programs and tests that measure have in common: the boards in QEMU ([`board`]), what is in their images ([`image`]), which
//! programs do the work and what is missing ([`process`]), sections of a README ([`readme`]), files that are whole ([`files`]),
//! what is needed to build and emulate ([`needs`]), text in columns ([`table`]), the name of the machine ([`machine`]), scripts without their comments ([`script`]), images as files for
//! the drive of a board ([`uf2`]).

pub mod board;
pub mod files;
pub mod image;
pub mod machine;
pub mod needs;
pub mod process;
pub mod readme;
pub mod script;
pub mod table;
pub mod uf2;

use std::env;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The folder of the workspace: there lies what images are built from. It is looked for when the program runs, so that a program that
/// is given away holds no path of whoever built it: where [`SOURCES`] says, else around the package that cargo runs, around the
/// program, around the current folder. Where it is nowhere, that is the current folder, and what is built from it says what is missing.
pub fn workspace() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        if let Some(folder) = env::var_os(SOURCES) {
            return folder.into();
        }
        let package = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
        let begin = [package, env::current_exe().ok(), env::current_dir().ok()];
        let mut around = begin.iter().flatten().flat_map(|place| place.ancestors());
        let found = around.find(|folder| folder.join(BOARDS).is_dir());
        found.unwrap_or(Path::new(".")).to_owned()
    })
}

/// The environment variable that names the folder of the workspace, for a program that is installed elsewhere.
pub const SOURCES: &str = "STICTION_SOURCES";

/// The folder with the packages of boards, by which the workspace is known.
const BOARDS: &str = "firmware/boards";
