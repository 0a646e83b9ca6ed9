//! Which scene is compiled in, where the linker finds flash and RAM, and what it must know of the log.

use std::process::ExitCode;

use stiction_scene::{BoardBuild, NumberType, ObstacleRoom, SceneModel};

fn main() -> ExitCode {
    let board = BoardBuild {
        target: "thumbv6m-none-eabi",
        number: NumberType::Fixed,
        room: SceneModel {
            vertices: 8,
            surfaces: 2,
            friction: true,
            weight: true,
            // They would need more stack than there is.
            obstacles: ObstacleRoom::default(),
        },
        scene: "../../scenes/board.toml",
        memory: Some("../../memory/nrf51822.x"),
    };
    board.run()
}
