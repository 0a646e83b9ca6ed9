//! Compiles `scene.toml` in, and provides the linker with the locations of flash and RAM. Keep the part for your chip.

use std::process::ExitCode;

use stiction_scene::{BoardBuild, NumberType, SceneModel};

/// The capacities for other scenes, which come over the line.
const ROOM: SceneModel = SceneModel {
    corners: 0,
    ..SceneModel::BOARD
};

fn main() -> ExitCode {
    let chip = |target, number, memory| BoardBuild {
        target,
        number,
        room: ROOM,
        scene: "scene.toml",
        memory,
    };
    let chips = [
        chip(
            "thumbv6m-none-eabi",
            NumberType::Fixed,
            Some("memory/rp2040.x"),
        ),
        chip(
            "thumbv7em-none-eabihf",
            NumberType::F32,
            Some("memory/stm32f405.x"),
        ),
        // esp-hal knows its memory.
        chip("riscv32imc-unknown-none-elf", NumberType::Fixed, None),
    ];
    if std::env::var("TARGET").is_ok_and(|target| target.starts_with("riscv32imc")) {
        println!("cargo::rustc-link-arg-bins=-Tlinkall.x");
    }
    let all = chips.map(|chip| chip.run());
    let ok = all.iter().all(|&code| code == ExitCode::SUCCESS);
    if ok {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
