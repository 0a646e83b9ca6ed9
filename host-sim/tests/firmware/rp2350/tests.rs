//! Instructions of the core, against the arithmetic of this computer: those that are corrected here, and those of S registers that programs
//! in f32 are made of; and interrupts. The words of instructions are those of GNU as.

use super::{Chip, FLASH, RAM, TIMER0_IRQ_0, UART0_IRQ};
use rp2350_emu::core::CoreBus;
use std::sync::atomic::Ordering;
use stiction_tests::station::noise::Random;

/// Where the stack begins.
const STACK: u32 = RAM + 0x1000;

/// What is hard to get right: zeros, the smallest and largest numbers, those around integers, infinity, NaN.
const SPECIAL: [f32; 14] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1.5,
    -2.5,
    f32::MIN_POSITIVE,
    -1e-42,
    f32::MAX,
    2_147_483_648.0,
    -2_147_483_904.0,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
];
/// Random numbers besides.
const COUNT: usize = 10_000;

/// A program.
struct Code(Chip);

impl Code {
    fn new(code: &[u16]) -> Self {
        let head = [STACK, (FLASH + 8) | 1];
        let head = head.iter().flat_map(|word| word.to_le_bytes());
        let code = code.iter().flat_map(|half| half.to_le_bytes());
        // What is read after it.
        Self(Chip::new(head.chain(code).chain([0; 8]).collect()))
    }

    /// Executes so many instructions of it, from the beginning.
    fn run(&mut self, count: usize) {
        self.0.core.regs.set_pc(FLASH + 8);
        (0..count).for_each(|_| self.0.step());
    }

    /// S0 after its only instruction, of what was in S0, S1, S2.
    fn of(&mut self, operands: [f32; 3]) -> f32 {
        self.0.core.regs.s[..3].copy_from_slice(&operands);
        self.run(1);
        assert_eq!(self.0.at(), FLASH + 12);
        self.0.core.regs.s[0]
    }
}

/// All triples of special numbers, and random ones, of which some cancel or almost do.
fn operands() -> Vec<[f32; 3]> {
    let mut random = Random(8);
    let mut number = || f32::from_bits(random.bits() as u32);
    let near = |x: f32| x.clamp(-1e9, 1e9) * 1e-9;
    let pairs = SPECIAL.into_iter().flat_map(|a| SPECIAL.map(|b| [a, b]));
    let special = pairs.flat_map(|[a, b]| SPECIAL.map(|c| [a, b, c]));
    let random = (0..COUNT).flat_map(|_| {
        let [a, b, c] = [number(), number(), number()];
        let [x, y] = [near(b), near(c)];
        [[a, b, c], [x * y, x, y], [-x * y, x, y], [near(a), x, y]]
    });
    special.chain(random).collect()
}

/// The same bits, or NaN.
fn assert_computes(name: &str, code: [u16; 2], expected: impl Fn([f32; 3]) -> f32) {
    let mut code = Code::new(&code);
    for operands in operands() {
        let (got, expected) = (code.of(operands), expected(operands));
        assert!(
            got.to_bits() == expected.to_bits() || got.is_nan() && expected.is_nan(),
            "{name} of {operands:?}: {got:?}, not {expected:?}"
        );
    }
}

#[test]
fn s_registers_compute_as_f32_does() {
    let integer = |x: f32| x.to_bits() as i32;
    assert_computes("vadd", [0xEE30, 0x0A81], |[_, n, m]| n + m);
    assert_computes("vsub", [0xEE30, 0x0AC1], |[_, n, m]| n - m);
    assert_computes("vmul", [0xEE20, 0x0A81], |[_, n, m]| n * m);
    assert_computes("vnmul", [0xEE20, 0x0AC1], |[_, n, m]| -(n * m));
    assert_computes("vdiv", [0xEE80, 0x0A81], |[_, n, m]| n / m);
    assert_computes("vabs", [0xEEB0, 0x0AE0], |[_, m, _]| m.abs());
    assert_computes("vneg", [0xEEB1, 0x0A60], |[_, m, _]| -m);
    assert_computes("vsqrt", [0xEEB1, 0x0AE0], |[_, m, _]| m.sqrt());
    assert_computes("vcvt.s32.f32", [0xEEBD, 0x0AE0], |[_, m, _]| {
        f32::from_bits(m as i32 as u32)
    });
    assert_computes("vcvt.f32.s32", [0xEEB8, 0x0AE0], |[_, m, _]| {
        integer(m) as f32
    });
    assert_computes("vcvt.f32.u32", [0xEEB8, 0x0A60], |[_, m, _]| {
        m.to_bits() as f32
    });
}

/// A sum takes its operands with their signs changed, so that a sum of nothing is +0 in each.
#[test]
fn products_are_rounded_before_they_are_added() {
    assert_computes("vmla", [0xEE00, 0x0A81], |[d, n, m]| d + n * m);
    assert_computes("vmls", [0xEE00, 0x0AC1], |[d, n, m]| d + -(n * m));
    assert_computes("vnmls", [0xEE10, 0x0A81], |[d, n, m]| -d + n * m);
    assert_computes("vnmla", [0xEE10, 0x0AC1], |[d, n, m]| -d + -(n * m));
}

/// As maxNum and minNum of IEEE 754-2008, where a zero with a sign is less than one without.
#[test]
fn the_larger_and_the_smaller_of_two_numbers_are_those_of_ieee_754() {
    let chosen = |n: f32, m: f32, is_n: bool| match (n.is_nan(), m.is_nan()) {
        (true, _) => m,
        (_, true) => n,
        _ if is_n => n,
        _ => m,
    };
    assert_computes("vmaxnm", [0xFE80, 0x0A81], |[_, n, m]| {
        chosen(n, m, n.total_cmp(&m).is_gt())
    });
    assert_computes("vminnm", [0xFE80, 0x0AC1], |[_, n, m]| {
        chosen(n, m, n.total_cmp(&m).is_lt())
    });
}

/// Conditions are those of a comparison of integers before.
#[test]
fn a_number_is_selected_by_a_comparison() {
    const NUMBERS: [i32; 6] = [0, 1, -1, 5, i32::MAX, i32::MIN];
    // CMP r0, r1; VSELEQ s0, s1, s2; VSELVS s3, s1, s2; VSELGE s4, s1, s2; VSELGT s31, s1, s2.
    let mut code = Code::new(&[
        0x4288, 0xFE00, 0x0A81, 0xFE50, 0x1A81, 0xFE20, 0x2A81, 0xFE70, 0xFA81,
    ]);
    for [a, b] in NUMBERS.into_iter().flat_map(|a| NUMBERS.map(|b| [a, b])) {
        code.0.core.set_reg(0, a as u32);
        code.0.core.set_reg(1, b as u32);
        code.0.core.regs.s[1..3].copy_from_slice(&[1.0, 2.0]);
        code.run(5);
        let selected = [0, 3, 4, 31].map(|number| code.0.core.regs.s[number] == 1.0);
        let expected = [a == b, a.checked_sub(b).is_none(), a >= b, a > b];
        assert_eq!(selected, expected, "{a} {b}");
    }
}

#[test]
fn d_registers_are_pushed_and_popped_as_pairs_of_s_registers() {
    // VPUSH {d8-d15}; VPOP {d8-d15}.
    let mut code = Code::new(&[0xED2D, 0x8B10, 0xECBD, 0x8B10]);
    let numbers: [f32; 16] = std::array::from_fn(|i| i as f32 + 0.5);
    code.0.core.regs.s[16..].copy_from_slice(&numbers);
    code.run(1);
    let below = STACK - 64;
    assert_eq!(code.0.core.reg(13), below);
    for (place, number) in (below..).step_by(4).zip(numbers) {
        assert_eq!(code.0.fabric.read32(place, 0), number.to_bits());
    }
    code.0.core.regs.s[16..].fill(0.0);
    code.0.step();
    assert_eq!(code.0.core.regs.s[16..], numbers);
    assert_eq!(code.0.core.reg(13), STACK);
}

#[test]
fn words_are_stored_and_loaded_in_order() {
    // STL r0, [r1]; LDA r2, [r1].
    let mut code = Code::new(&[0xE8C1, 0x0FAF, 0xE8D1, 0x2FAF]);
    code.0.core.set_reg(0, 0x1234_5678);
    code.0.core.set_reg(1, RAM + 8);
    code.run(2);
    assert_eq!(code.0.fabric.read32(RAM + 8, 0), 0x1234_5678);
    assert_eq!(code.0.core.reg(2), 0x1234_5678);
}

/// As a program masks interrupts and undoes it.
#[test]
fn a_masked_priority_reads_as_it_was_written() {
    // MSR BASEPRI, r3; MRS r4, BASEPRI.
    let mut code = Code::new(&[0xF383, 0x8811, 0xF3EF, 0x8411]);
    for priority in [0xC0, 0, 0xF0, 0xD0, 0x90] {
        code.0.core.set_reg(3, priority);
        code.run(2);
        assert_eq!(code.0.core.reg(4), priority);
    }
}

/// An interrupt within an interrupt: whichever of them uses S registers, what the program had in one is there again.
#[test]
fn interrupts_leave_s_registers_as_they_were() {
    const NOTHING: [u16; 2] = [0xF3AF, 0x8000];
    // VMUL s0, s1, s2.
    const USE: [u16; 2] = [0xEE20, 0x0A81];
    const VECTORS: u32 = RAM + 0x400;
    let both = [[NOTHING, NOTHING], [USE, NOTHING], [NOTHING, USE], [USE; 2]];
    for [outer, inner] in both {
        // VADD s0, s1, s2; NOP; NOP. The outer one: NOP, what it does, BX lr. The inner one: what it does, BX lr.
        let mut code = Code::new(&[
            0xEE30, 0x0A81, 0xBF00, 0xBF00, 0xBF00, outer[0], outer[1], 0x4770, inner[0], inner[1],
            0x4770,
        ]);
        let Code(chip) = &mut code;
        chip.core.ppb.vtor = VECTORS;
        for (interrupt, at, priority) in [(TIMER0_IRQ_0, 8, 0xE0), (UART0_IRQ, 16, 0xC0)] {
            let (word, place) = (interrupt as usize / 32, interrupt % 32);
            chip.core.ppb.nvic_iser[word].store(1 << place, Ordering::Relaxed);
            let vector = (FLASH + 8 + at) | 1;
            chip.fabric
                .write32(VECTORS + 4 * (16 + interrupt), vector, 0);
            chip.core.ppb.nvic_ipr[interrupt as usize / 4] |= priority << (interrupt % 4 * 8);
        }
        assert_eq!(code.of([0.0, 1.0, 2.0]), 3.0);
        let Code(chip) = &mut code;
        // It begins, and does its first instruction.
        chip.interrupt(TIMER0_IRQ_0);
        (0..2).for_each(|_| chip.step());
        // It begins, does what it does, and returns.
        chip.interrupt(UART0_IRQ);
        (0..3).for_each(|_| chip.step());
        assert_eq!(chip.serving(), Some(TIMER0_IRQ_0));
        (0..2).for_each(|_| chip.step());
        assert_eq!((chip.serving(), chip.at()), (None, FLASH + 12));
        assert_eq!((chip.core.regs.s[0], chip.core.reg(13)), (3.0, STACK));
    }
}
