//! Which scene is compiled in, where the linker finds flash and RAM, and what it must know of the log.

use std::path::Path;
use std::process::ExitCode;

use stiction_scene::{BoardBuild, NumberType, SceneModel};

fn main() -> ExitCode {
    // The linker asks for the names of the chip's interrupts, which the crate of a chip has: src/board.rs has all that are needed.
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
