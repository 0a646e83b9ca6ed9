//! The boards of `firmware/boards`, emulated: the image is built, and the emulator runs, with the serial line on its own socket, until the
//! value [`Emulator`] is dropped. The Pico runs in this process, the others in QEMU. The Pico 2 has no emulator: another board in QEMU
//! stands in for it.

#[cfg(unix)]
use std::fs;
use std::io::Read;
#[cfg(unix)]
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;

use crate::image::{RAM, built, cargo_build};
use crate::needs::{Need, require};
use crate::process::EmulatorError;
use crate::uf2::Family;
use crate::{BOARDS, workspace};

/// QEMU for the boards that it knows.
const QEMU: &str = "qemu-system-arm";

/// The socket of an emulator's line, in its folder.
const LINE: &str = "line";

/// The feature of the boards' package that adds capacity for obstacles.
pub const OBSTACLES: &str = "obstacles";

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

/// The emulator of a board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RunsIn {
    /// QEMU.
    Qemu {
        /// Serial lines of the machine before the one that the image uses.
        unused_lines: usize,
    },
    /// This process.
    Program,
    /// Nothing.
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
        runs_in: RunsIn::Program,
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

    /// Whether it has enough memory for obstacles over the wire, with the feature [`OBSTACLES`]; otherwise it has memory only for those
    /// of a compiled-in scene, in an image for small flash.
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

    /// Builds the image for small flash: for a chip that a scene with obstacles would overflow.
    ///
    /// # Errors
    /// As for [`Board::image`].
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
            RunsIn::Program => "this program",
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
        qemu.stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        qemu
    }
}

/// A running emulator.
#[derive(Debug)]
pub struct Emulator {
    runs: Runs,
    folder: TempDir,
}

/// The process or thread that emulates a board.
#[derive(Debug)]
enum Runs {
    Qemu(Child),
    #[cfg(all(unix, feature = "pico"))]
    Pico(stiction_emulated_pico::Board),
}

impl Emulator {
    /// Starts the emulator of a board with an image, which runs as soon as its line is opened. `clock` sets the pace of QEMU's
    /// clock, in the syntax of -icount; without it, ticks are lost. An emulator in this process follows the real clock. `is_apart`:
    /// Ctrl-C reaches only this program.
    ///
    /// # Errors
    /// It cannot be started.
    pub fn start(
        board: Board,
        image: &Path,
        clock: &str,
        is_apart: bool,
    ) -> Result<Self, EmulatorError> {
        let folder = tempfile::tempdir()?;
        let runs = match board.runs_in {
            RunsIn::Qemu { unused_lines } => {
                let mut qemu = board.qemu(unused_lines, image, clock);
                qemu.current_dir(folder.path());
                #[cfg(unix)]
                if is_apart {
                    std::os::unix::process::CommandExt::process_group(&mut qemu, 0);
                }
                Runs::Qemu(qemu.spawn()?)
            }
            RunsIn::Program => pico(image, &folder.path().join(LINE))?,
            RunsIn::Nothing => {
                let name = board.name;
                return Err(EmulatorError::Output(format!("{name} has no emulator")));
            }
        };
        Ok(Self { runs, folder })
    }

    /// The socket of its line.
    pub fn line(&self) -> PathBuf {
        self.folder.path().join(LINE)
    }

    /// Checks that it is running.
    ///
    /// # Errors
    /// It has ended; the error contains the reason.
    pub fn runs(&mut self) -> Result<(), EmulatorError> {
        let process = match &mut self.runs {
            Runs::Qemu(process) => process,
            #[cfg(all(unix, feature = "pico"))]
            Runs::Pico(_) => return Ok(()),
        };
        let Some(status) = process.try_wait()? else {
            return Ok(());
        };
        let mut message = String::from("\n");
        if let Some(text) = &mut process.stderr {
            text.read_to_string(&mut message)?;
        }
        Err(EmulatorError::Failed {
            program: QEMU.to_owned(),
            status,
            message: message.trim_end().to_owned(),
        })
    }

    /// A range of its memory that starts at the address `from`; `meanwhile` is called while waiting for it.
    ///
    /// # Errors
    /// QEMU does not return it.
    #[cfg(unix)]
    pub fn memory(
        &self,
        from: u64,
        size: usize,
        mut meanwhile: impl FnMut(),
    ) -> Result<Vec<u8>, EmulatorError> {
        match &self.runs {
            Runs::Qemu(_) => {
                let file = self.folder.path().join("memory");
                let monitor = self.folder.path().join("monitor");
                let mut monitor = std::os::unix::net::UnixStream::connect(monitor)?;
                writeln!(monitor, "memsave {from} {size} memory")?;
                loop {
                    let bytes = fs::read(&file).unwrap_or_default();
                    if bytes.len() == size {
                        fs::remove_file(&file)?;
                        return Ok(bytes);
                    }
                    meanwhile();
                }
            }
            #[cfg(feature = "pico")]
            Runs::Pico(board) => {
                let bytes = board.look(move |chip| chip.bytes(from as u32, size as u32));
                bytes.ok_or_else(|| EmulatorError::Output("the Pico has ended".to_owned()))
            }
        }
    }
}

/// The Pico with an image.
#[cfg(all(unix, feature = "pico"))]
fn pico(image: &Path, line: &Path) -> Result<Runs, EmulatorError> {
    let flash = crate::image::flashed(image, stiction_emulated_pico::FLASH)?;
    Ok(Runs::Pico(stiction_emulated_pico::Board::start(
        flash, line,
    )?))
}

/// An error in place of the Pico with an image: the Pico is not compiled in, or there are no unix sockets for its line.
#[cfg(not(all(unix, feature = "pico")))]
fn pico(_: &Path, _: &Path) -> Result<Runs, EmulatorError> {
    Err(no_pico())
}

/// The emulated Pico is not compiled in.
pub fn no_pico() -> EmulatorError {
    EmulatorError::Missing {
        what: "the emulated Pico".to_owned(),
        install: "the same command with --features stiction-host-sim/cycles, on a system with unix sockets"
            .to_owned(),
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        match &mut self.runs {
            Runs::Qemu(process) => {
                // It may have ended on its own.
                let _ = process.kill();
                let _ = process.wait();
            }
            // It ends when its value is dropped.
            #[cfg(all(unix, feature = "pico"))]
            Runs::Pico(_) => {}
        }
    }
}
