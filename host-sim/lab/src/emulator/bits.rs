//! The walk of the hand on every machine: from a number of frames to the hash of all bits, see [`stiction_firmware::bits`].

use std::path::Path;
use std::process::Command;

use stiction_host_sim::firmware::process::{EmulatorError, output_of};
use stiction_scene::NumberType;

use super::Board;
use super::image::{Image, Profile};

/// A machine whose bits are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Machine {
    /// This computer, a release build: debug builds are what the tests themselves are.
    Release,
    /// An emulated board.
    Board(Board),
    /// WebAssembly, in Node.
    WebAssembly,
}

/// The place where the hand walks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Place {
    /// Next to a floor and a wall.
    ByWalls,
    /// Among obstacles with corners.
    AmongObstacles,
}

impl Place {
    /// Both.
    pub const ALL: [Self; 2] = [Self::ByWalls, Self::AmongObstacles];
}

impl Machine {
    /// All machines.
    pub const ALL: [Self; 7] = [
        Self::Release,
        Self::Board(Board::Stm32F405),
        Self::Board(Board::Nrf51822),
        Self::Board(Board::RiscV),
        Self::Board(Board::An505),
        Self::Board(Board::Rp2040),
        Self::WebAssembly,
    ];

    /// The name for a reader.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Release => "this computer, release",
            Self::Board(board) => board.name(),
            Self::WebAssembly => "WebAssembly",
        }
    }

    /// The hash of all answers of a walk of `frames` frames in a place.
    ///
    /// # Errors
    /// Fails if a program is missing, the image cannot be built, or its run ends with an error.
    pub fn bits(self, number: NumberType, place: Place, frames: u32) -> Result<u64, EmulatorError> {
        // For so many instructions as the other programs have, this one has not the flash on the smallest chip.
        let (name, profile) = match place {
            Place::ByWalls => (number.name().to_owned(), Profile::Device),
            Place::AmongObstacles => (format!("among_{}", number.name()), Profile::DeviceSmall),
        };
        let (name, frames) = (name.as_str(), frames.to_string());
        let text = match self {
            Self::Release => on_this_computer([name, &frames])?,
            Self::Board(board) => {
                let image = Image::of_board(board, &format!("bits_{name}"), profile)?;
                // It has no files.
                board.run(&image, (Path::new("."), &["bits", &frames]), false)?
            }
            Self::WebAssembly => in_node([name, &frames])?,
        };
        let hash = text.trim();
        u64::from_str_radix(hash, 16).map_err(|_| EmulatorError::Output(hash.to_owned()))
    }
}

fn on_this_computer(line: [&str; 2]) -> Result<String, EmulatorError> {
    let image = Image::hosted("bits", Profile::Release, None)?;
    let mut program = Command::new(image.path());
    program.args(line);
    output_of(program)
}

fn in_node([number, frames]: [&str; 2]) -> Result<String, EmulatorError> {
    let image = Image::hosted("bits_wasm", Profile::Device, Some("wasm32-unknown-unknown"))?;
    let script = format!(
        "const wasm = new WebAssembly.Module(require('fs').readFileSync(process.argv[1]));
         const hash = new WebAssembly.Instance(wasm).exports.bits_{number}({frames});
         console.log(BigInt.asUintN(64, hash).toString(16));"
    );
    let mut node = Command::new("node");
    node.arg("-e").arg(script).arg(image.path());
    output_of(node)
}
