//! Which scene is compiled in, where the linker finds flash and RAM, and what it must know of the log.

use std::process::ExitCode;

use stiction_scene::{BoardBuild, NumberType, SceneModel};

fn main() -> ExitCode {
    let board = BoardBuild {
        target: "thumbv8m.main-none-eabihf",
        number: NumberType::F32,
        room: SceneModel::BOARD,
        scene: match std::env::var_os("CARGO_FEATURE_KNOB") {
            Some(_) => "../../scenes/knob.toml",
            None => "../../scenes/board.toml",
        },
        memory: Some("../../memory/rp2350.x"),
    };
    board.run()
}
