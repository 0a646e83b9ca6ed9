//! Common parts of programs and tests that measure: the boards in QEMU ([`board`]), the contents of their images ([`image`]), external
//! programs ([`process`]), the tools that building and emulating need ([`needs`]), sections of a README ([`readme`]), files that are
//! written completely ([`files`]), text in columns ([`table`]), the name of the machine ([`machine`]), scripts without their comments
//! ([`script`]), images as files for the drive of a board ([`uf2`]).

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

/// The folder of the workspace, which contains the sources of images. It is searched for at run time, so that a distributed program
/// contains no path of the machine that built it: [`SOURCES`] names it, or it is around the package that cargo runs, around the program, or
/// around the current folder. If it is not found, this is the current folder, and a later build reports what is missing.
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

/// The folder with the package of the boards, which identifies the workspace.
const BOARDS: &str = "firmware/boards";
