//! Cycles of an instruction, estimated if no emulator counts them: from every instruction that a Cortex-M4F executes in a step to
//! the cycles that Arm's manual (DDI 0439D, tables 3-1 and 7-1) specifies for it.
//!
//! The estimate is an upper one: a taken branch refills the pipeline in the most cycles that the manual allows, a division takes
//! its maximum, no load overlaps the previous one, no `it` is folded. It excludes wait states of the flash and other traffic on
//! the bus. Arm specifies no cycles for the Cortex-M33, whose instructions are assumed to need as many.

use std::io::{BufRead, BufReader, Read};

use stiction_host_sim::firmware::process::EmulatorError;

/// Cycles in which a taken branch refills the pipeline: 1 to 3.
const REFILL: u64 = 3;
/// Cycles of an integer division: 2 to 12.
const DIVISION: u64 = 12;
/// Cycles of a division, and of a square root, in single precision.
const FLOAT_DIVISION: u64 = 14;
/// Cycles of a multiplication with accumulation in single precision.
const FLOAT_ACCUMULATION: u64 = 3;

/// The function whose instructions are estimated, with all functions that it calls.
const STEP: &str = "_ZN17stiction_firmware5count4step17h";

/// The instructions and cycles of the steps of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Spent {
    pub(super) instructions: u64,
    pub(super) cycles: u64,
}

/// Reads the instructions that QEMU reports as executed (`-d exec`); the flash of the image is given with its start address.
///
/// # Errors
/// Fails if the log cannot be read, or contains no step.
pub(super) fn read(log: impl Read, flash: (&[u8], u32)) -> Result<Spent, EmulatorError> {
    let not_understood = |line: &str| EmulatorError::Output(format!("the emulator's log: {line}"));
    let mut steps = Steps::default();
    for line in BufReader::new(log).lines() {
        let line = line?;
        let Some(trace) = line.strip_prefix("Trace ") else {
            continue;
        };
        let mut parts = trace.split(['/', ']']);
        let at = parts.nth(1).and_then(|at| u32::from_str_radix(at, 16).ok());
        let at = at.ok_or_else(|| not_understood(&line))?;
        let instruction = Instruction::at(at, flash).ok_or_else(|| not_understood(&line))?;
        steps.executes(instruction, trace.contains(STEP));
    }
    if steps.taken.instructions == 0 {
        return Err(not_understood("no step is in it"));
    }
    Ok(steps.taken)
}

/// The instructions of the steps among all others, in the order of their execution.
#[derive(Clone, Debug, Default)]
struct Steps {
    last: Option<Instruction>,
    /// The return address of a step in progress.
    end: Option<u32>,
    taken: Spent,
}

impl Steps {
    fn executes(&mut self, instruction: Instruction, of_step: bool) {
        if let Some(last) = self.last.replace(instruction) {
            if self.end.is_some() {
                self.taken.instructions += 1;
                self.taken.cycles += last.cycles(&instruction);
            }
            if self.end.is_none() && of_step {
                self.end = Some(last.next());
            } else if self.end == Some(instruction.at) {
                self.end = None;
            }
        }
    }
}

/// A Thumb instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Instruction {
    at: u32,
    /// Its halves; the second one is that of the next instruction if it has only one.
    halves: [u16; 2],
}

impl Instruction {
    /// The instruction at an address of the flash.
    fn at(at: u32, (flash, begin): (&[u8], u32)) -> Option<Self> {
        let bytes = flash.get(at.checked_sub(begin)? as usize..)?;
        let half = |k: usize| bytes.get(2 * k..)?.first_chunk().copied();
        let first = u16::from_le_bytes(half(0)?);
        let second = half(1).map_or(0, u16::from_le_bytes);
        Some(Self {
            at,
            halves: [first, second],
        })
    }

    fn is_long(&self) -> bool {
        self.halves[0] >> 11 > 0b11100
    }

    /// The address after it.
    fn next(&self) -> u32 {
        self.at + if self.is_long() { 4 } else { 2 }
    }

    /// Its cycles when followed by another given instruction.
    fn cycles(&self, next: &Self) -> u64 {
        let branches = next.at != self.next();
        let waits = match self.float() {
            Some(Float::Arithmetic { result, .. }) => next.reads(result),
            _ => false,
        };
        self.alone() + u64::from(waits) + if branches { REFILL } else { 0 }
    }

    /// Its own cycles.
    fn alone(&self) -> u64 {
        let [first, second] = self.halves;
        let words = |list: u16| 1 + u64::from(list.count_ones());
        match first >> 11 {
            0b01001..=0b10011 => 2,
            0b10110 | 0b10111 if first & 0x0600 == 0x0400 => words(first & 0x01FF),
            0b11000 | 0b11001 => words(first & 0x00FF),
            ..=0b11100 => 1,
            _ => match self.float() {
                Some(float) => float.cycles(),
                None if first & 0xFE40 == 0xE800 => words(second),
                None if first & 0xFFF0 == 0xE8D0 && second & 0xFFE0 == 0xF000 => 2,
                None if first & 0xFE40 == 0xE840 => 3,
                None if first & 0xFE00 == 0xF800 => 2,
                None if first & 0xFFD0 == 0xFB90 => DIVISION,
                None => 1,
            },
        }
    }

    /// Returns whether it is an instruction of the floating point unit.
    fn float(&self) -> Option<Float> {
        let [first, second] = self.halves;
        if first & 0xEC00 != 0xEC00 || second & 0x0E00 != 0x0A00 {
            return None;
        }
        let field = |four: u16, one: u16| (four & 0xF) << 1 | one & 1;
        let [d, n, m] = [
            field(second >> 12, first >> 6),
            field(first, second >> 7),
            field(second, second >> 5),
        ];
        Some(if first & 0xFFE0 == 0xEC40 {
            Float::MoveTwo {
                read: (first & 0x10 != 0).then_some(m),
            }
        } else if first & 0xFF00 == 0xEC00 || first & 0xFF20 == 0xED20 {
            let words = second & 0xFF;
            Float::Many {
                words,
                read: (first & 0x10 == 0).then_some(d),
            }
        } else if first & 0xFF00 == 0xED00 {
            let is_double = second & 0x0100 != 0;
            Float::One {
                is_double,
                read: (first & 0x10 == 0).then_some(d),
            }
        } else if first & 0xFF00 == 0xFE00 {
            // Selections, only on the M33.
            let sources = [None, Some(n), Some(m)];
            Float::Other { sources }
        } else if second & 0x10 != 0 {
            Float::Move {
                read: (first & 0xF0 == 0x10).then_some(n),
            }
        } else {
            arithmetic((first >> 4 & 0xB, first & 0xF, second >> 6 & 3), [d, n, m])
        })
    }

    /// Returns whether it needs a register of the floating point unit.
    fn reads(&self, register: u16) -> bool {
        match self.float() {
            None => false,
            Some(Float::Move { read } | Float::One { read, .. }) => read == Some(register),
            Some(Float::MoveTwo { read }) => {
                read.is_some_and(|first| (first..first + 2).contains(&register))
            }
            Some(Float::Many { read, words }) => {
                read.is_some_and(|first| (first..first + words).contains(&register))
            }
            Some(Float::Arithmetic { sources, .. } | Float::Other { sources }) => {
                sources.contains(&Some(register))
            }
        }
    }
}

/// Instructions of the floating point unit, with the registers of single precision that they read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Float {
    /// Its result is available one cycle later to an instruction that follows immediately.
    Arithmetic {
        cycles: u64,
        result: u16,
        sources: [Option<u16>; 3],
    },
    /// Copies, signs, comparisons.
    Other {
        sources: [Option<u16>; 3],
    },
    /// From and to a register of the core, and of two.
    Move {
        read: Option<u16>,
    },
    MoveTwo {
        read: Option<u16>,
    },
    /// From and to memory.
    One {
        is_double: bool,
        read: Option<u16>,
    },
    /// From and to memory, from a register on.
    Many {
        words: u16,
        read: Option<u16>,
    },
}

impl Float {
    fn cycles(self) -> u64 {
        match self {
            Self::Arithmetic { cycles, .. } => cycles,
            Self::Other { .. } | Self::Move { .. } => 1,
            Self::MoveTwo { .. } => 2,
            Self::One { is_double, .. } => 2 + u64::from(is_double),
            Self::Many { words, .. } => 1 + u64::from(words),
        }
    }
}

/// Instructions that compute, by their fields `opc1`, `opc2`, `opc3`, with the registers d, n, m.
fn arithmetic(code: (u16, u16, u16), [d, n, m]: [u16; 3]) -> Float {
    let (result, [d, n, m]) = (d, [Some(d), Some(n), Some(m)]);
    let (cycles, sources) = match code {
        (0 | 1 | 9 | 0xA, ..) => (FLOAT_ACCUMULATION, [d, n, m]),
        (2 | 3, ..) => (1, [None, n, m]),
        (8, ..) => (FLOAT_DIVISION, [None, n, m]),
        (_, 1, 3) => (FLOAT_DIVISION, [None, None, m]),
        // A constant; a copy or a sign; a comparison.
        (_, _, 0 | 2) => return Float::Other { sources: [None; 3] },
        (_, 0 | 1, _) => {
            let sources = [None, None, m];
            return Float::Other { sources };
        }
        (_, 4 | 5, _) => {
            let sources = [d, None, m];
            return Float::Other { sources };
        }
        _ => (1, [None, None, m]),
    };
    Float::Arithmetic {
        cycles,
        result,
        sources,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cycles of instructions that are executed in sequence, the last one followed by the one at `next`.
    fn cycles(code: &[u16], next: Option<u32>) -> u64 {
        let flash: Vec<u8> = code.iter().flat_map(|half| half.to_le_bytes()).collect();
        let end = flash.len() as u32;
        let (mut at, mut sum) = (0, 0);
        while at < end {
            let instruction = Instruction::at(at, (&flash, 0)).unwrap();
            at = instruction.next();
            let nop = |at| Instruction {
                at,
                halves: [0xBF00; 2],
            };
            let next = match next.filter(|_| at == end) {
                Some(branch) => nop(branch),
                None => Instruction::at(at, (&flash, 0)).unwrap_or(nop(at)),
            };
            sum += instruction.cycles(&next);
        }
        sum
    }

    /// Arm's tables of a Cortex-M4F: DDI 0439D, tables 3-1 and 7-1.
    #[test]
    fn instructions_take_the_cycles_of_the_manual() {
        let sequences: [(&str, &[u16], u64); 31] = [
            ("adds r1, r2, r3", &[0x18D1], 1),
            ("lsls r0, r1; mov r8, r1", &[0x4088, 0x4688], 2),
            ("ldr r1, [sp]; ldr r1, [pc, #4]", &[0x9900, 0x4901], 4),
            ("ldrsb r1, [r0, r2]", &[0x5681], 2),
            ("ldr.w r1, [r2, #100]", &[0xF8D2, 0x1064], 2),
            ("ldr r1, [r2], #4", &[0xF852, 0x1B04], 2),
            ("ldrd r1, r2, [r3]", &[0xE9D3, 0x1200], 3),
            ("strd r1, r2, [r3]", &[0xE9C3, 0x1200], 3),
            ("push {r4-r7, lr}", &[0xB5F0], 6),
            ("push.w {r4-r11, lr}", &[0xE92D, 0x4FF0], 10),
            ("ldm.w r0, {r1-r3}", &[0xE890, 0x000E], 4),
            ("stm r0!, {r1, r2}", &[0xC006], 3),
            ("umull r0, r1, r2, r3", &[0xFBA2, 0x0103], 1),
            ("mla r0, r1, r2, r3", &[0xFB01, 0x3002], 1),
            ("sdiv r0, r1, r2", &[0xFB91, 0xF0F2], 12),
            ("it eq; nop", &[0xBF08, 0xBF00], 2),
            ("vadd s0, s1, s2; nop", &[0xEE30, 0x0A81, 0xBF00], 2),
            (
                "vadd s0, s1, s2; vmul s3, s0, s1",
                &[0xEE30, 0x0A81, 0xEE60, 0x1A20],
                3,
            ),
            (
                "vadd s0, s1, s2; vstr s0, [r0]",
                &[0xEE30, 0x0A81, 0xED80, 0x0A00],
                4,
            ),
            (
                "vadd s0, s1, s2; vmov r0, s0",
                &[0xEE30, 0x0A81, 0xEE10, 0x0A10],
                3,
            ),
            ("vfma s0, s1, s2", &[0xEEA0, 0x0A81], 3),
            ("vnmla s0, s1, s2", &[0xEE10, 0x0AC1], 3),
            ("vdiv s0, s1, s2", &[0xEE80, 0x0A81], 14),
            ("vsqrt s0, s1", &[0xEEB1, 0x0AE0], 14),
            (
                "vabs s0, s1; vneg s0, s0; vmov s0, #1",
                &[0xEEB0, 0x0AE0, 0xEEB1, 0x0A40, 0xEEB7, 0x0A00],
                3,
            ),
            (
                "vcmp s0, s1; vmrs APSR_nzcv, fpscr",
                &[0xEEB4, 0x0A60, 0xEEF1, 0xFA10],
                2,
            ),
            (
                "vcvt.f32.s32 s0, s1; vcmp s0, #0",
                &[0xEEB8, 0x0AE0, 0xEEB5, 0x0A40],
                3,
            ),
            ("vmov r0, r1, d0", &[0xEC51, 0x0B10], 2),
            (
                "vldr s0, [r0]; vldr d0, [r0]",
                &[0xED90, 0x0A00, 0xED90, 0x0B00],
                5,
            ),
            ("vpush {d8-d10}", &[0xED2D, 0x8B06], 7),
            ("vpop {d8-d10}", &[0xECBD, 0x8B06], 7),
        ];
        for (text, code, expected) in sequences {
            assert_eq!(cycles(code, None), expected, "{text}");
        }
        let branches: [(&str, &[u16], u64); 5] = [
            ("b", &[0xE7FE], 1),
            ("bl", &[0xF000, 0xF802], 1),
            ("bx lr", &[0x4770], 1),
            ("pop {r4-r7, pc}", &[0xBDF0], 6),
            ("tbb [pc, r0]", &[0xE8DF, 0xF000], 2),
        ];
        for (text, code, expected) in branches {
            assert_eq!(cycles(code, Some(100)), expected + REFILL, "{text}");
        }
        assert_eq!(cycles(&[0xD1FE], None), 1, "bne that is not taken");
    }

    #[test]
    fn steps_are_read_from_a_log() {
        // nop; bl step; nop; b .; step: bx lr
        let code: [u16; 6] = [0xBF00, 0xF000, 0xF802, 0xBF00, 0xE7FE, 0x4770];
        let flash: Vec<u8> = code.iter().flat_map(|half| half.to_le_bytes()).collect();
        let line = |(at, name): (u32, &str)| {
            format!("Trace 0: 0x7f4f48000100 [00800408/{at:016x}/00000110/ff022201] {name}\n")
        };
        let step = format!("{STEP}0123456789abcdefE");
        let run = [(0, "main"), (2, "main"), (10, &step), (6, "main")];
        let log: String = run.map(line).concat();
        let taken = read(log.as_bytes(), (&flash, 0)).unwrap();
        let expected = Spent {
            instructions: 1,
            cycles: 1 + REFILL,
        };
        assert_eq!(taken, expected);
        assert!(read(&*line((0, "main")).into_bytes(), (&flash, 0)).is_err());
        assert!(read(&*line((100, "main")).into_bytes(), (&flash, 0)).is_err());
    }
}
