//! Selects the scene that is compiled in, and provides the linker with the locations of flash and RAM and the settings
//! of the log.

use std::process::ExitCode;

use stiction_scene::{BoardBuild, NumberType, ObstacleRoom, SceneModel};

fn main() -> ExitCode {
    let board = BoardBuild {
        target: "thumbv6m-none-eabi",
        number: NumberType::Fixed,
        // More would need more stack than there is.
        room: SceneModel {
            surfaces: 2,
            obstacles: ObstacleRoom::default(),
            ..SceneModel::BOARD
        },
        scene: "../../scenes/board.toml",
        memory: Some("../../memory/nrf51822.x"),
    };
    board.run()
}
