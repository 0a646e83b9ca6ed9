//! Runs an image with a command line on the emulated Pico: its cycles, with those for which it waits for its flash, are read when the
//! program requests them. Its files are those of a folder, by semihosting.

use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use crate::pico::{Chip, FLASH, length};
use stiction_host_sim::firmware::image::flashed;
use stiction_host_sim::firmware::process::EmulatorError;

/// The limit after which an image is considered endless: an hour of the chip at 125 MHz.
const LONGEST: u64 = 450_000_000_000;

/// `bkpt`: a request to the debugger, by the number in its lower byte.
const BREAKPOINT: u8 = 0xBE;
/// Sets the clock to 0.
const BEGIN: u8 = 1;
/// Reads the clock.
const END: u8 = 2;
const SEMIHOSTING: u8 = 0xAB;

/// Runs an image with a command line, its files in a folder. Returns its output.
///
/// # Errors
/// Fails if it is no image for this chip, ends with an error, or does not end.
pub(super) fn run(image: &Path, folder: &Path, line: &[&str]) -> Result<String, EmulatorError> {
    let mut program = Program::new(flashed(image, FLASH)?, folder, line)?;
    loop {
        match program.step()? {
            None => {}
            Some(0) => return Ok(String::from_utf8_lossy(&program.printed).into_owned()),
            Some(status) => return Err(not_understood(format!("the image ends with {status}"))),
        }
    }
}

fn not_understood(what: impl Into<String>) -> EmulatorError {
    EmulatorError::Output(what.into())
}

/// The chip, and the services of its debugger.
struct Program {
    chip: Chip,
    /// The cycles at the last mark.
    begun: u64,
    folder: PathBuf,
    line: String,
    /// By handle, from 1 on.
    files: Vec<Stream>,
    printed: Vec<u8>,
}

enum Stream {
    File(File),
    Console,
    Closed,
}

impl Program {
    fn new(flash: Vec<u8>, folder: &Path, line: &[&str]) -> Result<Self, EmulatorError> {
        Ok(Self {
            chip: Chip::new(flash),
            begun: 0,
            folder: folder.to_owned(),
            line: line.join(" "),
            files: Vec::new(),
            printed: Vec::new(),
        })
    }

    /// Executes an instruction, or a request to the debugger. Returns the exit status if it ends the program.
    fn step(&mut self) -> Result<Option<u32>, EmulatorError> {
        let at = self.chip.at();
        let instruction = self.chip.instruction(at);
        let instruction =
            instruction.ok_or_else(|| not_understood(format!("the image goes on at {at:#x}")))?;
        let Some(request) = requested(instruction) else {
            self.chip.step();
            let cycles = self.chip.cycles();
            if self.chip.is_in_hard_fault() || cycles > LONGEST {
                return Err(not_understood(format!(
                    "the image comes to nothing at {at:#x}"
                )));
            }
            return Ok(None);
        };
        let cycles = self.chip.cycles() + self.chip.waits();
        let answer = match request {
            BEGIN => {
                self.begun = cycles;
                0
            }
            END => u32::try_from(cycles - self.begun).unwrap_or(u32::MAX),
            _ => match self.serve()? {
                Served::Answer(answer) => answer,
                Served::Exit(status) => return Ok(Some(status)),
            },
        };
        self.chip.set_register(0, answer);
        // Past the breakpoint, which takes no time.
        self.chip.go_on_at(at + length(instruction));
        Ok(None)
    }

    /// A call of semihosting: its number is in register 0, the address of its arguments in register 1.
    fn serve(&mut self) -> Result<Served, EmulatorError> {
        let (call, at) = (self.chip.register(0), self.chip.register(1));
        let word = |index: u32| {
            let bytes = self.chip.bytes(at + 4 * index, 4);
            u32::from_le_bytes(std::array::from_fn(|byte| bytes[byte]))
        };
        let [first, second, third] = [0, 1, 2].map(word);
        Ok(Served::Answer(match call {
            // SYS_OPEN
            0x01 => self.open(first, second, third),
            // SYS_CLOSE
            0x02 => match self.files.get_mut(index(first)) {
                Some(stream) => {
                    *stream = Stream::Closed;
                    0
                }
                None => FAILED,
            },
            // SYS_WRITE: returns the number of bytes that were not written.
            0x05 => {
                let bytes = self.chip.bytes(second, third);
                match self.files.get_mut(index(first)) {
                    Some(Stream::File(file)) => file.write_all(&bytes)?,
                    Some(Stream::Console) => self.printed.extend(bytes),
                    Some(Stream::Closed) | None => return Ok(Served::Answer(third)),
                }
                0
            }
            // SYS_READ: returns the number of bytes that were not read.
            0x06 => {
                let mut bytes = Vec::new();
                if let Some(Stream::File(file)) = self.files.get_mut(index(first)) {
                    file.take(u64::from(third)).read_to_end(&mut bytes)?;
                }
                self.chip.load(second, &bytes);
                third - bytes.len() as u32
            }
            // SYS_GET_CMDLINE
            0x15 => self.command_line(at, first, second),
            // SYS_EXIT_EXTENDED
            0x20 => return Ok(Served::Exit(second)),
            _ => {
                let what = format!("the image asks for call {call:#x} of semihosting");
                return Err(not_understood(what));
            }
        }))
    }

    /// Opens a file, or the console: the address and the length of its name, and the mode. Returns its handle.
    fn open(&mut self, name: u32, mode: u32, length: u32) -> u32 {
        /// Modes from here on are for writing.
        const FOR_WRITING: u32 = 4;
        let name = String::from_utf8_lossy(&self.chip.bytes(name, length)).into_owned();
        let path = self.folder.join(&name);
        let stream = if name == ":tt" {
            Ok(Stream::Console)
        } else if mode < FOR_WRITING {
            File::open(path).map(Stream::File)
        } else {
            File::create(path).map(Stream::File)
        };
        stream.map_or(FAILED, |stream| {
            self.files.push(stream);
            self.files.len() as u32
        })
    }

    /// Writes the command line to an address with some room, and its length to the second argument of the call.
    fn command_line(&mut self, arguments: u32, to: u32, room: u32) -> u32 {
        let line = [self.line.as_bytes(), &[0]].concat();
        let length = line.len() as u32;
        if length > room {
            return FAILED;
        }
        self.chip.load(to, &line);
        self.chip.load(arguments + 4, &(length - 1).to_le_bytes());
        0
    }
}

/// Of a call that failed.
const FAILED: u32 = u32::MAX;

/// The place of a handle among the files.
const fn index(handle: u32) -> usize {
    (handle as usize).wrapping_sub(1)
}

enum Served {
    Answer(u32),
    Exit(u32),
}

/// The request of an instruction to the debugger, if it is one.
fn requested(instruction: u16) -> Option<u8> {
    let [number, kind] = instruction.to_le_bytes();
    let is_known = [BEGIN, END, SEMIHOSTING].contains(&number);
    (kind == BREAKPOINT && is_known).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pico::{MISS, VECTORS};

    /// The cycles of some code between the marks, in the flash, with the stack in RAM and r4 at its end, without those for which the
    /// chip awaits its flash: the code takes fewer than a single wait.
    fn cycles(code: &[u16]) -> u32 {
        const BEFORE: [u16; 2] = [0x466C, 0xBE01]; // mov r4, sp; bkpt #1
        const AFTER: [u16; 2] = [0xBE02, 0xE7FE]; // bkpt #2; b .
        let mut flash = vec![0; VECTORS as usize];
        flash.extend(0x2000_1000_u32.to_le_bytes());
        flash.extend((FLASH + VECTORS + 8 + 1).to_le_bytes());
        for half in BEFORE.iter().chain(code).chain(&AFTER) {
            flash.extend(half.to_le_bytes());
        }
        let end = FLASH + flash.len() as u32 - 4;
        let mut program = Program::new(flash, Path::new("."), &[]).unwrap();
        while program.chip.at() != end {
            assert_eq!(program.step().unwrap(), None);
        }
        assert_eq!(program.step().unwrap(), None);
        program.chip.register(0) % MISS as u32
    }

    /// Arm's table of a Cortex-M0+: DDI 0484C, table 3-1.
    #[test]
    fn instructions_take_the_cycles_of_the_manual() {
        let sequences: [(&str, &[u16], u32); 20] = [
            ("movs r1, #1", &[0x2101], 1),
            ("adds r1, r2, r3; cmp r1, r2", &[0x18D1, 0x4291], 2),
            (
                "lsls r1, r2, #3; uxtb r1, r2; rev r1, r2",
                &[0x00D1, 0xB2D1, 0xBA11],
                3,
            ),
            ("muls r1, r2, r1", &[0x4351], 1),
            ("ldr r1, [sp]", &[0x9900], 2),
            ("ldr r1, [pc]", &[0x4900], 2),
            ("str r1, [sp]", &[0x9100], 2),
            ("ldrb r1, [r4]; strh r1, [r4]", &[0x7821, 0x8021], 4),
            ("push {r1-r3}", &[0xB40E], 4),
            ("push {r1-r3}; pop {r1-r3}", &[0xB40E, 0xBC0E], 8),
            ("stm r4!, {r1, r2}", &[0xC406], 3),
            ("ldm r4!, {r1, r2}", &[0xCC06], 3),
            ("b over a nop", &[0xE000, 0xBF00], 2),
            ("nop", &[0xBF00], 1),
            ("movs r1, #1; beq over a nop", &[0x2101, 0xD000, 0xBF00], 3),
            ("movs r1, #1; bne over a nop", &[0x2101, 0xD100, 0xBF00], 3),
            (
                "movs r1, #3; 1: subs r1, #1; bne 1b",
                &[0x2103, 0x3901, 0xD1FD],
                9,
            ),
            ("bl f; b; f: bx lr", &[0xF000, 0xF801, 0xE000, 0x4770], 7),
            (
                "bl f; b; f: push {lr}; pop {pc}",
                &[0xF000, 0xF801, 0xE001, 0xB500, 0xBD00],
                11,
            ),
            (
                "bl f; b; f: mov r3, lr; blx r3",
                &[0xF000, 0xF801, 0xE001, 0x4673, 0x4798],
                8,
            ),
        ];
        for (text, code, expected) in sequences {
            assert_eq!(cycles(code), expected, "{text}");
        }
    }

    #[test]
    fn an_image_that_leaves_its_flash_is_an_error() {
        let vectors = VECTORS as usize;
        let flash = [vec![0; vectors], vec![0, 0, 0, 0x20, 0x11, 0x22, 0, 0x10]].concat();
        let mut program = Program::new(flash, Path::new("."), &[]).unwrap();
        let error = program.step().unwrap_err().to_string();
        assert!(error.contains("0x10002210"), "{error}");
    }
}
