//! For the programs of the feature `board`: the linker's settings for the chip, by target, and the scene that is compiled into an image.

use std::env;
use std::path::{Path, PathBuf};

/// The scene of the images `footprint` and `count_scene` as Rust code, instead of `scenes/box.rs`; see that file.
const SCENE: &str = "STICTION_SCENE_CODE";
/// The chip of the images, if a target has several.
const CHIP: &str = "STICTION_CHIP";

fn main() {
    let package = PathBuf::from(variable("CARGO_MANIFEST_DIR"));
    let scene = env::var_os(SCENE).map_or(package.join("scenes/box.rs"), PathBuf::from);
    println!("cargo::rerun-if-env-changed={SCENE}");
    println!("cargo::rerun-if-env-changed={CHIP}");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=memory");
    println!(
        "cargo::rustc-check-cfg=cfg(chip, values(\"stm32f405\", \"nrf51822\", \"rp2040\", \"an505\", \"virt\"))"
    );
    println!("cargo::rustc-env=STICTION_SCENE_FILE={}", scene.display());
    // A board package has its own programs, and its own file for the linker, which must not find this one.
    if env::var_os("CARGO_FEATURE_BOARD").is_none() {
        return;
    }

    let asked = env::var(CHIP).ok();
    let chip = match variable("TARGET").as_str() {
        "thumbv7em-none-eabihf" => "stm32f405",
        "thumbv6m-none-eabi" if asked.as_deref() == Some("rp2040") => "rp2040",
        "thumbv6m-none-eabi" => "nrf51822",
        "thumbv8m.main-none-eabihf" => "an505",
        "riscv32imc-unknown-none-elf" => "virt",
        _ => return,
    };
    println!("cargo::rustc-cfg=chip=\"{chip}\"");
    let folder = PathBuf::from(variable("OUT_DIR"));
    copy(
        &package.join("memory").join(chip).with_extension("x"),
        &folder.join("memory.x"),
    );
    println!("cargo::rustc-link-search={}", folder.display());
    if chip == "virt" {
        // cortex-m-rt's link.x includes memory.x, that of riscv-rt does not.
        println!("cargo::rustc-link-arg-bins=-Tmemory.x");
    }
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=--nmagic");
}

/// A variable that cargo sets for every build script.
fn variable(name: &str) -> String {
    env::var(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn copy(from: &Path, to: &Path) {
    if let Err(error) = std::fs::copy(from, to) {
        panic!("{}: {error}", from.display());
    }
}
