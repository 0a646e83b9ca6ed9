//! Machines that run C programs: this computer and emulated chips; and the compilers for them.

use std::path::{Path, PathBuf};
use std::process::Command;

use stiction_host_sim::firmware::process::{EmulatorError, output_of, require_qemu_arm};

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

/// A compiler of C.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Compiler {
    Gcc,
    Clang,
}

/// A machine.
pub(crate) struct Machine {
    pub(crate) name: &'static str,
    /// Its name for rustc.
    target: &'static str,
    compiler: Compiler,
    /// Its flags for the compiler.
    flags: &'static [&'static str],
    chip: Option<Chip>,
}

/// An emulated chip.
struct Chip {
    /// The start-up code.
    startup: &'static str,
    /// The locations of code and data: values for the linker's script.
    memory: [&'static str; 3],
    /// QEMU: program and machine.
    emulator: (&'static str, &'static [&'static str]),
    /// Each instruction takes 2^N ns of the emulated clock.
    shift: u32,
}

pub(crate) const CORTEX_M0: Machine = Machine {
    name: "Cortex-M0",
    target: "thumbv6m-none-eabi",
    compiler: Compiler::Clang,
    flags: &[
        "--target=thumbv6m-none-eabi",
        "-mcpu=cortex-m0",
        "-DCLOCK=16000000u",
        "-DSHIFT=8",
    ],
    chip: Some(Chip {
        startup: "cortex_m.c",
        memory: ["FLASH=0", "RAM=0x20000000", "RAM_SIZE=0x4000"],
        emulator: ("qemu-system-arm", &["microbit"]),
        shift: 8,
    }),
};

pub(crate) const CORTEX_M4F: Machine = Machine {
    name: "Cortex-M4F",
    target: "thumbv7em-none-eabihf",
    compiler: Compiler::Clang,
    flags: &[
        "--target=thumbv7em-none-eabihf",
        "-mcpu=cortex-m4",
        "-mfloat-abi=hard",
        "-mfpu=fpv4-sp-d16",
        "-DCLOCK=25000000u",
        "-DSHIFT=8",
    ],
    chip: Some(Chip {
        startup: "cortex_m.c",
        memory: ["FLASH=0", "RAM=0x20000000", "RAM_SIZE=0x10000"],
        emulator: ("qemu-system-arm", &["mps2-an386"]),
        shift: 8,
    }),
};

pub(crate) const CORTEX_M33: Machine = Machine {
    name: "Cortex-M33",
    target: "thumbv8m.main-none-eabihf",
    compiler: Compiler::Clang,
    flags: &[
        "--target=thumbv8m.main-none-eabihf",
        "-mcpu=cortex-m33",
        "-mfloat-abi=hard",
        "-mfpu=fpv5-sp-d16",
        "-DCLOCK=20000000u",
        "-DSHIFT=8",
    ],
    chip: Some(Chip {
        startup: "cortex_m.c",
        memory: ["FLASH=0x10000000", "RAM=0x38000000", "RAM_SIZE=0x10000"],
        emulator: ("qemu-system-arm", &["mps2-an505"]),
        shift: 8,
    }),
};

pub(crate) const RISC_V: Machine = Machine {
    name: "RISC-V",
    target: "riscv32imc-unknown-none-elf",
    compiler: Compiler::Clang,
    flags: &[
        "--target=riscv32-unknown-none-elf",
        "-march=rv32imc",
        "-mabi=ilp32",
        "-mno-relax",
    ],
    chip: Some(Chip {
        startup: "riscv.c",
        memory: ["FLASH=0x80000000", "RAM=0", "RAM_SIZE=0x100000"],
        emulator: ("qemu-system-riscv32", &["virt", "-bios", "none"]),
        shift: 0,
    }),
};

impl Machine {
    /// This computer.
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
        compile
            .current_dir(out)
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

    /// What a program prints.
    ///
    /// # Errors
    /// The emulator is missing, or the program fails.
    pub(crate) fn run(&self, program: &Path) -> Result<String, EmulatorError> {
        match &self.chip {
            Some(chip) => chip.run(program, false),
            None => output_of(Command::new(program)),
        }
    }

    /// What a program prints, with a clock that counts the instructions of the chip, which is slower to emulate.
    ///
    /// # Errors
    /// As above.
    pub(crate) fn run_counting(&self, program: &Path) -> Result<String, EmulatorError> {
        match &self.chip {
            Some(chip) => chip.run(program, true),
            None => self.run(program),
        }
    }
}

impl Chip {
    /// With the linker of rustc.
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

    fn run(&self, program: &Path, counts: bool) -> Result<String, EmulatorError> {
        let (emulator, machine) = self.emulator;
        if emulator == "qemu-system-arm" {
            require_qemu_arm()?;
        }
        let mut qemu = Command::new(emulator);
        qemu.arg("-machine").args(machine);
        qemu.args(["-nographic", "-monitor", "none", "-serial", "none"]);
        qemu.args(["-chardev", "stdio,id=said", "-semihosting-config"]);
        qemu.arg("enable=on,target=native,chardev=said");
        if counts {
            qemu.arg("-icount").arg(format!("shift={}", self.shift));
        }
        qemu.arg("-kernel").arg(program);
        output_of(qemu)
    }
}
