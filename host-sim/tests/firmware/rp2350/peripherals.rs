//! The peripherals of the RP2350, which only remember: a register holds what was written to it, or what the datasheet gives it at reset.
//! Some answer for the hardware, and say what the datasheet says of them: a crystal that is stable, a PLL that is locked, a clock that has
//! changed over, a block that is out of reset, a timer that counts and fires. UART0, the same PL011 as that of the RP2040, sends and receives.

use std::collections::BTreeMap;

use super::uart::Uart;

/// Where they are (RP2350 datasheet, 2.2.4 and 2.2.5).
pub(crate) const CLOCKS: u32 = 0x4001_0000;
pub(crate) const PSM: u32 = 0x4001_8000;
pub(crate) const RESETS: u32 = 0x4002_0000;
pub(crate) const IO_BANK0: u32 = 0x4002_8000;
pub(crate) const PADS_BANK0: u32 = 0x4003_8000;
pub(crate) const XOSC: u32 = 0x4004_8000;
pub(crate) const PLL_SYS: u32 = 0x4005_0000;
pub(crate) const PLL_USB: u32 = 0x4005_8000;
pub(crate) const UART0: u32 = 0x4007_0000;
pub(crate) const TIMER0: u32 = 0x400B_0000;
pub(crate) const WATCHDOG: u32 = 0x400D_8000;
pub(crate) const TICKS: u32 = 0x4010_8000;
const USB_DPRAM: u32 = 0x5010_0000;
pub(crate) const USB: u32 = 0x5011_0000;

/// A peripheral has 16 KB: its registers, and three times the same, where writing inverts, sets and clears bits (datasheet, 2.1.3).
const BLOCK: u32 = !0x3FFF;
/// Those that are reset by a bit of RESETS, and its number (datasheet, 7.5).
const RESETTABLE: [(u32, u32); 8] = [
    (IO_BANK0, 6),
    (PADS_BANK0, 9),
    (PLL_SYS, 14),
    (PLL_USB, 15),
    (TIMER0, 23),
    (UART0, 26),
    (USB, 28),
    (USB_DPRAM, 28),
];
/// At power-up all are.
const ALL_RESET: u32 = 0x1FFF_FFFF;
/// Registers of UART0 that are not 0 at reset.
const UARTCR: u32 = 0x30;
const UARTIFLS: u32 = 0x34;
/// An instruction is taken for a cycle of the processor: so many in a microsecond.
pub(crate) const CYCLES: u64 = 150;
/// Of the timer: its first alarm; which are armed; which have fired, which of them interrupt.
pub(crate) const ALARM0: u32 = TIMER0 + 0x10;
const ARMED: u32 = TIMER0 + 0x20;
const INTR: u32 = TIMER0 + 0x3C;
const INTE: u32 = TIMER0 + 0x40;

/// What a register holds at reset, if it is not 0. Of a peripheral not named here, nothing is known.
const fn reset_value(at: u32) -> u32 {
    let offset = at & 0xFFF;
    match (at & BLOCK, offset) {
        (RESETS, 0) => ALL_RESET,
        // CLK_REF_DIV, CLK_SYS_DIV, CLK_PERI_DIV, CLK_HSTX_DIV, CLK_USB_DIV, CLK_ADC_DIV: INT is 1 (8.1).
        (CLOCKS, 0x34 | 0x40 | 0x4C | 0x58 | 0x64 | 0x70) => 1 << 16,
        // CS: REFDIV is 1. PWR: VCOPD, POSTDIVPD, DSMPD, PD. PRIM: both dividers are 7 (8.6).
        (PLL_SYS | PLL_USB, 0) => 1,
        (PLL_SYS | PLL_USB, 4) => 0x2D,
        (PLL_SYS | PLL_USB, 0xC) => 0x7_7000,
        // GPIO0_CTRL to GPIO47_CTRL: FUNCSEL is NULL (9.11).
        (IO_BANK0, 0..0x180) if offset & 4 != 0 => 0x1F,
        // GPIO0 to GPIO47: ISO, DRIVE of 4 mA, PDE, SCHMITT (9.11).
        (PADS_BANK0, 4..0xC4) => 0x116,
        // UARTCR: RXE, TXE. UARTIFLS: both at the half (12.1).
        (UART0, UARTCR) => 0x300,
        (UART0, UARTIFLS) => 0x12,
        // MAIN_CTRL: PHY_ISO. SIE_CTRL: PULLDOWN_EN. USB_MUXING: TO_PHY (12.7).
        (USB, 0x40) => 1 << 2,
        (USB, 0x4C) => 1 << 15,
        (USB, 0x74) => 1,
        // CTRL: PAUSE_DBG1, PAUSE_DBG0, PAUSE_JTAG (12.9).
        (WATCHDOG, 0) => 7 << 24,
        _ => 0,
    }
}

/// CTRL of XOSC, after something was written: a field that gets none of its codes keeps what it had (8.2).
const fn crystal(stored: u32, written: u32) -> u32 {
    let enable = match written >> 12 {
        code @ (0xD1E | 0xFAB) => code,
        _ => stored >> 12,
    };
    let range = match written & 0xFFF {
        code @ 0xAA0..=0xAA3 => code,
        _ => stored & 0xFFF,
    };
    enable << 12 | range
}

/// The peripherals.
#[derive(Default)]
pub(super) struct Peripherals {
    registers: BTreeMap<u32, u32>,
    /// Where the program read or wrote a peripheral in reset.
    pub(super) lost: Vec<u32>,
    /// Of the processor since power-up, as the timer has it.
    pub(super) cycles: u64,
    /// What was written: when (cycles), to which register, what it then held.
    pub(super) written: Vec<(u64, u32, u32)>,
    uart: Uart,
}

impl Peripherals {
    /// What a register holds.
    pub(super) fn word(&self, at: u32) -> u32 {
        if at & BLOCK == UART0 {
            return self.uart.stored(at & 0xFFF);
        }
        let stored = self.registers.get(&at).copied();
        stored.unwrap_or_else(|| reset_value(at))
    }

    fn is_in_reset(&self, at: u32) -> bool {
        let mut blocks = RESETTABLE.iter();
        blocks.any(|(block, bit)| *block == at & BLOCK && self.word(RESETS) >> bit & 1 != 0)
    }

    /// What is read: of some registers, not what was written.
    pub(super) fn read(&mut self, at: u32) -> u32 {
        if self.is_in_reset(at) {
            self.lost.push(at);
        }
        let at = at & !0x3000;
        if at & BLOCK == UART0 {
            self.uart.advance(self.cycles);
            return self.uart.read(at & 0xFFF);
        }
        let word = self.word(at);
        match (at & BLOCK, at & 0xFFF) {
            // STATUS: STABLE, ENABLED.
            (XOSC, 4) if self.word(XOSC) >> 12 == 0xFAB => 1 << 31 | 1 << 12,
            // CS: LOCK, with neither VCOPD nor PD in PWR.
            (pll @ (PLL_SYS | PLL_USB), 0) if self.word(pll + 4) & 0x21 == 0 => word | 1 << 31,
            // CLK_REF_SELECTED, CLK_SYS_SELECTED: a bit for SRC in CTRL.
            (CLOCKS, 0x38) => 1 << (self.word(CLOCKS + 0x30) & 3),
            (CLOCKS, 0x44) => 1 << (self.word(CLOCKS + 0x3C) & 1),
            // RESET_DONE.
            (RESETS, 8) => !self.word(RESETS) & ALL_RESET,
            // TIMERAWL.
            (TIMER0, 0x28) => (self.cycles / CYCLES) as u32,
            _ => word,
        }
    }

    /// A word is written to a register, or to one of the places that change bits of it.
    pub(super) fn write(&mut self, at: u32, value: u32) {
        if self.is_in_reset(at) {
            self.lost.push(at);
            return;
        }
        let register = at & !0x3000;
        let stored = self.word(register);
        let word = match at >> 12 & 3 {
            0 => value,
            1 => stored ^ value,
            2 => stored | value,
            _ => stored & !value,
        };
        let word = match register {
            XOSC => crystal(stored, word),
            // It is cleared by ones.
            INTR => stored & !word,
            _ => word,
        };
        self.written.push((self.cycles, register, word));
        if at & BLOCK == UART0 {
            self.uart.advance(self.cycles);
            return self.uart.write(register & 0xFFF, word, self.cycles);
        }
        let was_line_in_reset = self.is_in_reset(UART0);
        self.registers.insert(register, word);
        if register == RESETS {
            if was_line_in_reset || self.is_in_reset(UART0) {
                self.reset_line();
            }
            let registers = std::mem::take(&mut self.registers);
            let others = registers.into_iter();
            self.registers = BTreeMap::from([(RESETS, word)]);
            let powered: Vec<_> = others.filter(|(at, _)| !self.is_in_reset(*at)).collect();
            self.registers.extend(powered);
        }
        if register == ALARM0 {
            self.registers.insert(ARMED, 1);
        }
    }

    fn reset_line(&mut self) {
        self.uart.reset();
        for offset in [UARTCR, UARTIFLS] {
            self.uart
                .write(offset, reset_value(UART0 + offset), self.cycles);
        }
    }

    /// Bytes come over the serial line from now on.
    pub(super) fn bring(&mut self, bytes: &[u8]) {
        self.uart.bring(bytes, self.cycles);
    }

    /// Number of bytes in transit.
    pub(super) fn coming(&self) -> usize {
        self.uart.coming()
    }

    /// What has left over the serial line since the last call.
    pub(super) fn gone(&mut self) -> Vec<u8> {
        self.uart.advance(self.cycles);
        self.uart.gone()
    }

    /// The serial line asks for its interrupt.
    pub(super) fn line_interrupts(&mut self) -> bool {
        if self.uart.due() <= self.cycles {
            self.uart.advance(self.cycles);
        }
        self.uart.interrupts()
    }

    /// When something happens by itself (cycles).
    pub(super) fn next(&self) -> u64 {
        self.due().unwrap_or(u64::MAX).min(self.uart.due())
    }

    /// When the first alarm fires, if it is armed (cycles).
    pub(super) fn due(&self) -> Option<u64> {
        (self.word(ARMED) & 1 != 0).then_some(u64::from(self.word(ALARM0)) * CYCLES)
    }

    /// The first alarm fires; the result is whether it interrupts.
    pub(super) fn fire(&mut self) -> bool {
        self.registers.insert(ARMED, 0);
        self.registers.insert(INTR, 1);
        self.word(INTE) & 1 != 0
    }
}
