//! Images of the boards in `firmware/boards`: built by cargo, looked into, written for flashing, and run in emulators.
//!
//! [`board`] has the boards and their emulators, [`image`] builds an image and reads its contents, [`uf2`] writes it for the drive of a
//! board. [`process`] runs other programs, and [`needs`] looks for the tools that all of this takes.

pub mod board;
pub mod image;
pub mod needs;
pub mod process;
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
