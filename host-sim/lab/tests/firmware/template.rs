//! A board of one's own, outside the repository: the template is copied into an empty folder and built from the packages as they are
//! published; its programs for the RP2040 run on the emulated Pico.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command as Process;

use crate::bits::{SAMPLES, same_bits_of};
use crate::board::Board;
use crate::chip::{Image, PICO};
use stiction_core::Fixed;
use stiction_host_sim::firmware::image::{Contents, built, cargo, cargo_build};
use stiction_host_sim::firmware::process::{if_installed, output_of};
use stiction_host_sim::firmware::workspace;
use stiction_wire::NumberType;
use tempfile::TempDir;

/// What a board outside depends on.
const PACKAGES: [&str; 4] = ["core", "wire", "scene", "firmware"];

/// The packages as cargo would upload them: the folder in which they lie. That each can be built from what is in it, the template shows.
fn packages() -> Option<PathBuf> {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("packages");
    let mut cargo = cargo();
    cargo.current_dir(workspace());
    // What is not committed yet is tested, too.
    cargo.args(["package", "--locked", "--allow-dirty", "--no-verify"]);
    cargo.arg("--target-dir").arg(&target);
    for name in PACKAGES {
        cargo.args(["-p", &format!("stiction-{name}")]);
    }
    if_installed(output_of(cargo))?;
    let folder = target.join("package");
    for package in PACKAGES.map(file_name) {
        let mut tar = Process::new("tar");
        // With the times of now: a package has one time for all files, by which cargo would take what it built of an older one.
        tar.current_dir(&folder)
            .args(["-xmzf", &format!("{package}.crate")]);
        if_installed(output_of(tar))?;
    }
    Some(folder)
}

/// Of a package, without its ending.
fn file_name(package: &str) -> String {
    format!("stiction-{package}-{}", env!("CARGO_PKG_VERSION"))
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let (path, name) = entry.map(|e| (e.path(), e.file_name())).unwrap();
        if path.is_dir() {
            copy(&path, &to.join(name));
        } else {
            fs::copy(&path, to.join(name)).unwrap();
        }
    }
}

/// The template in a folder of its own, with the packages in the place of the registry's.
fn template(packages: &Path) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    copy(&workspace().join("firmware/template"), folder.path());
    let settings = folder.path().join(".cargo/config.toml");
    let mut text = fs::read_to_string(&settings).unwrap() + "\n[patch.crates-io]\n";
    for name in PACKAGES {
        let package = packages.join(file_name(name));
        text += &format!("stiction-{name}.path = {package:?}\n");
    }
    fs::write(settings, text).unwrap();
    folder
}

fn program(folder: &Path, features: &[&str], target: &str) -> Option<Image> {
    let mut cargo = cargo_build(folder, "release");
    let target_folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("template");
    cargo.arg("--target-dir").arg(target_folder);
    cargo.args(features).args(["--target", target]);
    let path = if_installed(built(cargo))?;
    let contents = Contents::of(&path).unwrap();
    Some(Image { path, contents })
}

/// Its poses, path and frame, have the bits of this computer.
fn runs_on_the_pico(image: Image) {
    let mut board = Board::start_image(&PICO, image).unwrap();
    assert_eq!(board.info().name, "my-board");
    same_bits_of::<Fixed>(&mut board, NumberType::Fixed, SAMPLES);
}

#[test]
fn the_template_builds_from_packages_and_runs() {
    let Some(packages) = packages() else { return };
    let folder = template(&packages);
    let program = |features, target| program(folder.path(), features, target);
    let embassy = ["--no-default-features", "--features", "embassy"];
    for features in [&[][..], &embassy] {
        if let Some(image) = program(features, "thumbv6m-none-eabi") {
            runs_on_the_pico(image);
        }
    }
    program(&[], "thumbv7em-none-eabihf");
    program(&[], "riscv32imc-unknown-none-elf");
}

#[test]
fn what_a_board_of_ones_own_has_to_say_is_short() {
    let source = workspace().join("firmware/template/src");
    let lines = |names: &[&str]| -> usize {
        let texts = names
            .iter()
            .map(|name| fs::read_to_string(source.join(name)).unwrap());
        let is_code = |line: &&str| !line.trim().is_empty() && !line.trim().starts_with("//");
        texts.map(|text| text.lines().filter(is_code).count()).sum()
    };
    for board in ["rp2040", "stm32f405", "esp32c3"] {
        let board = format!("board/{board}.rs");
        assert!(lines(&["main.rs", "setup.rs", &board]) <= 150, "{board}");
    }
    assert!(lines(&["embassy.rs"]) <= 60);
}

#[test]
fn every_package_holds_the_licences() {
    for package in ["core", "core/wire", "host-sim/scene", "firmware"] {
        for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
            let read = |folder: &str| fs::read(workspace().join(folder).join(licence)).unwrap();
            assert!(read(package) == read("."), "{package}/{licence}");
        }
    }
}
