//! `stiction image`: from the name of a board, and a scene if one is named, to a file for flashing: UF2, for the drive of a board
//! that has one, or ELF, for a debug probe.
//!
//! The image has no log: a user who copies a file to a drive has no probe to show it, and the image is smaller and has fewer
//! places that can panic. With the log, `cargo load` in the folder of the board flashes it.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::columns::thousands;
use crate::files::whole::write;
use crate::firmware::board::Board;
use crate::firmware::image::{Contents, parts};
use crate::firmware::process::EmulatorError;
use crate::firmware::uf2::{Family, blocks, uf2};
use clap::builder::{OsStringValueParser, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use stiction_firmware::safety::{LimitError, Passivity};
use stiction_scene::{InputError, SceneFile};
use stiction_wire::Mode;

use crate::files::{WriteError, check};
use crate::input::{open_scene, suits_boards};
use crate::progress::Activity;
use crate::report;
use crate::shell::scene_completer;
use stiction_live::number::{Number, named};

/// The arguments of `stiction image`.
#[derive(Args, Clone, Debug)]
pub struct ImageArgs {
    /// The board
    #[arg(value_parser = board_parser())]
    board: Board,
    /// Scene file (TOML), or the name of a bundled scene, to compile in instead of the board's own: the board has room for this scene alone
    #[arg(add = scene_completer())]
    scene: Option<PathBuf>,
    /// Device at the board's pins; without one the hand comes over the serial line
    #[arg(long)]
    device: Option<Device>,
    /// File to write: FILE.uf2, for the drive of a board that has one, or FILE.elf; without it stiction-BOARD.uf2 or stiction-BOARD.elf
    #[arg(long, value_name = "FILE", value_parser = file_parser())]
    out: Option<(PathBuf, ImageFormat)>,
}

/// The reason why there is no image.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ImageError {
    #[error(transparent)]
    Input(#[from] InputError),
    #[error(transparent)]
    Build(#[from] EmulatorError),
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error("{0} has no drive that takes UF2, allowed: --out FILE.elf")]
    NoDrive(&'static str),
    #[error("{board} has no pins for a {device}, allowed: {allowed}")]
    NoDevice {
        board: &'static str,
        device: &'static str,
        allowed: String,
    },
    #[error("{scene}: {error}, with the {device} at {board}, at {rate} ticks per second")]
    NotPassive {
        scene: String,
        device: &'static str,
        board: &'static str,
        error: LimitError,
        rate: u16,
    },
}

/// A device at the pins of a board.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Device {
    /// A motor and an encoder on its axis
    Knob,
    /// Two arms and a handle that turns
    Pantograph,
}

impl Device {
    /// The feature of the boards' package that adds the device.
    const fn feature(self) -> &'static str {
        match self {
            Self::Knob => "knob",
            Self::Pantograph => "pantograph",
        }
    }

    /// Its damping, and the longest turn of the board.
    fn passivity(self, board: Board) -> Passivity {
        use stiction_firmware::devices::pantograph as arms;
        match self {
            Self::Knob => stiction_firmware::devices::knob::PASSIVITY,
            Self::Pantograph if board == Board::OLIMEX => arms::passivity(arms::TURN_F405_US),
            Self::Pantograph if board == Board::PICO2 => arms::passivity(arms::TURN_PICO_2_US),
            Self::Pantograph => arms::passivity(arms::TURN_PICO_US),
        }
    }

    /// Checks that the device displays the stiffnesses of a scene passively, at the tick rate after power-up: otherwise the board would not
    /// start.
    fn admit(self, board: Board, scene: &SceneFile) -> Result<(), ImageError> {
        let rate = Mode::DEFAULT.tick_rate;
        let passivity = self.passivity(board).at_period(1_000_000 / u32::from(rate));
        // As the board computes it.
        let stiffness = [scene.stiffness_translation, scene.stiffness_rotation];
        let [k_h, k_theta] = stiffness.map(|k| k as f32);
        passivity
            .admit(k_h, k_theta)
            .map_err(|error| ImageError::NotPassive {
                scene: scene.source().file().display().to_string(),
                device: self.feature(),
                board: board.name,
                error,
                rate,
            })
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ImageFormat {
    Uf2,
    Elf,
}

fn board_parser() -> impl TypedValueParser<Value = Board> {
    PossibleValuesParser::new(Board::ALL.map(|board| board.name))
        .try_map(|name| named(Board::ALL, |board| board.name, &name))
}

/// An output file; its name need not be text.
fn file_parser() -> impl TypedValueParser<Value = (PathBuf, ImageFormat)> {
    OsStringValueParser::new().try_map(|name: OsString| {
        let file = PathBuf::from(name);
        let format = match file.extension().and_then(|end| end.to_str()) {
            Some("uf2") => ImageFormat::Uf2,
            Some("elf") => ImageFormat::Elf,
            _ => return Err("allowed: a file name that ends in .uf2 or .elf"),
        };
        Ok((file, format))
    })
}

/// Builds the image of a board and writes it.
pub(crate) fn image(args: &ImageArgs) -> Result<(), ImageError> {
    let board = args.board;
    let (out, format) = out(args);
    let family = match (format, board.family) {
        (ImageFormat::Elf, _) => None,
        (ImageFormat::Uf2, None) => return Err(ImageError::NoDrive(board.name)),
        (ImageFormat::Uf2, family) => family,
    };
    let device = device(args)?;
    let scene = args.scene.as_deref().map(usable_scene).transpose()?;
    if let (Some(device), Some(scene)) = (args.device, &scene) {
        device.admit(board, scene)?;
    }
    check(args.scene.as_deref(), [("--out", out.clone())])?;
    board.require_build()?;
    let building = Activity::begin(format!("building the image of {}", board.name));
    let image = match &scene {
        Some(scene) => built_with(board, device, scene)?,
        None => board.image(device, None)?,
    };
    building.end();
    let bytes = match family {
        Some(family) => uf2(&parts(&image)?, family)?,
        None => fs::read(&image).map_err(WriteError::of(&image))?,
    };
    write(&out, &bytes).map_err(WriteError::of(&out))?;
    let contents = Contents::of(&image)?;
    report::print(&described(args, &out, &bytes, &contents, family));
    Ok(())
}

/// The feature of the boards' package for the device at the pins; "" for none.
fn device(args: &ImageArgs) -> Result<&'static str, ImageError> {
    let board = args.board;
    let device = args.device.map(Device::feature);
    if let Some(device) = device.filter(|device| !board.devices.contains(device)) {
        return Err(ImageError::NoDevice {
            board: board.name,
            device,
            allowed: match board.devices {
                [] => "no --device".to_owned(),
                some => some.join(", "),
            },
        });
    }
    Ok(device.unwrap_or_default())
}

fn out(args: &ImageArgs) -> (PathBuf, ImageFormat) {
    let board = args.board;
    args.out.clone().unwrap_or_else(|| {
        let (end, format) = match board.family {
            Some(_) => ("uf2", ImageFormat::Uf2),
            None => ("elf", ImageFormat::Elf),
        };
        (format!("stiction-{}.{end}", board.name).into(), format)
    })
}

fn usable_scene(name: &Path) -> Result<SceneFile, InputError> {
    let scene = open_scene(name, Number::F32)?;
    suits_boards(&scene)?;
    Ok(scene)
}

fn built_with(board: Board, features: &str, scene: &SceneFile) -> Result<PathBuf, EmulatorError> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("scene.toml");
    fs::write(&file, scene.source().text())?;
    match scene.obstacles.is_empty() || board.takes_obstacles() {
        true => board.image(features, Some(&file)),
        // Otherwise it would not fit.
        false => board.small_image(&file),
    }
}

/// Describes the file, its resources on the board, and how to flash it.
fn described(
    args: &ImageArgs,
    out: &Path,
    bytes: &[u8],
    contents: &Contents,
    family: Option<Family>,
) -> String {
    let size = thousands(bytes.len() as u64);
    let (flash, variables) = (thousands(contents.flash), thousands(contents.variables));
    let mut text = format!("{}: {size} bytes", out.display());
    if family.is_some() {
        text += &format!(", {} blocks", thousands(blocks(bytes) as u64));
    }
    text += &format!("\n  flash {flash} bytes, RAM {variables} bytes and the stack\n");
    if family.is_some() {
        text += "  to flash it: hold BOOTSEL while the board is plugged in, and copy the file to the drive that appears\n";
        if let Some(device) = args.device {
            let name = device.feature();
            text +=
                &format!("  wiring and parts: firmware/wiring/{name}.svg, firmware/README.md\n");
        }
        text += "  then: stiction info --port auto\n";
        if args.device == Some(Device::Knob) {
            text += "  the numbers of your knob: stiction knob --port auto\n";
        }
    }
    text
}
