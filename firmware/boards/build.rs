//! Selects the scene that is compiled in, and provides the linker with the locations of flash and RAM and the settings of the log.

use std::env;
use std::path::Path;
use std::process::ExitCode;

use stiction_scene::{BoardBuild, NumberType, SceneModel};

const M0: &str = "thumbv6m-none-eabi";
const M4F: &str = "thumbv7em-none-eabihf";
const M33: &str = "thumbv8m.main-none-eabihf";

fn main() -> ExitCode {
    let chosen: Vec<BoardBuild> = boards()
        .into_iter()
        .filter(|(feature, _)| has(feature))
        .map(|(_, board)| board)
        .collect();
    match chosen.as_slice() {
        [board] if has("MPS2_AN505") && !without_interrupts() => ExitCode::FAILURE,
        [board] => board.run(),
        [] if env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system != "none") => {
            ExitCode::SUCCESS
        }
        _ => {
            eprintln!(
                "one board is built at a time: name its feature, as its folder's .cargo/config.toml does"
            );
            ExitCode::FAILURE
        }
    }
}

/// The boards by their features, in the spelling of cargo's variables.
fn boards() -> [(&'static str, BoardBuild); 5] {
    let own = match (has("KNOB"), has("PANTOGRAPH")) {
        (true, _) => "../scenes/knob.toml",
        (_, true) => "../scenes/pantograph.toml",
        _ => "../scenes/board.toml",
    };
    let board = |target, number, memory| BoardBuild {
        target,
        number,
        room: SceneModel::BOARD,
        scene: own,
        memory: Some(memory),
    };
    let microbit = BoardBuild {
        // More would need more stack than there is.
        room: SceneModel {
            surfaces: 2,
            corners: 0,
            ..SceneModel::BOARD
        },
        ..board(M0, NumberType::Fixed, "../memory/nrf51822.x")
    };
    let olimex = board(M4F, NumberType::F32, "../memory/stm32f405.x");
    let pico = board(M0, NumberType::Fixed, "../memory/rp2040.x");
    let pico2 = board(M33, NumberType::F32, "../memory/rp2350.x");
    let an505 = board(M33, NumberType::F32, "../memory/an505.x");
    [
        ("MICROBIT", microbit),
        ("MPS2_AN505", an505),
        ("OLIMEX_STM32_H405", olimex),
        ("PICO", pico),
        ("PICO2", pico2),
    ]
}

fn has(feature: &str) -> bool {
    env::var_os(format!("CARGO_FEATURE_{feature}")).is_some()
}

/// The linker requires the names of the chip's interrupts, which the crate of a chip defines. The AN505 has no crate: its `main.rs` has all
/// that are needed, and the linker gets an empty list. Returns false if it cannot be written.
fn without_interrupts() -> bool {
    let Some(folder) = env::var_os("OUT_DIR") else {
        return true;
    };
    let written = std::fs::write(Path::new(&folder).join("device.x"), "");
    if let Err(error) = &written {
        eprintln!("device.x: {error}");
    }
    written.is_ok()
}
