//! The description of the board, the scene that it begins with, and the room for others.

use stiction_firmware::safety::Limits;
use stiction_firmware::speed::Processor;
use stiction_firmware::station::{SceneType, Setup, station_of};
use stiction_wire::Mode;

// Written by the build script: `scene.toml` as constants.
include!(concat!(env!("OUT_DIR"), "/scene.rs"));

/// The program, with room for that scene.
pub(crate) type Program = station_of!(CompiledScene);

/// Baud rate of the line, in each direction.
pub(crate) const BAUD: u32 = 921_600;

/// Units of work per second: a quarter of the time is for the line and the other work of a tick.
const WORK_RATE: u32 = if cfg!(target_abi = "eabihf") {
    Processor::CORTEX_M4F.work_rate(168_000_000, 6) // STM32F405
} else if cfg!(target_arch = "riscv32") {
    Processor::CORTEX_M0_PLUS.work_rate(160_000_000, 6) // ESP32-C3, not measured
} else {
    Processor::CORTEX_M0_PLUS.work_rate(125_000_000, 6) // RP2040
};

pub(crate) static SETUP: Setup = Setup {
    name: "my-board",
    number: CompiledScene::NUMBER,
    line_rate: BAUD / 10,
    fastest_tick: 2_000,
    work_rate: WORK_RATE,
    limits: Limits::DEFAULT,
    passivity: None,
    mode: Mode::DEFAULT,
    scene: SCENE,
    knob: None,
};
