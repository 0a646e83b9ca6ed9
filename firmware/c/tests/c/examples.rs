//! The examples: the knob of the README on every chip, with its cost there; a pantograph; sketches for Arduino.

use std::process::Command;

use stiction_host_sim::columns::thousands;
use stiction_host_sim::firmware::image::Contents;
use stiction_host_sim::firmware::process::{EmulatorError, if_installed, output_of};
use stiction_lab::markdown::replace;
use stiction_scene::NumberType;

use crate::library::{Library, Room, folder};
use crate::machine::{
    CORTEX_M0, CORTEX_M3, CORTEX_M4F, CORTEX_M33, CORTEX_M33_SOFTFP, Compiler, Machine,
};

pub(crate) const FLOAT: Library = Library {
    number: NumberType::F32,
    room: Room::Surfaces,
};
/// The knob has one surface.
const PLANE: Library = Library {
    room: Room::Plane,
    ..FLOAT
};
const FIXED_PLANE: Library = Library {
    number: NumberType::Fixed,
    ..PLANE
};

struct Taken {
    /// Size of the whole program (bytes).
    flash: u64,
    variables: u64,
    /// Instructions of the worst tick.
    worst: u32,
    /// Units of work of the tick with the most.
    work: u32,
    clicks: u32,
}

fn knob(machine: &Machine, library: &Library) -> Result<Taken, EmulatorError> {
    let out = tempfile::tempdir()?;
    let sources = ["tests/c/turned.c", "examples/knob.c"];
    let program = machine.build(library, &sources, out.path(), &[])?;
    let said = machine.run(&program, true)?;
    let number = |name: &str| {
        let line = said.lines().find_map(|line| line.strip_prefix(name))?;
        u32::from_str_radix(line.trim(), 16).ok()
    };
    let of = |name: &str| number(name).ok_or_else(|| EmulatorError::Output(said.clone()));
    let contents = Contents::of(&program)?;
    Ok(Taken {
        flash: contents.flash,
        variables: contents.variables,
        worst: of("worst")?,
        work: of("work")?,
        clicks: of("clicks")?,
    })
}

/// A whole program, on the same machine.
#[test]
fn the_archive_for_one_surface_takes_a_quarter_less_flash() {
    let flash = |library| if_installed(knob(&CORTEX_M33, &library)).map(|taken| taken.flash);
    if let (Some(plane), Some(float)) = (flash(PLANE), flash(FLOAT)) {
        assert!(4 * plane <= 3 * float, "{plane} of {float} bytes");
    }
}

/// Programs of both kinds compute with the floating-point unit: in software, an operation takes some 50 instructions instead of one. What
/// passes numbers between functions is a small part.
#[test]
fn softfp_costs_few_instructions() {
    let worst = |machine| if_installed(knob(&machine, &PLANE)).map(|taken| taken.worst);
    if let (Some(soft), Some(hard)) = (worst(CORTEX_M33_SOFTFP), worst(CORTEX_M33)) {
        assert!(soft < 2 * hard, "{soft}, with -mfloat-abi=hard {hard}");
    }
}

/// Ten turns back and forth.
#[test]
fn the_knob_clicks() {
    let computer = Machine::computer(Compiler::Gcc, &[]);
    for (machine, library) in [
        (computer, FLOAT),
        (CORTEX_M0, FIXED_PLANE),
        (CORTEX_M4F, PLANE),
        (CORTEX_M33, FLOAT),
        (CORTEX_M33_SOFTFP, PLANE),
    ] {
        let Some(taken) = if_installed(knob(&machine, &library)) else {
            continue;
        };
        // The budget of the example.
        assert!(taken.work <= 32, "{}: {}", machine.name, taken.work);
        // Clicks of 0.2 rad; where it turns back the first one is longer.
        let most = 20.0 * std::f64::consts::TAU / 0.2;
        let clicks = 0.8 * most..=most;
        assert!(
            clicks.contains(&f64::from(taken.clicks)),
            "{}: {}",
            machine.name,
            taken.clicks
        );
    }
}

#[test]
#[ignore = "writes a table of the README"]
fn the_table_of_the_readme() {
    let mut table = String::from(
        "| | flash | RAM without stack | worst tick | of a budget of 32 units |\n|---|---:|---:|---:|---:|\n",
    );
    for (machine, library) in [
        (CORTEX_M0, FIXED_PLANE),
        (CORTEX_M3, FIXED_PLANE),
        (CORTEX_M4F, PLANE),
        (CORTEX_M33, PLANE),
        (CORTEX_M33_SOFTFP, PLANE),
        (CORTEX_M33, FLOAT),
    ] {
        let taken = knob(&machine, &library).expect("everything is installed");
        let room = match library.room {
            Room::Plane => "one surface",
            _ => "four surfaces",
        };
        table += &format!(
            "| {}, {}, {room} | {} bytes | {} bytes | {} instructions | {} |\n",
            machine.name,
            library.number.name(),
            thousands(taken.flash),
            thousands(taken.variables),
            thousands(taken.worst.into()),
            taken.work
        );
    }
    replace(&folder().join("README.md"), "knob", &table).expect("the README");
}

#[test]
fn the_torques_of_the_pantograph_do_the_work_of_its_force() {
    let machine = Machine::computer(Compiler::Clang, &[]);
    machine.finds_nothing_wrong(&FLOAT, &["tests/c/pantograph.c", "examples/pantograph.c"]);
}

/// The code at the beginning of the README.
#[test]
fn the_first_lines_of_the_readme_run() {
    let readme = std::fs::read_to_string(folder().join("README.md")).expect("the README");
    let code = readme
        .split("```c\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next());
    let (includes, rest): (Vec<&str>, Vec<&str>) = code
        .expect("code in C")
        .lines()
        .partition(|line| line.starts_with("#include"));
    let program = format!(
        "{}\nint main(void) {{\n{}\nreturn output.status != STICTION_STATUS_OK || output.held != 1; }}\n",
        includes.join("\n"),
        rest.join("\n")
    );
    let out = tempfile::tempdir().expect("a folder");
    let source = out.path().join("readme.c");
    std::fs::write(&source, program).expect("a program");
    let source = source.to_str().expect("a path of text");
    let machine = Machine::computer(Compiler::Gcc, &[]);
    machine.finds_nothing_wrong(&FLOAT, &[source]);
}

/// With the subset of Arduino that they use, on this computer.
fn sketch(name: &str, example: &str) -> Result<(), EmulatorError> {
    let out = tempfile::tempdir()?;
    let archive = FLOAT.archive("x86_64-unknown-linux-gnu")?;
    let object = out.path().join("example.o");
    let mut compile = Command::new("clang");
    compile
        .arg("-c")
        .arg(folder().join(example))
        .arg("-o")
        .arg(&object);
    compile.arg("-I").arg(folder().join("include"));
    output_of(compile)?;
    let sketch = folder().join(format!("packages/arduino/examples/{name}/{name}.ino"));
    let program = out.path().join("program");
    let mut link = Command::new("clang++");
    link.args(["-std=c++11", "-Wall", "-Wextra", "-Werror"]);
    link.arg(format!("-DSKETCH=\"{}\"", sketch.display()));
    for headers in [
        "tests/c/arduino",
        "packages/arduino/src",
        "include",
        "examples",
    ] {
        link.arg("-I").arg(folder().join(headers));
    }
    link.arg(folder().join("tests/c/arduino/board.cpp"));
    link.arg(object)
        .arg(archive)
        .args(["-lm", "-o"])
        .arg(&program);
    output_of(link)?;
    output_of(Command::new(program)).map(|_| ())
}

#[test]
fn the_sketches_move_their_motors() {
    for (name, example) in [
        ("Knob", "examples/knob.c"),
        ("Pantograph", "examples/pantograph.c"),
    ] {
        if_installed(sketch(name, example));
    }
}
