//! The RP2350 as far as the set-up of a program sees it: one Cortex-M33, its memory, registers that remember, a timer that interrupts. The
//! core is that of the crate `rp2350-emu`, whose peripherals are left out: what counts is what is written, and where. It knows three bits of
//! a priority, of which the chip has four: the line and the tick interrupt each other as equals. Of the ROM there is one function only.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use rp2350_emu::CortexM33;
use rp2350_emu::core::CoreBus;
use rp2350_emu::threaded::CoreAtomics;

mod fabric;
mod peripherals;

use fabric::Fabric;
pub(crate) use peripherals::*;

/// Where its memory is, and how much RAM it has (RP2350 datasheet, 2.2).
pub(crate) const FLASH: u32 = 0x1000_0000;
pub(crate) const RAM: u32 = 0x2000_0000;
pub(crate) const RAM_SIZE: usize = 520 << 10;

/// Of the chip, as its ROM tells it: its device, its wafer.
pub(crate) const DEVICE: u32 = 0x89AB_CDEF;
pub(crate) const WAFER: u32 = 0x0123_4567;
/// Two functions of the ROM, at addresses of ours.
const LOOKUP: u32 = 0x100;
const GET_SYS_INFO: u32 = 0x200;
/// The code of the second, and what it is asked for (datasheet, 5.4).
const GET_SYS_INFO_CODE: u32 = u32::from_le_bytes(*b"GS\0\0");
const CHIP_INFO: u32 = 1;

/// The interrupt of its timer (datasheet, 3.2).
const TIMER0_IRQ_0: u32 = 0;

/// Priorities of interrupts, a byte each (NVIC_IPR), of which the chip has the upper four bits.
const PRIORITIES: std::ops::Range<u32> = 0xE000_E400..0xE000_E434;

/// The chip.
pub(crate) struct Chip {
    core: CortexM33,
    fabric: Fabric,
}

impl Chip {
    /// At the reset vector, with what lies in its flash. What the ROM did before is left out, but that it took the vectors there.
    pub(crate) fn new(flash: Vec<u8>) -> Self {
        let atomics = Arc::new(CoreAtomics::default());
        let mut core = CortexM33::new(0, Arc::clone(&atomics));
        let mut fabric = Fabric::new(flash, atomics);
        let [stack, reset] = [0, 4].map(|offset| fabric.read32(FLASH + offset, 0));
        core.ppb.vtor = FLASH;
        core.regs.msp = stack;
        core.set_reg(13, stack);
        core.regs.set_pc(reset & !1);
        Self { core, fabric }
    }

    /// Where the next instruction is.
    pub(crate) fn at(&self) -> u32 {
        self.core.regs.pc()
    }

    /// It waits for an interrupt.
    pub(crate) fn sleeps(&self) -> bool {
        self.core.is_halted()
    }

    /// Cycles since power-up, as its timer counts them: an instruction takes one.
    pub(crate) fn cycles(&self) -> u64 {
        self.fabric.peripherals.cycles
    }

    /// Goes on for so many cycles, most of them asleep.
    pub(crate) fn run(&mut self, cycles: u64) {
        let end = self.cycles() + cycles;
        while self.cycles() < end {
            if self.sleeps() {
                let due = self.fabric.peripherals.due().unwrap_or(end).min(end);
                self.fabric.peripherals.cycles = due.max(self.cycles() + 1);
            } else {
                self.step();
            }
            self.fire();
        }
    }

    /// Its timer interrupts it when that is due.
    fn fire(&mut self) {
        let peripherals = &mut self.fabric.peripherals;
        let is_due = peripherals
            .due()
            .is_some_and(|due| due <= peripherals.cycles);
        if is_due && peripherals.fire() {
            self.fabric.atomics().assert_irq(0, TIMER0_IRQ_0);
            self.core.wake();
        }
    }

    /// One instruction, or one function of the ROM.
    pub(crate) fn step(&mut self) {
        self.fabric.peripherals.cycles += 1;
        match self.at() {
            LOOKUP => {
                assert_eq!(self.core.reg(0), GET_SYS_INFO_CODE, "looked up in the ROM");
                self.return_with(GET_SYS_INFO | 1);
            }
            GET_SYS_INFO => self.get_sys_info(),
            at if self.corrected(at) => {}
            _ => self.core.step(&mut self.fabric),
        }
        for (at, byte) in self.fabric.core_bytes.drain(..) {
            if PRIORITIES.contains(&at) {
                let (word, shift) = ((at - PRIORITIES.start) as usize / 4, at % 4 * 8);
                let priorities = &mut self.core.ppb.nvic_ipr[word];
                *priorities = *priorities & !(0xFF << shift) | u32::from(byte & 0xF0) << shift;
            }
        }
    }

    /// Writes what was asked for, package, device, wafer into the caller's buffer.
    fn get_sys_info(&mut self) {
        let [buffer, room, asked] = [0, 1, 2].map(|number| self.core.reg(number));
        assert_eq!((room, asked), (4, CHIP_INFO), "asked of the ROM");
        for (place, word) in (buffer..).step_by(4).zip([asked, 0, DEVICE, WAFER]) {
            self.fabric.write(place, word.to_le_bytes());
        }
        self.return_with(room);
    }

    fn return_with(&mut self, value: u32) {
        self.core.set_reg(0, value);
        let back = self.core.reg(14) & !1;
        self.core.regs.set_pc(back);
    }

    /// What the crate does not do as the processor does (Armv8-M Architecture Reference Manual, C2.4). It refuses to store and load D
    /// registers (VPUSH, VPOP): the words are those of S registers, in an instruction that differs in one bit. It takes one bit of VSEL, VMAXNM
    /// and VMINNM for another, and STL and LDA for instructions with two registers: they are executed here, and the result is whether.
    fn corrected(&mut self, at: u32) -> bool {
        let [first, second] = [0, 2].map(|offset| self.fabric.read16(at + offset, 0));
        let is_done = match (first, second) {
            (0xED2D | 0xECBD, _) if second & 0xF00 == 0xB00 => {
                self.fabric.write(at + 2, (second ^ 0x100).to_le_bytes());
                false
            }
            (0xFE00.., _) if second & 0xF10 == 0xA00 && first < 0xFF00 => {
                self.choose(first, second);
                true
            }
            (0xE8C0..0xE8E0, _) if second & 0xFFF == 0xFAF => {
                self.order(first, second);
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

    /// VSEL, VMAXNM or VMINNM of S registers.
    fn choose(&mut self, first: u16, second: u16) {
        let number = |high: u16, low: u16| usize::from((high & 15) << 1 | low & 1);
        let regs = &mut self.core.regs;
        let n = regs.s[number(first, second >> 7)];
        let m = regs.s[number(second, second >> 5)];
        let is_greater_or_equal = regs.flag_n() == regs.flag_v();
        let holds = match first >> 4 & 3 {
            0 => regs.flag_z(),
            1 => regs.flag_v(),
            2 => is_greater_or_equal,
            _ => is_greater_or_equal && !regs.flag_z(),
        };
        let [is_extreme, is_least] = [first >> 7, second >> 6].map(|bit| bit & 1 != 0);
        regs.s[number(second >> 12, first >> 6)] = match (is_extreme, is_least) {
            (false, _) if holds => n,
            (false, _) => m,
            // Of two zeros the one with a sign is the least.
            (true, false) if n == m => f32::from_bits(n.to_bits() & m.to_bits()),
            (true, false) => n.max(m),
            (true, true) if n == m => f32::from_bits(n.to_bits() | m.to_bits()),
            (true, true) => n.min(m),
        };
    }

    /// What a register of a peripheral holds.
    pub(crate) fn word(&self, at: u32) -> u32 {
        self.fabric.peripherals.word(at)
    }

    /// What was written to a register: when (cycles), and what it then held.
    pub(crate) fn written(&self, register: u32) -> Vec<(u64, u32)> {
        let written = self.fabric.peripherals.written.iter();
        let here = written.filter(|(_, at, _)| *at == register);
        here.map(|(when, _, word)| (*when, *word)).collect()
    }

    /// Where the program read or wrote a peripheral in reset.
    pub(crate) fn lost(&self) -> &[u32] {
        &self.fabric.peripherals.lost
    }

    /// Its RAM.
    pub(crate) fn ram(&self) -> &[u8] {
        &self.fabric.ram
    }

    /// The priority of an interrupt if it is enabled: the lower, the sooner it comes.
    pub(crate) fn priority(&self, interrupt: u32) -> Option<u8> {
        let index = interrupt as usize;
        let enabled = self.core.ppb.nvic_iser[index / 32].load(Ordering::Relaxed);
        let priorities = self.core.ppb.nvic_ipr[index / 4].to_le_bytes();
        (enabled >> (index % 32) & 1 != 0).then_some(priorities[index % 4])
    }

    /// No other interrupt is.
    pub(crate) fn enabled(&self) -> usize {
        let words = self.core.ppb.nvic_iser.iter();
        words
            .map(|word| word.load(Ordering::Relaxed).count_ones() as usize)
            .sum()
    }
}
