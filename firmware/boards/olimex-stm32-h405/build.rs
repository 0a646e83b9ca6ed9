//! Which scene is compiled in, where the linker finds flash and RAM, and what it must know of the log.

use std::env;
use std::path::PathBuf;

use stiction_scene::{BoardNumber, OwnScene, SceneModel};

/// What the solver of the board's own scene has, as any scene may come over the wire. That of a scene file which is named by
/// STICTION_SCENE has what this scene needs.
const ROOM: SceneModel = SceneModel {
    vertices: 8,
    surfaces: 4,
    friction: true,
    weight: true,
};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let package = PathBuf::from(variable("CARGO_MANIFEST_DIR"));
    let target = variable("TARGET");
    if target != "thumbv7em-none-eabihf" {
        return;
    }
    let memory = package.join("../../memory/stm32f405.x");
    println!("cargo::rerun-if-changed={}", memory.display());
    let folder = PathBuf::from(variable("OUT_DIR"));
    let own = OwnScene {
        file: package.join("../../scenes/board.toml"),
        room: ROOM,
    };
    if let Err(error) = stiction_scene::compile(&own, BoardNumber::F32, &folder) {
        eprintln!("{error}");
        std::process::exit(1);
    }
    if let Err(error) = std::fs::copy(&memory, folder.join("memory.x")) {
        panic!("{}: {error}", memory.display());
    }
    println!("cargo::rustc-link-search={}", folder.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=--nmagic");
    if env::var_os("CARGO_FEATURE_RTT").is_some()
        || env::var_os("CARGO_FEATURE_SEMIHOSTING").is_some()
    {
        println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
    }
}

/// What cargo sets for every build script.
fn variable(name: &str) -> String {
    env::var(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}
