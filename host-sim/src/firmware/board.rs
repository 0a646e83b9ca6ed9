//! The boards of `firmware/boards`, emulated: the image is built, and the emulator runs, with the serial line on its own socket, until the
//! value [`RunningBoard`] is dropped. The Pico runs in a program of the package `stiction-lab`, which is built for it, the others in QEMU. The
//! Pico 2 has no emulator: another board in QEMU stands in for it.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;

use super::image::{RAM, built, cargo_build, flashed};
use super::needs::{Need, require};
use super::process::EmulatorError;
use super::uf2::Family;
use super::{BOARDS, workspace};

/// QEMU for the boards that it knows.
const QEMU: &str = "qemu-system-arm";
/// The package and the program that emulate the Pico.
const PICO: [&str; 2] = ["stiction-lab", "emulated-pico"];
/// The start of its flash.
const PICO_FLASH: u32 = 0x1000_0000;
/// The profile with which that program is built: that of this program, so that they share what both need.
const PICO_PROFILE: &str = match cfg!(debug_assertions) {
    true => "dev",
    false => "release",
};

/// The sockets of an emulator, in its folder: the serial line, and the monitor, which answers the command `memsave` of QEMU.
const LINE: &str = "line";
/// See [`LINE`].
const MONITOR: &str = "monitor";

/// A board with an emulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Board {
    /// The name of its folder in `firmware/boards`, and of its machine in QEMU.
    pub name: &'static str,
    /// The start of its RAM; with flip-link the stack grows down to here.
    pub ram: u64,
    /// The family of its chip, if the chip is flashed through a drive.
    pub family: Option<Family>,
    /// Features of the boards' package that add a device at its pins.
    pub devices: &'static [&'static str],
    /// What the compiler calls its processor.
    target: &'static str,
    runs_in: RunsIn,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RunsIn {
    Qemu {
        /// Serial lines of the machine before the one that the image uses.
        unused_lines: usize,
    },
    Lab,
    Nothing,
}

impl Board {
    /// Olimex STM32-H405: STM32F405, Cortex-M4F.
    pub const OLIMEX: Self = Self {
        name: "olimex-stm32-h405",
        ram: RAM,
        family: None,
        devices: &["pantograph"],
        target: "thumbv7em-none-eabihf",
        runs_in: RunsIn::Qemu { unused_lines: 1 },
    };
    /// BBC micro:bit: nRF51822, Cortex-M0.
    pub const MICROBIT: Self = Self {
        name: "microbit",
        ram: RAM,
        family: None,
        devices: &[],
        target: "thumbv6m-none-eabi",
        runs_in: RunsIn::Qemu { unused_lines: 0 },
    };
    /// Raspberry Pi Pico: RP2040, Cortex-M0+.
    pub const PICO: Self = Self {
        name: "pico",
        ram: RAM,
        family: Some(Family::RP2040),
        devices: &["knob", "pantograph"],
        target: "thumbv6m-none-eabi",
        runs_in: RunsIn::Lab,
    };
    /// Raspberry Pi Pico 2: RP2350, Cortex-M33. It can be built, not emulated.
    pub const PICO2: Self = Self {
        name: "pico2",
        ram: RAM,
        family: Some(Family::RP2350_ARM_S),
        devices: &["knob", "pantograph"],
        target: "thumbv8m.main-none-eabihf",
        runs_in: RunsIn::Nothing,
    };
    /// Arm MPS2+ with the FPGA image AN505: Cortex-M33. It stands in for the Pico 2.
    pub const AN505: Self = Self {
        name: "mps2-an505",
        ram: 0x3800_0000,
        family: None,
        devices: &[],
        target: "thumbv8m.main-none-eabihf",
        runs_in: RunsIn::Qemu { unused_lines: 0 },
    };

    /// All boards that one can own.
    pub const ALL: [Self; 4] = [Self::OLIMEX, Self::MICROBIT, Self::PICO, Self::PICO2];

    /// Whether it has enough memory for obstacles over the wire; otherwise it has memory only for those of a compiled-in scene, in an image
    /// for small flash.
    pub fn takes_obstacles(self) -> bool {
        self != Self::MICROBIT
    }

    /// Its folder in the boards' package, with its build settings.
    pub fn folder(self) -> PathBuf {
        workspace().join(BOARDS).join(self.name)
    }

    /// Builds its image without a log, with features of the boards' package (in cargo's syntax, or ""), with a scene file compiled in or
    /// its own scene. The build settings are those of the folder. The next image replaces this one.
    ///
    /// # Errors
    /// A build tool is missing, or the image cannot be built.
    pub fn image(self, features: &str, scene: Option<&Path>) -> Result<PathBuf, EmulatorError> {
        self.image_by("device", features, scene)
    }

    /// Builds its image for small flash, with a scene file compiled in: for a chip that a scene with obstacles would overflow.
    ///
    /// # Errors
    /// As [`Board::image`].
    pub fn small_image(self, scene: &Path) -> Result<PathBuf, EmulatorError> {
        self.image_by("device-small", "", Some(scene))
    }

    /// Builds the image with a profile of the workspace.
    fn image_by(
        self,
        profile: &str,
        features: &str,
        scene: Option<&Path>,
    ) -> Result<PathBuf, EmulatorError> {
        let mut cargo = cargo_build(&self.folder(), profile);
        let name = self.name;
        cargo.args([
            "--bin",
            &format!("stiction-{name}"),
            "--no-default-features",
        ]);
        cargo.args(["--features", &format!("{name},{features}")]);
        if let Some(scene) = scene {
            cargo.env("STICTION_SCENE", scene);
        }
        built(cargo)
    }

    /// The name of its emulator.
    pub const fn emulator(self) -> &'static str {
        match self.runs_in {
            RunsIn::Qemu { .. } => "QEMU",
            RunsIn::Lab => "this program",
            RunsIn::Nothing => "nothing",
        }
    }

    /// Checks that the tools that build its image are installed.
    ///
    /// # Errors
    /// Something is missing; everything that is gets named.
    pub fn require_build(self) -> Result<(), EmulatorError> {
        require(self.needs())
    }

    /// Checks that the tools that build its image are installed, and its emulator, if it has one.
    ///
    /// # Errors
    /// As [`Board::require_build`].
    pub fn require_emulator(self) -> Result<(), EmulatorError> {
        let is_qemu = matches!(self.runs_in, RunsIn::Qemu { .. });
        let emulator = is_qemu.then_some(Need::QemuArm);
        require(self.needs().into_iter().chain(emulator))
    }

    const fn needs(self) -> [Need; 3] {
        [Need::Build, Need::Target(self.target), Need::FlipLink]
    }

    /// The command that runs QEMU with an image.
    fn qemu(self, unused_lines: usize, image: &Path, clock: &str) -> Command {
        let mut qemu = Command::new(QEMU);
        qemu.args(["-M", self.name, "-display", "none", "-icount", clock]);
        qemu.args(["-monitor", "unix:monitor,server=on,wait=off"]);
        for _ in 0..unused_lines {
            qemu.args(["-serial", "null"]);
        }
        qemu.args(["-serial", "unix:line,server=on,wait=on"]);
        qemu.arg("-kernel").arg(image);
        qemu
    }
}

/// A running emulator.
#[derive(Debug)]
pub struct RunningBoard {
    program: String,
    process: Child,
    folder: TempDir,
}

impl RunningBoard {
    /// Starts the emulator of a board with an image, which runs as soon as its line is opened. `clock` sets the pace of QEMU's
    /// clock, in the syntax of -icount; without it, ticks are lost. The emulated Pico follows the real clock. `is_apart`:
    /// Ctrl-C reaches only this program.
    ///
    /// # Errors
    /// It cannot be built or started.
    pub fn start(
        board: Board,
        image: &Path,
        clock: &str,
        is_apart: bool,
    ) -> Result<Self, EmulatorError> {
        let folder = tempfile::tempdir()?;
        let mut emulator = match board.runs_in {
            RunsIn::Qemu { unused_lines } => board.qemu(unused_lines, image, clock),
            RunsIn::Lab => pico(image, folder.path())?,
            RunsIn::Nothing => {
                let name = board.name;
                return Err(EmulatorError::Output(format!("{name} has no emulator")));
            }
        };
        emulator
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        #[cfg(unix)]
        if is_apart {
            std::os::unix::process::CommandExt::process_group(&mut emulator, 0);
        }
        #[cfg(windows)]
        if is_apart {
            /// CREATE_NEW_PROCESS_GROUP: its processes do not receive Ctrl-C.
            const NEW_GROUP: u32 = 0x200;
            std::os::windows::process::CommandExt::creation_flags(&mut emulator, NEW_GROUP);
        }
        let program = emulator.get_program().to_string_lossy().into_owned();
        let process = emulator.spawn()?;
        Ok(Self {
            program,
            process,
            folder,
        })
    }

    /// The socket of its line.
    pub fn line(&self) -> PathBuf {
        self.folder.path().join(LINE)
    }

    /// The socket of its monitor. The command `memsave FROM SIZE FILE` writes a range of its memory to a file beside the socket.
    pub fn monitor(&self) -> PathBuf {
        self.folder.path().join(MONITOR)
    }

    /// Checks that it is running.
    ///
    /// # Errors
    /// It has ended; the error contains the reason.
    pub fn runs(&mut self) -> Result<(), EmulatorError> {
        let Some(status) = self.process.try_wait()? else {
            return Ok(());
        };
        let mut message = String::from("\n");
        if let Some(text) = &mut self.process.stderr {
            text.read_to_string(&mut message)?;
        }
        Err(EmulatorError::Failed {
            program: self.program.clone(),
            status,
            message: message.trim_end().to_owned(),
        })
    }
}

/// The program that emulates the Pico, with an image, whose flash is written to a folder. It is built if it is not yet.
fn pico(image: &Path, folder: &Path) -> Result<Command, EmulatorError> {
    let flash = folder.join("flash");
    fs::write(&flash, flashed(image, PICO_FLASH)?)?;
    let [package, program] = PICO;
    let mut cargo = cargo_build(workspace(), PICO_PROFILE);
    cargo.args(["--package", package, "--bin", program]);
    cargo.arg("--no-default-features");
    let mut pico = Command::new(built(cargo)?);
    pico.arg(flash);
    Ok(pico)
}

impl Drop for RunningBoard {
    fn drop(&mut self) {
        // It may have ended on its own.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
