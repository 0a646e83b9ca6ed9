//! The boards of `firmware/boards` in QEMU: the image is built, the emulator started with the serial line and its monitor on
//! sockets of its own, and ended with the value [`Emulator`].

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;

use crate::image::{built, cargo_build};
use crate::process::EmulatorError;
use crate::{BOARDS, workspace};

/// QEMU for both boards.
const QEMU: &str = "qemu-system-arm";

/// The feature of the F405's package that gives it room for obstacles.
pub const OBSTACLES: &str = "obstacles";

/// A board with an emulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Board {
    /// Of its folder in `firmware/boards`, and of its machine in QEMU.
    pub name: &'static str,
    /// Serial lines of the machine before the one that the image uses.
    unused_lines: usize,
}

impl Board {
    /// Olimex STM32-H405: STM32F405, Cortex-M4F.
    pub const OLIMEX: Self = Self {
        name: "olimex-stm32-h405",
        unused_lines: 1,
    };
    /// BBC micro:bit: nRF51822, Cortex-M0.
    pub const MICROBIT: Self = Self {
        name: "microbit",
        unused_lines: 0,
    };

    /// The folder of its package.
    pub fn folder(self) -> PathBuf {
        workspace().join(BOARDS).join(self.name)
    }

    /// Builds its image without a log, with features of its package (as cargo takes them, or ""), with a scene file compiled in or
    /// its own scene. The settings of the build are those of the folder. The next image takes its place.
    ///
    /// # Errors
    /// Something that builds it is missing, or it cannot be built.
    pub fn image(self, features: &str, scene: Option<&Path>) -> Result<PathBuf, EmulatorError> {
        self.image_by("device", features, scene)
    }

    /// The same for little flash: of a chip that a scene with obstacles would overflow.
    ///
    /// # Errors
    /// As [`Board::image`].
    pub fn small_image(self, scene: &Path) -> Result<PathBuf, EmulatorError> {
        self.image_by("device-small", "", Some(scene))
    }

    /// By a profile of the workspace.
    fn image_by(
        self,
        profile: &str,
        features: &str,
        scene: Option<&Path>,
    ) -> Result<PathBuf, EmulatorError> {
        let mut cargo = cargo_build(&self.folder(), profile);
        cargo.args(["--no-default-features", "--features", features]);
        if let Some(scene) = scene {
            cargo.env("STICTION_SCENE", scene);
        }
        built(cargo)
    }

    /// QEMU with an image, for [`Emulator::start`]. `clock` is how fast its clock goes, as QEMU's -icount says it; with none at all,
    /// ticks are lost.
    pub fn emulator(self, image: &Path, clock: &str) -> Command {
        let mut qemu = Command::new(QEMU);
        qemu.args(["-M", self.name, "-display", "none", "-icount", clock]);
        qemu.args(["-monitor", "unix:monitor,server=on,wait=off"]);
        for _ in 0..self.unused_lines {
            qemu.args(["-serial", "null"]);
        }
        qemu.args(["-serial", "unix:line,server=on,wait=on"]);
        qemu.arg("-kernel").arg(image);
        qemu.stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        qemu
    }
}

/// A running emulator.
#[derive(Debug)]
pub struct Emulator {
    process: Child,
    folder: TempDir,
}

impl Emulator {
    /// Starts what [`Board::emulator`] gives; the image runs as soon as the line is opened.
    ///
    /// # Errors
    /// QEMU cannot be started.
    pub fn start(mut qemu: Command) -> Result<Self, EmulatorError> {
        let folder = tempfile::tempdir()?;
        let process = qemu.current_dir(folder.path()).spawn()?;
        Ok(Self { process, folder })
    }

    /// A file of its working folder: the sockets are `line` and `monitor`.
    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// It runs.
    ///
    /// # Errors
    /// It has ended, and says why.
    pub fn runs(&mut self) -> Result<(), EmulatorError> {
        let Some(status) = self.process.try_wait()? else {
            return Ok(());
        };
        let mut message = String::from("\n");
        if let Some(text) = &mut self.process.stderr {
            text.read_to_string(&mut message)?;
        }
        Err(EmulatorError::Failed {
            program: QEMU.to_owned(),
            status,
            message: message.trim_end().to_owned(),
        })
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
