//! What the crate's core does not do as the processor does (Armv8-M Architecture Reference Manual, B3 and C2.4), done here. Of the instructions:
//! it refuses to store and load D registers (VPUSH, VPOP); it takes one bit of VSEL, VMAXNM and VMINNM for another, and STL and LDA for
//! instructions with two registers; a sum of nothing has the wrong sign in VNMLA. Of interrupts: it knows three bits of a priority, of which
//! the chip has four; it takes bytes written to priorities for nothing; and it calls it a fault where one returns that used no S register,
//! and interrupted another one before that used any. None of these instructions may be conditional.

use rp2350_emu::CortexM33;
use rp2350_emu::core::CoreBus;

use super::Chip;

/// Priorities of interrupts, a byte each (NVIC_IPR), of which the chip has the upper four bits.
const PRIORITIES: std::ops::Range<u32> = 0xE000_E400..0xE000_E434;
/// Of FPCCR: S registers are stored when they are used, not at once (LSPEN).
const LAZY: u32 = 1 << 30;

/// Where an interrupt begins, it stores S registers at once. The program sees no difference: it cannot look into what is stored.
pub(super) fn store_at_once(core: &mut CortexM33) {
    core.ppb.fpccr &= !LAZY;
}

/// A priority in three bits. Of 16 the program has some of the least urgent seven, which stay in their order and are not 0, which masks
/// nothing.
fn narrowed(priority: u8) -> u8 {
    assert!(priority > 0x80, "the priority {priority:#x}");
    (priority & 0x70) << 1
}

/// The opposite.
const fn widened(priority: u8) -> u8 {
    priority >> 1 | 0x80
}

/// The S registers of an instruction: d, n, m.
fn numbers(first: u16, second: u16) -> [usize; 3] {
    let number = |high: u16, low: u16| usize::from((high & 15) << 1 | low & 1);
    [
        number(second >> 12, first >> 6),
        number(first, second >> 7),
        number(second, second >> 5),
    ]
}

impl Chip {
    /// Writes bytes to priorities.
    pub(super) fn prioritize(&mut self) {
        for (at, byte) in self.fabric.core_bytes.drain(..) {
            if PRIORITIES.contains(&at) {
                let (word, shift) = ((at - PRIORITIES.start) as usize / 4, at % 4 * 8);
                let priorities = &mut self.core.ppb.nvic_ipr[word];
                *priorities = *priorities & !(0xFF << shift) | u32::from(narrowed(byte)) << shift;
            }
        }
    }

    /// The priority of an interrupt, as it was written.
    pub(super) fn priority_of(&self, interrupt: usize) -> u8 {
        let priorities = self.core.ppb.nvic_ipr[interrupt / 4].to_le_bytes();
        widened(priorities[interrupt % 4])
    }

    /// Does the next instruction if the crate does not; the result is whether.
    pub(super) fn corrected(&mut self, at: u32) -> bool {
        let [first, second] = [0, 2].map(|offset| self.fabric.read16(at + offset, 0));
        let is_done = match (first, second) {
            // The words are those of S registers, in an instruction that differs in one bit.
            (0xED2D | 0xECBD, _) if second & 0xF00 == 0xB00 => {
                self.fabric.write(at + 2, (second ^ 0x100).to_le_bytes());
                false
            }
            (0xFE00..0xFF00, _) if second & 0xF10 == 0xA00 => {
                self.choose(first, second);
                true
            }
            (0xEE10.., _) if first & 0xFFB0 == 0xEE10 && second & 0xF50 == 0xA40 => {
                self.subtract_both(first, second);
                true
            }
            (0xE8C0..0xE8E0, _) if second & 0xFFF == 0xFAF => {
                self.order(first, second);
                true
            }
            // MSR to BASEPRI, MRS from there.
            (0xF380..0xF38F, 0x8811) => {
                let priority = self.core.reg(usize::from(first & 15)) as u8;
                self.core.regs.basepri = match priority {
                    0 => 0,
                    _ => narrowed(priority).into(),
                };
                true
            }
            (0xF3EF, _) if second & 0xF0FF == 0x8011 => {
                let priority = match self.core.regs.basepri as u8 {
                    0 => 0,
                    priority => widened(priority).into(),
                };
                self.core.set_reg(usize::from(second >> 8 & 15), priority);
                true
            }
            _ => false,
        };
        if is_done {
            self.core.regs.set_pc(at + 4);
        }
        is_done
    }

    /// STL or LDA: a word is stored or loaded, in order, as all are here.
    fn order(&mut self, first: u16, second: u16) {
        let (at, number) = (
            self.core.reg(usize::from(first & 15)),
            usize::from(second >> 12),
        );
        if first & 0x10 == 0 {
            let word = self.core.reg(number);
            self.fabric.write32(at, word, 0);
        } else {
            let word = self.fabric.read32(at, 0);
            self.core.set_reg(number, word);
        }
    }

    /// VNMLA of S registers.
    fn subtract_both(&mut self, first: u16, second: u16) {
        let [d, n, m] = numbers(first, second);
        let s = &mut self.core.regs.s;
        s[d] = -s[d] + -(s[n] * s[m]);
    }

    /// VSEL, VMAXNM or VMINNM of S registers.
    fn choose(&mut self, first: u16, second: u16) {
        let [d, n, m] = numbers(first, second);
        let regs = &mut self.core.regs;
        let [n, m] = [n, m].map(|number| regs.s[number]);
        let is_greater_or_equal = regs.flag_n() == regs.flag_v();
        let holds = match first >> 4 & 3 {
            0 => regs.flag_z(),
            1 => regs.flag_v(),
            2 => is_greater_or_equal,
            _ => is_greater_or_equal && !regs.flag_z(),
        };
        let [is_extreme, is_least] = [first >> 7, second >> 6].map(|bit| bit & 1 != 0);
        regs.s[d] = match (is_extreme, is_least) {
            (false, _) if holds => n,
            (false, _) => m,
            // Of two zeros the one with a sign is the least.
            (true, false) if n == m => f32::from_bits(n.to_bits() & m.to_bits()),
            (true, false) => n.max(m),
            (true, true) if n == m => f32::from_bits(n.to_bits() | m.to_bits()),
            (true, true) => n.min(m),
        };
    }
}
