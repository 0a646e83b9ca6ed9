//! Images of the firmware: built by cargo, and how much of a board's flash they fill.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};

use object::{Object, ObjectSection, SectionFlags, elf};
use serde_json::Value;
use tempfile::TempDir;

use super::process::{EmulatorError, output_of};
use super::{Board, workspace};

/// How the compiler optimises; the profiles of the workspace.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Profile {
    /// For finding errors.
    Dev,
    /// For everyday use on a computer.
    Release,
    /// For few instructions on a board.
    Device,
    /// For little flash.
    DeviceSmall,
}

impl Profile {
    /// The name that cargo knows.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dev => "dev",
            Self::Release => "release",
            Self::Device => "device",
            Self::DeviceSmall => "device-small",
        }
    }
}

/// A program built for a machine.
pub(super) struct Image {
    path: PathBuf,
    /// Where it lies, if nobody else shall have it.
    _folder: Option<TempDir>,
}

impl Image {
    /// A binary of the firmware for a board.
    pub(super) fn of_board(
        board: Board,
        binary: &str,
        profile: Profile,
    ) -> Result<Self, EmulatorError> {
        Self::built(cargo_for(board, binary, profile))
    }

    /// A binary of the firmware for a board with a scene compiled in: Rust code, see [`rust_source`](stiction_scene::rust_source).
    /// A copy of its own, as the next scene takes the place of this one.
    pub(super) fn of_scene(
        board: Board,
        binary: &str,
        profile: Profile,
        scene: &str,
    ) -> Result<Self, EmulatorError> {
        /// Images of different boards do not take each other's place.
        static BUILDING: [Mutex<()>; Board::ALL.len()] =
            [const { Mutex::new(()) }; Board::ALL.len()];
        let folder = tempfile::tempdir()?;
        let code = folder.path().join("scene.rs");
        fs::write(&code, scene)?;
        let mut cargo = cargo_for(board, binary, profile);
        cargo.env("STICTION_SCENE_CODE", &code);
        let path = folder.path().join(binary);
        let building = BUILDING[board as usize]
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        fs::copy(Self::built(cargo)?.path, &path)?;
        drop(building);
        Ok(Self {
            path,
            _folder: Some(folder),
        })
    }

    /// An example of the firmware for a target, or for this computer.
    pub(super) fn of_example(
        example: &str,
        profile: Profile,
        target: Option<&str>,
    ) -> Result<Self, EmulatorError> {
        let mut cargo = cargo(profile, target);
        cargo.args(["--example", example]);
        Self::built(cargo)
    }

    /// The file of the last program that cargo speaks of.
    fn built(cargo: Command) -> Result<Self, EmulatorError> {
        let messages = output_of(cargo)?;
        match messages.lines().rev().find_map(artifact) {
            Some(path) => Ok(Self {
                path,
                _folder: None,
            }),
            None => Err(EmulatorError::Output("cargo names no image".to_owned())),
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The flash that it takes (bytes): instructions, constants, the first values of variables.
    fn flash(&self) -> Result<u64, EmulatorError> {
        let bytes = fs::read(&self.path)?;
        let file = object::File::parse(&*bytes)
            .map_err(|error| EmulatorError::Output(error.to_string()))?;
        let sections = file.sections().filter(|section| match section.flags() {
            SectionFlags::Elf { sh_type, sh_flags } => {
                sh_type != elf::SHT_NOBITS && sh_flags.contains(elf::SHF_ALLOC)
            }
            _ => false,
        });
        Ok(sections.map(|section| section.size()).sum())
    }
}

/// The flash that the solver of a scene takes on a board (bytes): an image with it, less the same image without. `scene`
/// is Rust code, see [`rust_source`](stiction_scene::rust_source).
///
/// # Errors
/// Cargo or the target is missing, or the image cannot be built.
pub fn footprint(board: Board, profile: Profile, scene: &str) -> Result<u64, EmulatorError> {
    let whole = Image::of_scene(board, "footprint", profile, scene)?.flash()?;
    Ok(whole.saturating_sub(baseline(board, profile)?))
}

/// The flash of the image without a solver (bytes): the same for every scene, so it is built once.
fn baseline(board: Board, profile: Profile) -> Result<u64, EmulatorError> {
    static KNOWN: Mutex<Vec<(Board, Profile, u64)>> = Mutex::new(Vec::new());
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let wanted = |(b, p, _): &&(Board, Profile, u64)| (*b, *p) == (board, profile);
    if let Some((_, _, flash)) = known.iter().find(wanted) {
        return Ok(*flash);
    }
    let flash = Image::of_board(board, "footprint_baseline", profile)?.flash()?;
    known.push((board, profile, flash));
    Ok(flash)
}

/// The image of a folder in `firmware/boards`, without a log. The settings of the build are those of the folder.
pub(crate) fn board_image(board: &str) -> Result<PathBuf, EmulatorError> {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(workspace().join("firmware/boards").join(board));
    cargo.args(["build", "--locked", "--profile", Profile::Device.name()]);
    cargo.args([
        "--no-default-features",
        "--message-format=json-render-diagnostics",
    ]);
    Image::built(cargo).map(|image| image.path)
}

/// Builds a binary of the firmware for a board.
fn cargo_for(board: Board, binary: &str, profile: Profile) -> Command {
    let mut cargo = cargo(profile, Some(board.target()));
    cargo.args(["--features", "board", "--bin", binary]);
    cargo
}

/// Builds something of the firmware.
fn cargo(profile: Profile, target: Option<&str>) -> Command {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(workspace());
    cargo.args(["build", "--locked", "--package", "stiction-firmware"]);
    cargo.args(["--profile", profile.name()]);
    if let Some(target) = target {
        cargo.args(["--target", target]);
    }
    cargo.arg("--message-format=json-render-diagnostics");
    cargo
}

/// The file in a message of cargo, if the message is of a finished program.
fn artifact(message: &str) -> Option<PathBuf> {
    let message: Value = serde_json::from_str(message).ok()?;
    if message["reason"] != "compiler-artifact" {
        return None;
    }
    if let Some(executable) = message["executable"].as_str() {
        return Some(executable.into());
    }
    let mut files = message["filenames"].as_array()?.iter();
    files
        .find_map(|file| file.as_str().filter(|name| name.ends_with(".wasm")))
        .map(PathBuf::from)
}
