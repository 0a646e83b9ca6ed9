//! What the board is, the scene that it begins with, and the room for others.

use stiction_core::frame::Mode;
use stiction_firmware::safety::Limits;
use stiction_firmware::station::{SceneType, Setup, station_of};

// Written by the build script: `scene.toml` as constants.
include!(concat!(env!("OUT_DIR"), "/scene.rs"));

/// The program, with room for that scene.
pub(crate) type Program = station_of!(CompiledScene);

/// Of the line, in each direction.
pub(crate) const BAUD: u32 = 921_600;

/// The clock (Hz), and the cycles that a unit of work takes: of the ESP32-C3 as of the RP2040, not measured.
const CLOCK_AND_UNIT: (u32, u32) = if cfg!(target_abi = "eabihf") {
    (168_000_000, 630) // STM32F405
} else if cfg!(target_arch = "riscv32") {
    (160_000_000, 3_173) // ESP32-C3
} else {
    (125_000_000, 3_173) // RP2040
};

pub(crate) static SETUP: Setup = Setup {
    name: "my-board",
    number: CompiledScene::NUMBER,
    line_rate: BAUD / 10,
    fastest_tick: 2_000,
    // A quarter of the time is for the line and what else a tick does.
    work_rate: CLOCK_AND_UNIT.0 / CLOCK_AND_UNIT.1 / 4 * 3,
    limits: Limits::DEFAULT,
    passivity: None,
    mode: Mode::DEFAULT,
    scene: SCENE,
};
