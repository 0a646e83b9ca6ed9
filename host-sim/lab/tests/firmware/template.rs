//! A board of one's own, outside the repository: the template is copied into an empty folder and built with the commands of its README,
//! and from the packages as they would be published; its programs for the RP2040 run on the emulated Pico.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command as Process;

use crate::bits::{SAMPLES, same_bits_of};
use crate::board::Board;
use crate::chip::{Image, PICO};
use crate::flash::boots_with_quad_reads;
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
fn of_packages(packages: &Path) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    copy(&workspace().join("firmware/template"), folder.path());
    let manifest = folder.path().join("Cargo.toml");
    let mut text = fs::read_to_string(&manifest).unwrap();
    let mut patch = "\n[patch.crates-io]\n".to_owned();
    for name in PACKAGES {
        let line = |text: &str| {
            let mut lines = text.lines();
            let line = lines.find(|line| line.starts_with(&format!("stiction-{name}.path")));
            line.unwrap().to_owned()
        };
        let version = env!("CARGO_PKG_VERSION");
        text = text.replace(&line(&text), &format!("stiction-{name} = {version:?}"));
        let package = packages.join(file_name(name));
        patch += &format!("stiction-{name}.path = {package:?}\n");
    }
    fs::write(manifest, text + &patch).unwrap();
    folder
}

/// Where all copies of the template are built.
fn target_folder() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("template")
}

fn program(folder: &Path, features: &[&str], target: &str) -> Option<Image> {
    let mut cargo = cargo_build(folder, "release");
    cargo.arg("--target-dir").arg(target_folder());
    cargo.args(features).args(["--target", target]);
    if_installed(built(cargo)).map(image)
}

fn image(path: PathBuf) -> Image {
    let contents = Contents::of(&path).unwrap();
    Image { path, contents }
}

/// The commands at the beginning of the template's README, in an empty folder: returns the folder, and the image that they build.
fn by_the_commands() -> Option<(PathBuf, Image)> {
    let readme = fs::read_to_string(workspace().join("firmware/template/README.md")).unwrap();
    let block = readme.split("```").nth(1).unwrap();
    let commands: Vec<&str> = block.trim().lines().skip(1).collect();
    let [clone, copy, build] = commands[..] else {
        panic!("three commands: {commands:?}");
    };
    // One place, or every run would leave another build in the target's folder.
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("empty");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir(&folder).unwrap();
    let run = |command: &str| {
        let mut shell = Process::new("bash");
        shell.current_dir(&folder).args(["-ec", command]);
        shell.env("CARGO_TARGET_DIR", target_folder());
        if_installed(output_of(shell)).map(drop)
    };
    let source = workspace().canonicalize().unwrap();
    run(&clone.replace("REPOSITORY", source.to_str().unwrap()))?;
    with_what_is_not_committed(&source, &folder.join("stiction"));
    run(copy)?;
    run(build)?;
    let program = target_folder().join("thumbv6m-none-eabi/release/my-board");
    Some((folder.join("my-board"), image(program)))
}

/// Copies files that git does not have as they are; what was deleted stays in the clone.
fn with_what_is_not_committed(source: &Path, clone: &Path) {
    let mut git = Process::new("git");
    git.current_dir(source);
    git.args(["ls-files", "--modified", "--others", "--exclude-standard"]);
    for name in output_of(git).unwrap().lines() {
        let (from, to) = (source.join(name), clone.join(name));
        if from.is_file() {
            fs::create_dir_all(to.parent().unwrap()).unwrap();
            fs::copy(from, to).unwrap();
        }
    }
}

/// Its poses, path and frame, have the bits of this computer.
fn runs_on_the_pico(image: Image) {
    boots_with_quad_reads(&image);
    let mut board = Board::start_image(&PICO, image).unwrap();
    assert_eq!(board.info().name, "my-board");
    same_bits_of::<Fixed>(&mut board, NumberType::Fixed, SAMPLES);
}

#[test]
fn three_commands_build_the_template_from_an_empty_folder_and_it_runs() {
    let Some((folder, image)) = by_the_commands() else {
        return;
    };
    runs_on_the_pico(image);
    // With the versions of its Cargo.lock, which the commands have left as it was.
    let embassy = ["--no-default-features", "--features", "embassy"];
    if let Some(image) = program(&folder, &embassy, "thumbv6m-none-eabi") {
        runs_on_the_pico(image);
    }
    program(&folder, &[], "thumbv7em-none-eabihf");
    program(&folder, &[], "riscv32imc-unknown-none-elf");
    let lock = |folder: &Path| fs::read(folder.join("Cargo.lock")).unwrap();
    assert!(lock(&folder) == lock(&workspace().join("firmware/template")));
}

#[test]
fn the_template_builds_from_packages() {
    let Some(packages) = packages() else { return };
    program(of_packages(&packages).path(), &[], "thumbv6m-none-eabi");
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
    assert!(lines(&["embassy.rs"]) <= 115);
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
