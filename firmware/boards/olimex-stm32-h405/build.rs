//! Which scene is compiled in, where the linker finds flash and RAM, and what it must know of the log.

use std::env;
use std::path::PathBuf;

/// The scene file instead of `firmware/scenes/board.rs`: see there.
const SCENE: &str = "STICTION_SCENE";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let package = PathBuf::from(variable("CARGO_MANIFEST_DIR"));
    let scene = package.join("../../scenes/board.rs");
    let scene = env::var_os(SCENE).map_or(scene, PathBuf::from);
    println!("cargo::rerun-if-env-changed={SCENE}");
    println!("cargo::rustc-env=STICTION_SCENE_FILE={}", scene.display());
    let target = variable("TARGET");
    if target != "thumbv7em-none-eabihf" {
        return;
    }
    let memory = package.join("../../memory/stm32f405.x");
    println!("cargo::rerun-if-changed={}", memory.display());
    let folder = PathBuf::from(variable("OUT_DIR"));
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
