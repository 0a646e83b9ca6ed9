//! Selects the scene that is compiled in, and provides the linker with the locations of flash and RAM and the settings
//! of the log.

use std::process::ExitCode;

use stiction_scene::{BoardBuild, NumberType, SceneModel};

fn main() -> ExitCode {
    let board = BoardBuild {
        target: "thumbv7em-none-eabihf",
        number: NumberType::F32,
        room: SceneModel::BOARD,
        scene: "../../scenes/board.toml",
        memory: Some("../../memory/stm32f405.x"),
    };
    board.run()
}
