//! A board in QEMU: its image is built, the emulator started with the serial line on a socket of its own, and ended with
//! this value.

use std::io::Read;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use tempfile::TempDir;

use super::link::Link;
use super::stop;
use crate::emulator::{self, EmulatorError};

/// The emulator opens its socket at once, or not at all.
const OPENING: Duration = Duration::from_secs(20);

/// A board that QEMU knows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum EmulatedBoard {
    /// STM32F405, Cortex-M4F: f32
    #[default]
    #[value(name = "olimex-stm32-h405")]
    Olimex,
    /// nRF51822, Cortex-M0: fixed point
    Microbit,
}

impl EmulatedBoard {
    /// The name of its folder in `firmware/boards`, and of its machine in QEMU.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Olimex => "olimex-stm32-h405",
            Self::Microbit => "microbit",
        }
    }

    /// Serial lines of the machine before the one that the image uses.
    const fn lines_before(self) -> usize {
        match self {
            Self::Olimex => 1,
            Self::Microbit => 0,
        }
    }
}

/// A running emulator.
#[derive(Debug)]
pub(super) struct Emulator {
    board: EmulatedBoard,
    process: Child,
    folder: TempDir,
}

impl Emulator {
    /// Builds the image and starts it; it runs as soon as its line is opened.
    pub(super) fn start(board: EmulatedBoard) -> Result<Self, EmulatorError> {
        emulator::require_qemu_arm()?;
        eprintln!("building the image of {} ...", board.name());
        let image = emulator::board_image(board.name())?;
        let folder = tempfile::tempdir()?;
        let socket = folder.path().join("line");
        let mut qemu = Command::new("qemu-system-arm");
        qemu.args(["-M", board.name(), "-display", "none", "-monitor", "none"]);
        for _ in 0..board.lines_before() {
            qemu.args(["-serial", "null"]);
        }
        let line = format!("unix:{},server=on,wait=on", socket.display());
        // Its clock goes with the real one; with none at all, ticks are lost.
        qemu.args(["-serial", &line, "-icount", "shift=auto"]);
        qemu.arg("-kernel").arg(image);
        qemu.stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        // Ctrl-C is for this program, which ends the emulator when it has the last poses.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut qemu, 0);
        Ok(Self {
            board,
            process: qemu.spawn()?,
            folder,
        })
    }

    pub(super) const fn board(&self) -> EmulatedBoard {
        self.board
    }

    fn socket(&self) -> PathBuf {
        self.folder.path().join("line")
    }

    /// A line to the board.
    pub(super) fn open(&mut self) -> Result<Link, EmulatorError> {
        let begun = Instant::now();
        loop {
            if let Some(status) = self.process.try_wait()? {
                let mut message = String::from("\n");
                if let Some(text) = &mut self.process.stderr {
                    text.read_to_string(&mut message)?;
                }
                return Err(EmulatorError::Failed {
                    program: "qemu-system-arm".to_owned(),
                    status,
                    message: message.trim_end().to_owned(),
                });
            }
            match Link::socket(&self.socket()) {
                Ok(link) => return Ok(link),
                Err(error) if begun.elapsed() > OPENING || stop::asked() => {
                    return Err(error.into());
                }
                Err(_) => thread::sleep(Duration::from_millis(10)),
            }
        }
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
