//! Machines that run C programs: this computer and emulated chips; and the compilers for them.

use std::path::{Path, PathBuf};
use std::process::Command;

use stiction_host_sim::firmware::process::{
    EmulatorError, if_installed, output_of, require_qemu_arm,
};

use crate::library::{Library, folder};

/// Flags for every C program here.
const OF_C: [&str; 6] = [
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-pedantic",
    "-O2",
];

#[derive(Clone, Copy, Debug)]
pub(crate) enum Compiler {
    Gcc,
    Clang,
}

pub(crate) struct Machine {
    pub(crate) name: &'static str,
    /// Its name for rustc.
    target: &'static str,
    compiler: Compiler,
    flags: &'static [&'static str],
    chip: Option<Chip>,
}

struct Chip {
    startup: &'static str,
    /// The locations of code and data: values for the linker's script.
    memory: [&'static str; 3],
    /// QEMU: program and machine.
    emulator: (&'static str, &'static [&'static str]),
    /// Each instruction takes 2^N ns of the emulated clock.
    shift: u32,
}

const fn cortex_m(
    name: &'static str,
    target: &'static str,
    flags: &'static [&'static str],
    memory: [&'static str; 3],
    machine: &'static [&'static str],
) -> Machine {
    Machine {
        name,
        target,
        compiler: Compiler::Clang,
        flags,
        chip: Some(Chip {
            startup: "cortex_m.c",
            memory,
            emulator: ("qemu-system-arm", machine),
            shift: 8,
        }),
    }
}

pub(crate) const CORTEX_M0: Machine = cortex_m(
    "Cortex-M0",
    "thumbv6m-none-eabi",
    &["-mcpu=cortex-m0", "-DCLOCK=16000000u"],
    ["FLASH=0", "RAM=0x20000000", "RAM_SIZE=0x4000"],
    &["microbit"],
);

pub(crate) const CORTEX_M3: Machine = cortex_m(
    "Cortex-M3",
    "thumbv7m-none-eabi",
    &["-mcpu=cortex-m3", "-DCLOCK=25000000u"],
    ["FLASH=0", "RAM=0x20000000", "RAM_SIZE=0x10000"],
    &["mps2-an385"],
);

pub(crate) const CORTEX_M4F_SOFTFP: Machine = Machine {
    name: "Cortex-M4F, softfp",
    target: "thumbv7em-none-eabi",
    flags: &[
        "-mcpu=cortex-m4",
        "-mfloat-abi=softfp",
        "-mfpu=fpv4-sp-d16",
        "-DCLOCK=25000000u",
    ],
    ..CORTEX_M4F
};

pub(crate) const CORTEX_M33_SOFTFP: Machine = Machine {
    name: "Cortex-M33, softfp",
    target: "thumbv8m.main-none-eabi",
    flags: &[
        "-mcpu=cortex-m33",
        "-mfloat-abi=softfp",
        "-mfpu=fpv5-sp-d16",
        "-DCLOCK=20000000u",
    ],
    ..CORTEX_M33
};

pub(crate) const CORTEX_M4F: Machine = cortex_m(
    "Cortex-M4F",
    "thumbv7em-none-eabihf",
    &[
        "-mcpu=cortex-m4",
        "-mfloat-abi=hard",
        "-mfpu=fpv4-sp-d16",
        "-DCLOCK=25000000u",
    ],
    ["FLASH=0", "RAM=0x20000000", "RAM_SIZE=0x10000"],
    &["mps2-an386"],
);

pub(crate) const CORTEX_M33: Machine = cortex_m(
    "Cortex-M33",
    "thumbv8m.main-none-eabihf",
    &[
        "-mcpu=cortex-m33",
        "-mfloat-abi=hard",
        "-mfpu=fpv5-sp-d16",
        "-DCLOCK=20000000u",
    ],
    ["FLASH=0x10000000", "RAM=0x38000000", "RAM_SIZE=0x10000"],
    &["mps2-an505"],
);

pub(crate) const RISC_V: Machine = Machine {
    name: "RISC-V",
    target: "riscv32imc-unknown-none-elf",
    compiler: Compiler::Clang,
    flags: &["-march=rv32imc", "-mabi=ilp32", "-mno-relax"],
    chip: Some(Chip {
        startup: "riscv.c",
        memory: ["FLASH=0x80000000", "RAM=0", "RAM_SIZE=0x100000"],
        emulator: ("qemu-system-riscv32", &["virt", "-bios", "none"]),
        shift: 0,
    }),
};

impl Machine {
    pub(crate) const fn computer(compiler: Compiler, flags: &'static [&'static str]) -> Self {
        Self {
            name: "this computer",
            target: "x86_64-unknown-linux-gnu",
            compiler,
            flags,
            chip: None,
        }
    }

    /// Compiles C sources, the first one that of the program, with the library: writes its file to `out`, which is also searched for
    /// headers.
    ///
    /// # Errors
    /// A compiler or a target is missing, or does not accept the program.
    pub(crate) fn build(
        &self,
        library: &Library,
        sources: &[&str],
        out: &Path,
        defined: &[String],
    ) -> Result<PathBuf, EmulatorError> {
        let archive = library.archive(self.target)?;
        let startup = self.chip.as_ref().map_or("hosted.c", |chip| chip.startup);
        let machines = folder().join("tests/c/machines");
        let sources = sources.iter().map(|source| folder().join(source));
        let sources: Vec<PathBuf> = sources.chain([machines.join(startup)]).collect();
        let mut compile = Command::new(match self.compiler {
            Compiler::Gcc => "gcc",
            Compiler::Clang => "clang",
        });
        compile
            .args(OF_C)
            .args(self.flags)
            .args(defined)
            .args(library.defines());
        for headers in [
            &folder().join("include"),
            &folder().join("examples"),
            &machines,
            out,
        ] {
            compile.arg("-I").arg(headers);
        }
        let program = out.join("program");
        let Some(chip) = &self.chip else {
            compile
                .args(sources)
                .arg(archive)
                .args(["-lm", "-o"])
                .arg(&program);
            output_of(compile)?;
            return Ok(program);
        };
        // clang names no extensions.
        let target = self.target.replace("riscv32imc", "riscv32");
        compile
            .current_dir(out)
            .arg(format!("--target={target}"))
            .arg(format!("-DSHIFT={}", chip.shift))
            .args(["-ffreestanding", "-c"])
            .args(&sources);
        output_of(compile)?;
        let objects = sources.iter().filter_map(|source| source.file_name());
        let objects: Vec<PathBuf> = objects
            .map(|name| out.join(name).with_extension("o"))
            .collect();
        output_of(chip.link(&machines.join("link.ld"), &objects, &archive, &program)?)?;
        Ok(program)
    }

    /// What a program prints. Where it `counts`, its clock counts the instructions of the chip, which is slower to emulate.
    ///
    /// # Errors
    /// The emulator is missing, or the program fails.
    pub(crate) fn run(&self, program: &Path, counts: bool) -> Result<String, EmulatorError> {
        let Some(chip) = &self.chip else {
            return output_of(Command::new(program));
        };
        let (emulator, machine) = chip.emulator;
        if emulator == "qemu-system-arm" {
            require_qemu_arm()?;
        }
        let mut qemu = Command::new(emulator);
        qemu.arg("-machine").args(machine);
        qemu.args(["-nographic", "-monitor", "none", "-serial", "none"]);
        qemu.args(["-chardev", "stdio,id=said", "-semihosting-config"]);
        qemu.arg("enable=on,target=native,chardev=said");
        if counts {
            qemu.arg("-icount").arg(format!("shift={}", chip.shift));
        }
        qemu.arg("-kernel").arg(program);
        output_of(qemu)
    }

    /// Asserts that a program, which prints what is wrong, prints nothing.
    pub(crate) fn finds_nothing_wrong(&self, library: &Library, sources: &[&str]) {
        let out = tempfile::tempdir().expect("a folder");
        let program = self.build(library, sources, out.path(), &[]);
        let said = program.and_then(|program| self.run(&program, false));
        if let Some(said) = if_installed(said) {
            assert_eq!(said, "", "{:?} {library:?}", self.compiler);
        }
    }
}

impl Chip {
    fn link(
        &self,
        script: &Path,
        objects: &[PathBuf],
        archive: &Path,
        program: &Path,
    ) -> Result<Command, EmulatorError> {
        let mut rustc = Command::new("rustc");
        rustc.args(["--print", "target-libdir"]);
        let libraries = output_of(rustc)?;
        let linker = Path::new(libraries.trim_end())
            .with_file_name("bin")
            .join("rust-lld");
        let mut link = Command::new(linker);
        link.args(["-flavor", "gnu", "--gc-sections", "-T"])
            .arg(script);
        link.args(self.memory.iter().flat_map(|value| ["--defsym", value]));
        link.args(objects).arg(archive).arg("-o").arg(program);
        Ok(link)
    }
}
