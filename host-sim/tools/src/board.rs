//! The boards of `firmware/boards`, emulated: the image is built, the emulator started with the serial line on a socket of its own, and
//! ended with the value [`Emulator`]. The Pico runs in this process, the others in QEMU. The Pico 2 has no emulator: in QEMU another board
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

/// The line of an emulator, in its folder.
const LINE: &str = "line";

/// The feature of a board's package that gives it room for obstacles.
pub const OBSTACLES: &str = "obstacles";

/// A board with an emulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Board {
    /// Of its folder in `firmware/boards`, and of its machine in QEMU.
    pub name: &'static str,
    /// Where its RAM begins; with flip-link the stack grows down to here.
    pub ram: u64,
    /// Of its chip, where that is flashed by a drive.
    pub family: Option<Family>,
    /// Features of its package that give it a device at its pins.
    pub devices: &'static [&'static str],
    /// What the compiler calls its processor.
    target: &'static str,
    runs_in: RunsIn,
}

/// What emulates a board.
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

    /// All that there are to own.
    pub const ALL: [Self; 4] = [Self::OLIMEX, Self::MICROBIT, Self::PICO, Self::PICO2];

    /// It has the memory for obstacles over the wire, with the feature [`OBSTACLES`]; otherwise for those of a scene that is compiled in
    /// alone, in an image for little flash.
    pub fn takes_obstacles(self) -> bool {
        self != Self::MICROBIT
    }

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

    /// What it is emulated by.
    pub const fn emulator(self) -> &'static str {
        match self.runs_in {
            RunsIn::Qemu { .. } => "QEMU",
            RunsIn::Program => "this program",
            RunsIn::Nothing => "nothing",
        }
    }

    /// What builds its image is there.
    ///
    /// # Errors
    /// Something is missing; everything that is gets named.
    pub fn require_build(self) -> Result<(), EmulatorError> {
        require(self.needs())
    }

    /// The same, and its emulator, if it has one.
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

    /// QEMU with an image.
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

/// What emulates a board.
#[derive(Debug)]
enum Runs {
    Qemu(Child),
    #[cfg(all(unix, feature = "pico"))]
    Pico(stiction_emulated_pico::Board),
}

impl Emulator {
    /// Starts the emulator of a board with an image, which runs as soon as its line is opened. `clock` is how fast the clock of QEMU
    /// goes, as its -icount says it; with none at all, ticks are lost. What is emulated in this process goes with the real clock.
    /// `is_apart`: Ctrl-C is for this program alone.
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

    /// It runs.
    ///
    /// # Errors
    /// It has ended, and says why.
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

    /// A piece of its memory, `from` an address on; `meanwhile` is called while it does not come.
    ///
    /// # Errors
    /// QEMU does not give it.
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

/// The Pico with an image: it is not compiled in, or there are no unix sockets for its line.
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
                // It may have ended by itself.
                let _ = process.kill();
                let _ = process.wait();
            }
            // It ends with its value.
            #[cfg(all(unix, feature = "pico"))]
            Runs::Pico(_) => {}
        }
    }
}
