//! Selects the scene that is compiled in, and provides the linker with the locations of flash and RAM and the settings of the log.

use std::path::Path;
use std::process::ExitCode;

use stiction_scene::{BoardBuild, NumberType, SceneModel};

fn main() -> ExitCode {
    // The linker requires the names of the chip's interrupts, which the crate of a chip defines: src/board.rs has all that are needed.
    if let Some(folder) = std::env::var_os("OUT_DIR")
        && let Err(error) = std::fs::write(Path::new(&folder).join("device.x"), "")
    {
        eprintln!("device.x: {error}");
        return ExitCode::FAILURE;
    }
    let board = BoardBuild {
        target: "thumbv8m.main-none-eabihf",
        number: NumberType::F32,
        room: SceneModel::BOARD,
        scene: "../../scenes/board.toml",
        memory: Some("../../memory/an505.x"),
    };
    board.run()
}
