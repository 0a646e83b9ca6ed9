//! An emulated board: builds its image, starts the emulator, and ends it when this value is dropped.

use std::fs;
use std::thread;
use std::time::{Duration, Instant};

use crate::firmware::board::{Board, RunningBoard};
use crate::firmware::process::EmulatorError;
use clap::ValueEnum;

use super::link::Link;
use crate::progress::Activity;
use crate::stop;

/// The emulator opens its socket quickly, or not at all.
const OPENING: Duration = Duration::from_secs(20);

/// The device with numbers that are stored.
const KNOB: &str = "knob";

/// A board that can be emulated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum EmulatedBoard {
    /// STM32F405, Cortex-M4F: f32
    #[default]
    #[value(name = "olimex-stm32-h405")]
    Olimex,
    /// nRF51822, Cortex-M0: fixed point
    Microbit,
    /// RP2040, Cortex-M0+: fixed point
    Pico,
    /// Cortex-M33, in the place of the RP2350 of a Pico 2: f32
    #[value(name = "mps2-an505", alias = "an505")]
    An505,
}

impl EmulatedBoard {
    const fn board(self) -> Board {
        match self {
            Self::Olimex => Board::OLIMEX,
            Self::Microbit => Board::MICROBIT,
            Self::Pico => Board::PICO,
            Self::An505 => Board::AN505,
        }
    }

    /// The name of its folder in `firmware/boards`.
    pub(super) const fn name(self) -> &'static str {
        self.board().name
    }

    /// Whether it has pins for a knob.
    pub(super) fn has_knob(self) -> bool {
        self.board().devices.contains(&KNOB)
    }

    pub(super) const fn emulator(self) -> &'static str {
        self.board().emulator()
    }
}

/// The image that an emulated board runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Image<'a> {
    /// The image for every board.
    Plain,
    /// The image for this scene file, which has obstacles.
    Obstacles(&'a str),
    /// The image with a knob.
    Knob,
}

#[derive(Debug)]
pub(super) struct Emulator {
    board: EmulatedBoard,
    started: RunningBoard,
}

impl Emulator {
    /// Builds the image and starts it; it runs as soon as its line is opened.
    pub(super) fn start(board: EmulatedBoard, image: Image<'_>) -> Result<Self, EmulatorError> {
        board.board().require_emulator()?;
        let building = Activity::begin(format!("building the image of {}", board.name()));
        let image = match image {
            Image::Obstacles(scene) if !board.board().takes_obstacles() => {
                let folder = tempfile::tempdir()?;
                let file = folder.path().join("scene.toml");
                fs::write(&file, scene)?;
                board.board().small_image(&file)?
            }
            Image::Plain | Image::Obstacles(_) => board.board().image("", None)?,
            Image::Knob => board.board().image(KNOB, None)?,
        };
        building.end();
        // Its clock follows the real one.
        // Ctrl-C is for this program, which ends the emulator when it has the last poses.
        let started = RunningBoard::start(board.board(), &image, "shift=auto", true)?;
        Ok(Self { board, started })
    }

    pub(super) const fn board(&self) -> EmulatedBoard {
        self.board
    }

    pub(super) fn open(&mut self) -> Result<Link, EmulatorError> {
        let begun = Instant::now();
        loop {
            self.started.runs()?;
            match Link::socket(&self.started.line()) {
                Ok(link) => return Ok(link),
                Err(error) if begun.elapsed() > OPENING || stop::asked() => {
                    return Err(error.into());
                }
                Err(_) => thread::sleep(Duration::from_millis(10)),
            }
        }
    }
}
