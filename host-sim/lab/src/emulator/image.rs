//! Images of the firmware: built by cargo, with the solver's share of a board's flash.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};

use stiction_host_sim::firmware::image::{Contents, built, cargo_build};
use stiction_host_sim::firmware::process::EmulatorError;
use stiction_host_sim::firmware::workspace;
use tempfile::TempDir;

use super::Board;

/// How the compiler optimises; the profiles of the workspace.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Profile {
    /// For everyday use on a computer.
    Release,
    /// For few instructions on a board.
    Device,
    /// For small flash size.
    DeviceSmall,
}

impl Profile {
    /// The name for cargo.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Release => "release",
            Self::Device => "device",
            Self::DeviceSmall => "device-small",
        }
    }
}

/// A program built for a machine.
pub(super) struct Image {
    path: PathBuf,
    /// The folder of a private copy, if there is one.
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
    /// A private copy, because the next scene replaces this one.
    pub(super) fn of_scene(
        board: Board,
        binary: &str,
        profile: Profile,
        scene: &str,
    ) -> Result<Self, EmulatorError> {
        /// Images of different boards do not replace each other.
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

    /// A binary of the firmware for this computer, or for a WebAssembly runtime.
    pub(super) fn hosted(
        binary: &str,
        profile: Profile,
        target: Option<&str>,
    ) -> Result<Self, EmulatorError> {
        let mut cargo = cargo(profile, target);
        cargo.args(["--features", "hosted", "--bin", binary]);
        Self::built(cargo)
    }

    fn built(cargo: Command) -> Result<Self, EmulatorError> {
        Ok(Self {
            path: built(cargo)?,
            _folder: None,
        })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Its flash (bytes).
    fn flash(&self) -> Result<u64, EmulatorError> {
        Ok(Contents::of(&self.path)?.flash)
    }
}

/// The flash of a scene's solver on a board (bytes): an image with it, minus the same image without. `scene` is Rust code, see
/// [`rust_source`](stiction_scene::rust_source).
///
/// # Errors
/// Fails if cargo or the target is missing, or the image cannot be built.
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

fn cargo_for(board: Board, binary: &str, profile: Profile) -> Command {
    let mut cargo = cargo(profile, Some(board.target()));
    cargo.args(["--features", "board", "--bin", binary]);
    if board == Board::Rp2040 {
        // Separate from the other board of this target.
        cargo.env("STICTION_CHIP", "rp2040");
        cargo
            .arg("--target-dir")
            .arg(workspace().join("target/rp2040"));
    }
    cargo
}

fn cargo(profile: Profile, target: Option<&str>) -> Command {
    let mut cargo = cargo_build(workspace(), profile.name());
    cargo.args(["--package", "stiction-firmware"]);
    if let Some(target) = target {
        cargo.args(["--target", target]);
    }
    cargo
}
