//! The packages: a project of CMake on this computer and one for an RP2350 with the flags of pico-sdk, and the description for Arduino.

use std::fs;
use std::path::Path;
use std::process::Command;

use stiction_host_sim::firmware::process::{EmulatorError, if_installed, output_of};

use crate::examples::FLOAT;
use crate::library::folder;
use crate::machine::CORTEX_M33_SOFTFP;

fn with_cmake(out: &Path) -> Result<(), EmulatorError> {
    let archive = FLOAT.archive("x86_64-unknown-linux-gnu")?;
    let prefix = archive.ancestors().nth(3).expect("a prefix");
    let mut configure = Command::new("cmake");
    configure
        .arg("-S")
        .arg(folder().join("tests/c/cmake"))
        .arg("-B")
        .arg(out);
    configure.arg(format!("-DCMAKE_PREFIX_PATH={}", prefix.display()));
    configure.arg(format!(
        "-DSTICTION_EXAMPLES={}",
        folder().join("examples").display()
    ));
    output_of(configure)?;
    let mut build = Command::new("cmake");
    build.arg("--build").arg(out);
    output_of(build)?;
    output_of(Command::new(out.join("knob"))).map(|_| ())
}

#[test]
fn cmake_finds_the_library() {
    let out = tempfile::tempdir().expect("a folder");
    if_installed(with_cmake(out.path()));
}

/// The commands of the README for a program on an RP2350: returns what the program prints in the emulator.
fn on_an_rp2350(out: &Path) -> Result<String, EmulatorError> {
    let mut compiler = Command::new("arm-none-eabi-gcc");
    compiler.arg("--version");
    output_of(compiler)?;
    let readme = fs::read_to_string(folder().join("README.md"))?;
    let after = readme.split("with pico-sdk").nth(1);
    let block = after.and_then(|rest| rest.split("```").nth(1));
    let commands: Vec<&str> = block.expect("commands").trim().lines().skip(1).collect();
    assert_eq!(commands.len(), 3, "{commands:?}");
    for command in commands {
        let project = folder().join("tests/c/pico-sdk");
        let command = command.replace("PROJECT", &project.display().to_string());
        let script = folder().join("archives.sh").display().to_string();
        let command = command.replace("firmware/c/archives.sh", &script);
        let mut shell = Command::new("bash");
        shell.current_dir(out).args(["-ec", &command]);
        shell.env("STICTION_VARIANTS", "plane");
        output_of(shell)?;
    }
    CORTEX_M33_SOFTFP.run(&out.join("build/knob"), false)
}

#[test]
fn three_commands_link_a_program_with_the_flags_of_pico_sdk_for_an_rp2350_and_it_runs() {
    let out = tempfile::tempdir().expect("a folder");
    if let Some(said) = if_installed(on_an_rp2350(out.path())) {
        assert!(said.contains("clicks"), "{said}");
    }
}

/// As the specification of Arduino's libraries requires them, with an address that opens.
#[test]
fn the_library_for_arduino_describes_itself() {
    let file = folder().join("packages/arduino/library.properties");
    let text = fs::read_to_string(file).expect("a description");
    for key in [
        "name",
        "version",
        "author",
        "maintainer",
        "sentence",
        "paragraph",
        "url",
        "category",
        "architectures",
    ] {
        let mut lines = text.lines();
        let value = lines.find_map(|line| line.strip_prefix(key)?.strip_prefix('='));
        let value = value.unwrap_or_else(|| panic!("no {key}"));
        assert!(!value.trim().is_empty(), "{key}");
        assert!(key != "url" || value.starts_with("https://"), "{value}");
    }
}
