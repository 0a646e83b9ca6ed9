//! The RP2350 as far as a program on its serial line sees it: one Cortex-M33, its memory, registers that remember, a timer that interrupts,
//! and UART0 with its line. The core is that of the crate `rp2350-emu`, with corrections; its peripherals are left out. Of the ROM there is
//! one function only. An instruction takes a cycle, which is not so on the chip.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use rp2350_emu::CortexM33;
use rp2350_emu::core::CoreBus;
use rp2350_emu::threaded::CoreAtomics;

use crate::bench::Clocked;

mod corrections;
mod fabric;
mod peripherals;
mod tests;
#[path = "../../pico/src/uart.rs"]
mod uart;

use fabric::Fabric;
pub(crate) use peripherals::*;

/// Where its memory is, and how much RAM it has (RP2350 datasheet, 2.2).
pub(crate) const FLASH: u32 = 0x1000_0000;
pub(crate) const RAM: u32 = 0x2000_0000;
pub(crate) const RAM_SIZE: usize = 520 << 10;

/// The chip's device and wafer numbers, as its ROM reports them.
pub(crate) const DEVICE: u32 = 0x89AB_CDEF;
pub(crate) const WAFER: u32 = 0x0123_4567;
/// Two functions of the ROM, at addresses of ours.
const LOOKUP: u32 = 0x100;
const GET_SYS_INFO: u32 = 0x200;
/// The code of the second, and what it is asked for (datasheet, 5.4).
const GET_SYS_INFO_CODE: u32 = u32::from_le_bytes(*b"GS\0\0");
const CHIP_INFO: u32 = 1;

/// The interrupts of its timer and of UART0 (datasheet, 3.2).
const TIMER0_IRQ_0: u32 = 0;
const UART0_IRQ: u32 = 33;

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
        corrections::store_at_once(&mut core);
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
                let due = self.fabric.peripherals.next().min(end);
                self.fabric.peripherals.cycles = due.max(self.cycles() + 1);
            } else {
                self.step();
            }
            self.fire();
        }
    }

    /// Its timer interrupts it when that is due; UART0, as long as it has a cause and is not served.
    fn fire(&mut self) {
        let peripherals = &mut self.fabric.peripherals;
        let is_due = peripherals
            .due()
            .is_some_and(|due| due <= peripherals.cycles);
        if is_due && peripherals.fire() {
            self.interrupt(TIMER0_IRQ_0);
        }
        if self.fabric.peripherals.line_interrupts() && !self.serves(UART0_IRQ) {
            self.interrupt(UART0_IRQ);
        }
    }

    fn interrupt(&mut self, interrupt: u32) {
        self.fabric.atomics().assert_irq(0, interrupt);
        if self.priority(interrupt).is_some() {
            self.core.wake();
        }
    }

    /// An interrupt has begun and not returned; another one may have begun in it.
    pub(crate) fn serves(&self, interrupt: u32) -> bool {
        let active = self.core.ppb.nvic_iabr[interrupt as usize / 32].load(Ordering::Relaxed);
        active >> (interrupt % 32) & 1 != 0
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
        self.prioritize();
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
        (enabled >> (index % 32) & 1 != 0).then(|| self.priority_of(index))
    }

    /// The interrupt that goes on, the innermost one.
    pub(crate) fn serving(&self) -> Option<u32> {
        self.core.regs.ipsr().checked_sub(16)
    }

    /// No other interrupt is.
    pub(crate) fn enabled(&self) -> usize {
        let words = self.core.ppb.nvic_iser.iter();
        words
            .map(|word| word.load(Ordering::Relaxed).count_ones() as usize)
            .sum()
    }
}

impl Clocked for Chip {
    const FLASH: u32 = FLASH;
    const MS: u64 = CYCLES * 1_000;

    fn power_up(flash: Vec<u8>) -> Self {
        Self::new(flash)
    }

    fn run(&mut self, cycles: u64) {
        self.run(cycles);
    }

    fn bring(&mut self, bytes: &[u8]) {
        self.fabric.peripherals.bring(bytes);
    }

    fn gone(&mut self) -> Vec<u8> {
        self.fabric.peripherals.gone()
    }
}

impl fmt::Debug for Chip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (at, cycles, coming) = (self.at(), self.cycles(), self.fabric.peripherals.coming());
        write!(
            f,
            "Pico 2 at {at:#x} after {cycles} cycles, {coming} bytes in transit"
        )
    }
}
