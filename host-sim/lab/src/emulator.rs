//! The solver on emulated boards: from a scene and the hand's samples to the instructions of every frame and to the stack
//! ([`Counter`]), from a number of frames to the hash of all bits (`bits`), from a scene to the flash of its solver.
//!
//! Images are built with cargo from the package `stiction-firmware` and run in QEMU, which counts instructions. The image of the
//! Pico runs in [`pico`](crate::pico), which counts cycles. Both transfer files by semihosting.

mod bits;
mod estimate;
mod image;
mod semihosting;

pub use bits::{Machine, Place};
pub use image::{Profile, footprint};

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use stiction_core::{Evolution, Hand, narrow_hand};
use stiction_firmware::count::Totals;
use stiction_host_sim::firmware::image::flashed;
use stiction_host_sim::firmware::needs::{Need, require};
use stiction_host_sim::firmware::process::{EmulatorError, output_of, require_qemu_arm};
use stiction_host_sim::trade::chip::Chip;
use stiction_scene::{NumberType, SceneFile, WrittenScene};
use stiction_wire::{
    Command as Told, CommandAmong, Decoder, Mode, Pose, Report, SceneAmong, SceneCommand,
};

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

    /// The start of the flash of a board whose cycles can be estimated.
    const fn estimated(self) -> Option<u32> {
        match self {
            Self::Stm32F405 => Some(0x0800_0000),
            Self::An505 => Some(0x1000_0000),
            Self::Nrf51822 | Self::RiscV | Self::Rp2040 => None,
        }
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
        files: (&Path, &[&str]),
        counting: bool,
    ) -> Result<String, EmulatorError> {
        output_of(self.command(image, files, counting))
    }

    fn command(&self, image: &Image, (folder, line): (&Path, &[&str]), counting: bool) -> Command {
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
        command
    }
}

/// A frame of a job.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// Instructions or cycles of the step, including its call; `u32::MAX` if there were more than can be counted.
    pub instructions: u32,
    /// The pose of the body.
    pub pose: Pose,
    /// Slips that ended in this frame.
    pub slips: u32,
    /// The units of work that the step took.
    pub work: u32,
}

/// The results of a job.
#[derive(Clone, Debug, PartialEq)]
pub struct Counted {
    /// The frames; the first one is the start.
    pub frames: Vec<Frame>,
    /// Stack and sizes.
    pub totals: Totals,
}

impl Counted {
    /// The frames without the start.
    pub fn steps(&self) -> &[Frame] {
        self.frames.get(1..).unwrap_or_default()
    }

    /// From the reports of a board, and the totals that it prints.
    fn read(reports: &[u8], printed: &str) -> Result<Self, EmulatorError> {
        let unread =
            |what: &str| EmulatorError::Output(format!("the results of the board: {what}"));
        let mut decoder = Decoder::<256>::new();
        let mut frames: Vec<Frame> = Vec::new();
        for &byte in reports {
            let Some(received) = decoder.push::<Report<'_>>(byte) else {
                continue;
            };
            let received = received.map_err(|fault| unread(fault.kind.name()))?;
            if let Report::Pose(pose) = received.message {
                frames.push(Frame {
                    instructions: received.time,
                    pose,
                    ..Frame::default()
                });
            } else if let (Report::Events(events), Some(last)) =
                (received.message, frames.last_mut())
            {
                (last.slips, last.work) = (events.slips, received.time);
            } else {
                return Err(unread("a report that is none"));
            }
        }
        let numbers = printed.split_whitespace().map(str::parse);
        let numbers: Result<Vec<u32>, _> = numbers.collect();
        match numbers.as_deref() {
            Ok(&[stack, solver, state]) => Ok(Self {
                frames,
                totals: Totals {
                    stack,
                    solver,
                    state,
                },
            }),
            _ => Err(unread(printed)),
        }
    }
}

/// A job for a [`Counter`]: the scene, the evolution, and a hand sample for every frame, as messages to a board.
pub fn job(scene: &SceneFile, evolution: Evolution, hands: &[Hand<f64>]) -> Vec<u8> {
    let mut bytes = Vec::new();
    scene.described(|description| {
        WrittenScene::described_obstacles(&scene.obstacles, |obstacles| {
            let scene = match obstacles {
                [] => CommandAmong::Common(Told::Scene(SceneCommand::from(description))),
                _ => CommandAmong::SceneAmong(SceneAmong::new(description, obstacles)),
            };
            add(&mut bytes, scene);
        });
    });
    let mode = Mode {
        evolution,
        ..Mode::DEFAULT
    };
    add(&mut bytes, CommandAmong::Common(Told::Mode(mode)));
    for hand in hands {
        let hand = Told::Hand(narrow_hand(hand));
        add(&mut bytes, CommandAmong::Common(hand));
    }
    bytes
}

/// Adds a message. One that is too long is left out, and the board refuses the job.
fn add(bytes: &mut Vec<u8>, message: CommandAmong<'_>) {
    let frame = stiction_wire::Frame {
        sequence: 0,
        time: 0,
        message,
    };
    bytes.extend_from_slice(frame.encode(&mut [0; 1024]).unwrap_or_default());
}

/// The instruction bench of a board, built once for many jobs.
pub struct Counter {
    board: Board,
    image: Image,
}

impl Counter {
    /// Builds it.
    ///
    /// # Errors
    /// Fails if cargo or the target is missing, or the image cannot be built.
    pub fn new(board: Board, number: NumberType, profile: Profile) -> Result<Self, EmulatorError> {
        let image = Image::of_board(board, &format!("count_{}", number.name()), profile)?;
        Ok(Self { board, image })
    }

    /// Builds one with f32 for scenes among obstacles, of at most 4 vertices, one half-plane and 17 obstacles of 4 corners.
    ///
    /// # Errors
    /// Fails if cargo or the target is missing, or the image cannot be built.
    pub fn among(board: Board, profile: Profile) -> Result<Self, EmulatorError> {
        let image = Image::of_board(board, "count_among", profile)?;
        Ok(Self { board, image })
    }

    /// Builds one with the number type, V, S, the model and the evolution of `scene`, which is Rust code, see
    /// [`rust_source`](stiction_scene::rust_source): for jobs whose scenes run in them.
    ///
    /// # Errors
    /// Fails if cargo or the target is missing, or the image cannot be built.
    pub fn of_model(board: Board, profile: Profile, scene: &str) -> Result<Self, EmulatorError> {
        let image = Image::of_scene(board, "count_scene", profile, scene)?;
        Ok(Self { board, image })
    }

    /// Runs a job, with a budget for each step: the instructions of every frame. Without a model of its own, it has room for 8 vertices and
    /// 4 surfaces.
    ///
    /// # Errors
    /// Fails if the emulator is missing, or the job ends with an error.
    pub fn count(&self, job: &[u8], budget: u32) -> Result<Counted, EmulatorError> {
        let folder = tempfile::tempdir()?;
        fs::write(folder.path().join("job"), job)?;
        let budget = budget.to_string();
        let line = ["count", "job", "results", &budget];
        let printed = self.board.run(&self.image, (folder.path(), &line), true)?;
        Counted::read(&fs::read(folder.path().join("results"))?, &printed)
    }

    /// Runs a job on a board with the instructions of a Cortex-M4F, in QEMU: the average number of cycles per instruction of a
    /// step, an upper estimate from the cycles that Arm specifies.
    ///
    /// # Errors
    /// The errors of [`Counter::count`]; also fails for any other board.
    pub fn estimate(&self, job: &[u8]) -> Result<f64, EmulatorError> {
        let (Some(qemu), Some(flash)) = (self.board.qemu(), self.board.estimated()) else {
            let what = format!("no cycles are known of a {}", self.board.name());
            return Err(EmulatorError::Output(what));
        };
        require_qemu_arm()?;
        let folder = tempfile::tempdir()?;
        fs::write(folder.path().join("job"), job)?;
        let line = ["count", "job", "results", "4294967295"];
        let mut command = qemu.command(&self.image, (folder.path(), &line), true);
        // Each instruction is executed separately, with a line of standard error for each.
        command.args(["-accel", "tcg,one-insn-per-tb=on", "-d", "exec,nochain"]);
        command.stdin(Stdio::null()).stdout(Stdio::null());
        let mut child = command.stderr(Stdio::piped()).spawn()?;
        let contents = flashed(self.image.path(), flash)?;
        let taken = child
            .stderr
            .take()
            .map(|log| estimate::read(log, (&contents, flash)));
        let status = child.wait()?;
        match taken {
            Some(taken) if status.success() => {
                let taken = taken?;
                Ok(taken.cycles as f64 / taken.instructions as f64)
            }
            _ => Err(EmulatorError::Output(format!(
                "the emulator ends with {status}"
            ))),
        }
    }
}
