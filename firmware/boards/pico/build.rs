//! Selects the scene that is compiled in, and provides the linker with the locations of flash and RAM and the settings
//! of the log.

use std::process::ExitCode;

use stiction_scene::{BoardBuild, NumberType, SceneModel};

fn main() -> ExitCode {
    let board = BoardBuild {
        target: "thumbv6m-none-eabi",
        number: NumberType::Fixed,
        room: SceneModel::BOARD,
        scene: match std::env::var_os("CARGO_FEATURE_KNOB") {
            Some(_) => "../../scenes/knob.toml",
            None => "../../scenes/board.toml",
        },
        memory: Some("../../memory/rp2040.x"),
    };
    board.run()
}
