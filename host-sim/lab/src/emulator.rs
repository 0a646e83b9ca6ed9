//! The solver on emulated boards: from a scene and the hand's samples to the instructions of every frame and to the stack
//! ([`Counter`]), from a number of frames to the hash of all bits (`bits`), from a scene to the flash of its solver.
//!
//! Images are built with cargo from the package `stiction-firmware` and run in QEMU, which counts instructions. The image of the
//! Pico runs in [`pico`](crate::pico), which counts cycles. Both transfer files by semihosting.

mod bits;
mod counter;
mod image;
mod semihosting;

pub use bits::{Machine, Place};
pub use counter::{Counted, Counter, Frame, job};
pub use image::{Profile, footprint};

use std::path::Path;
use std::process::Command;

use stiction_host_sim::firmware::needs::{Need, require};
use stiction_host_sim::firmware::process::{EmulatorError, output_of};
use stiction_host_sim::trade::chip::Chip;

use image::Image;

/// QEMU for boards with an ARM processor.
const QEMU_ARM: &str = "qemu-system-arm";

/// An emulated board.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Board {
    /// STM32F405 (Netduino Plus 2): Cortex-M4 with a floating point unit, 1 MB flash, 128 KB RAM.
    Stm32F405,
    /// nRF51822 (micro:bit): Cortex-M0, 256 KB flash, 16 KB RAM.
    Nrf51822,
    /// QEMU's RISC-V machine, RV32IMC.
    RiscV,
    /// Arm MPS2+ with the FPGA image AN505: Cortex-M33 with a floating point unit.
    An505,
    /// RP2040 (Raspberry Pi Pico): Cortex-M0+, 2 MB flash, 264 KB RAM. The count is of cycles, not of instructions.
    Rp2040,
}

impl Board {
    /// All boards.
    pub const ALL: [Self; 5] = [
        Self::Stm32F405,
        Self::Nrf51822,
        Self::RiscV,
        Self::An505,
        Self::Rp2040,
    ];

    /// The board with a chip.
    pub const fn of(chip: Chip) -> Self {
        match chip {
            Chip::CortexM4F => Self::Stm32F405,
            Chip::CortexM33 => Self::An505,
            Chip::CortexM0 => Self::Nrf51822,
            Chip::CortexM0Plus => Self::Rp2040,
        }
    }

    /// The board on which the flash of a chip is measured: chips of one instruction set run the same code.
    pub const fn with_flash_of(chip: Chip) -> Self {
        match chip {
            Chip::CortexM4F => Self::Stm32F405,
            Chip::CortexM33 => Self::An505,
            Chip::CortexM0 | Chip::CortexM0Plus => Self::Nrf51822,
        }
    }

    /// The name for a reader.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stm32F405 => "Cortex-M4F (STM32F405)",
            Self::Nrf51822 => "Cortex-M0 (nRF51822)",
            Self::RiscV => "RISC-V (RV32IMC)",
            Self::An505 => "Cortex-M33 (AN505)",
            Self::Rp2040 => "Cortex-M0+ (RP2040)",
        }
    }

    const fn target(self) -> &'static str {
        match self {
            Self::Stm32F405 => "thumbv7em-none-eabihf",
            Self::Nrf51822 | Self::Rp2040 => "thumbv6m-none-eabi",
            Self::An505 => "thumbv8m.main-none-eabihf",
            Self::RiscV => "riscv32imc-unknown-none-elf",
        }
    }

    /// Checks that the tools that build and run the images of all these boards are available.
    ///
    /// # Errors
    /// Fails if a tool is missing; the error names all that are.
    pub fn require_all(boards: &[Self]) -> Result<(), EmulatorError> {
        let mut needs = vec![Need::Build];
        for board in boards {
            let qemu = board.qemu().filter(|qemu| qemu.program == QEMU_ARM);
            let emulator = qemu.map(|_| Need::QemuArm);
            for need in [Some(Need::Target(board.target())), emulator] {
                needs.extend(need.filter(|need| !needs.contains(need)));
            }
        }
        require(needs)
    }

    /// Runs an image with a command line, its files in a folder; `counting` instructions, if the emulator can. Returns its
    /// output.
    fn run(
        self,
        image: &Image,
        (folder, line): (&Path, &[&str]),
        counting: bool,
    ) -> Result<String, EmulatorError> {
        match self.qemu() {
            Some(qemu) => qemu.run(image, (folder, line), counting),
            None => semihosting::run(image.path(), folder, line),
        }
    }

    /// QEMU for this board; none if it is emulated in this process.
    fn qemu(self) -> Option<Qemu> {
        let (program, machine, shift): (_, &[_], _) = match self {
            Self::Stm32F405 => (QEMU_ARM, &["netduinoplus2"], 5),
            Self::Nrf51822 => (QEMU_ARM, &["microbit"], 8),
            Self::An505 => (QEMU_ARM, &["mps2-an505"], 8),
            Self::RiscV => ("qemu-system-riscv32", &["virt", "-bios", "none"], 0),
            Self::Rp2040 => return None,
        };
        Some(Qemu {
            program,
            machine,
            shift,
        })
    }
}

/// An emulator in a process of its own.
struct Qemu {
    program: &'static str,
    machine: &'static [&'static str],
    /// Each instruction takes 2^N ns of the emulated clock: N as the program `count` of this board expects it.
    shift: u8,
}

impl Qemu {
    /// See [`Board::run`].
    fn run(
        &self,
        image: &Image,
        (folder, line): (&Path, &[&str]),
        counting: bool,
    ) -> Result<String, EmulatorError> {
        let line: String = line.iter().map(|word| format!(",arg={word}")).collect();
        let mut command = Command::new(self.program);
        command
            .current_dir(folder)
            .arg("-machine")
            .args(self.machine)
            .args(["-nographic", "-monitor", "none", "-serial", "none"])
            .arg("-semihosting-config")
            .arg(format!("enable=on,target=native{line}"))
            .arg("-kernel")
            .arg(image.path());
        if counting {
            command.arg("-icount").arg(format!("shift={}", self.shift));
        }
        output_of(command)
    }
}
