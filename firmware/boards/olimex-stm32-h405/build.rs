//! Which scene is compiled in, where the linker finds flash and RAM, and what it must know of the log.

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
