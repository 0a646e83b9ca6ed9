//! The library as C programs use it, compiled by gcc and clang with every warning an error: ten scenes have the bits of the solver on six
//! kinds of processor, and invalid arguments are refused. If something is not installed, the test is skipped and prints the command that
//! installs it; with CI=true it must be there.

mod examples;
mod expected;
mod library;
mod machine;
mod packages;

use expected::scenes_header;
use library::{Library, Room};
use machine::{
    CORTEX_M0, CORTEX_M3, CORTEX_M4F, CORTEX_M4F_SOFTFP, CORTEX_M33_SOFTFP, Compiler, Machine,
    RISC_V,
};
use stiction_core::Fixed;
use stiction_host_sim::firmware::process::{EmulatorError, if_installed};
use stiction_scene::NumberType;

const FRAMES: u32 = 10_000;

/// What the walk prints on a machine: a hash for each scene.
fn hashes(machine: &Machine, library: &Library) -> Result<Vec<u32>, EmulatorError> {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("scenes.h"), scenes_header(library))?;
    let defined = [format!("-DFRAMES={FRAMES}u")];
    let program = machine.build(library, &["tests/c/walk.c"], folder.path(), &defined)?;
    let said = machine.run(&program, false)?;
    let hash = |line: &str| u32::from_str_radix(line.strip_prefix("hash ")?, 16).ok();
    let hashes: Option<Vec<u32>> = said.lines().map(hash).collect();
    hashes.ok_or(EmulatorError::Output(said))
}

fn same_bits(machine: &Machine, library: &Library) {
    let expected = match library.number {
        NumberType::F32 => expected::hashes::<f32>(library, FRAMES),
        NumberType::Fixed => expected::hashes::<Fixed>(library, FRAMES),
    };
    if let Some(hashes) = if_installed(hashes(machine, library)) {
        assert_eq!(hashes, expected, "{} {library:?}", machine.name);
    }
}

#[test]
fn a_computer_has_the_bits_of_the_solver() {
    for (compiler, number, room) in [
        (Compiler::Gcc, NumberType::F32, Room::Surfaces),
        (Compiler::Clang, NumberType::Fixed, Room::Surfaces),
        (Compiler::Clang, NumberType::F32, Room::Obstacles),
        (Compiler::Gcc, NumberType::Fixed, Room::Obstacles),
        (Compiler::Gcc, NumberType::F32, Room::Plane),
        (Compiler::Clang, NumberType::Fixed, Room::Plane),
    ] {
        let machine = Machine::computer(compiler, &[]);
        same_bits(&machine, &Library { number, room });
    }
}

#[test]
fn emulated_chips_have_the_bits_of_the_solver() {
    for (machine, number, room) in [
        (CORTEX_M0, NumberType::Fixed, Room::Surfaces),
        (CORTEX_M3, NumberType::Fixed, Room::Plane),
        (CORTEX_M4F, NumberType::F32, Room::Surfaces),
        (CORTEX_M4F_SOFTFP, NumberType::F32, Room::Plane),
        (CORTEX_M33_SOFTFP, NumberType::F32, Room::Surfaces),
        (RISC_V, NumberType::Fixed, Room::Surfaces),
    ] {
        same_bits(&machine, &Library { number, room });
    }
}

/// Under the sanitizers for addresses and undefined behaviour.
#[test]
fn what_no_caller_should_give_is_refused() {
    const SANITIZED: &[&str] = &["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    for (compiler, number, room) in [
        (Compiler::Gcc, NumberType::F32, Room::Surfaces),
        (Compiler::Clang, NumberType::Fixed, Room::Obstacles),
    ] {
        let library = Library { number, room };
        let machine = Machine::computer(compiler, SANITIZED);
        machine.finds_nothing_wrong(&library, &["tests/c/hostile.c"]);
    }
}
