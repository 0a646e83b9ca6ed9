//! A model of the ROM of the chip, as far as the firmware uses it: functions that erase and program its flash (RP2040 datasheet,
//! 2.8.2.1 and 2.8.3.1). None of the ROM's code is here: where a function begins, the chip does what it does, in the time that the flash
//! may take for it at most (W25Q16JV, 9.6), and returns. What the watchdog interrupts does not happen.

use rp2040_emu::ROM_SIZE;

use super::{Chip, MEGAHERTZ};

/// Bytes of the flash.
pub(super) const FLASH_SIZE: usize = 2 << 20;
/// A byte of an erased flash.
pub(super) const ERASED: u8 = 0xFF;
/// What is erased at a time, and programmed at a time (bytes).
const SECTOR: usize = 4096;
const PAGE: usize = 256;

/// Where the functions begin.
const LOOK_UP: u32 = 0x100;
const CONNECT: u32 = 0x104;
const LEAVE: u32 = 0x108;
const ERASE: u32 = 0x10C;
const PROGRAM: u32 = 0x110;

/// What a function does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Call {
    /// Returns where a function begins.
    Found(u32),
    Connect,
    /// The flash takes commands, and is no longer read as memory.
    Leave,
    /// Bytes from an offset in the flash.
    Erase(usize, usize),
    /// From an offset in the flash, bytes at an address.
    Program(usize, u32, usize),
}

impl Call {
    /// The function that begins at an address, with its arguments.
    fn at(address: u32, [a, b, c]: [u32; 3]) -> Option<Self> {
        Some(match address {
            LOOK_UP => Self::Found(match &b.to_le_bytes()[..2] {
                b"IF" => CONNECT | 1,
                b"EX" => LEAVE | 1,
                b"RE" => ERASE | 1,
                b"RP" => PROGRAM | 1,
                _ => 0,
            }),
            CONNECT => Self::Connect,
            LEAVE => Self::Leave,
            ERASE => Self::Erase(a as usize, b as usize),
            PROGRAM => Self::Program(a as usize, b, c as usize),
            _ => return None,
        })
    }

    /// The time that the flash takes at most (cycles).
    const fn cycles(self) -> u64 {
        const MS: u64 = MEGAHERTZ as u64 * 1_000;
        match self {
            Self::Found(_) | Self::Connect | Self::Leave => 1,
            Self::Erase(_, bytes) => 400 * MS * bytes.div_ceil(SECTOR) as u64,
            Self::Program(.., bytes) => 3 * MS * bytes.div_ceil(PAGE) as u64,
        }
    }

    /// Whether offset and size are those of sectors, or of pages.
    const fn is_aligned(self) -> bool {
        match self {
            Self::Found(_) | Self::Connect | Self::Leave => true,
            Self::Erase(at, bytes) => at % SECTOR == 0 && bytes % SECTOR == 0,
            Self::Program(at, _, bytes) => at % PAGE == 0 && bytes % PAGE == 0,
        }
    }
}

impl Chip {
    /// Executes a function of the ROM at once, and returns from it.
    ///
    /// # Panics
    /// There is no such function, or it is called in a way in which the chip's would not do what is expected.
    pub(super) fn call_rom(&mut self, at: u32) -> u64 {
        let arguments = [0, 1, 2].map(|number| self.register(number));
        let call = Call::at(at, arguments);
        let call = call.unwrap_or_else(|| panic!("{at:#x} is no function of the ROM: {self:?}"));
        assert!(call.is_aligned(), "{call:?}");
        let cycles = call.cycles();
        if self.own.watchdog.due() <= self.own.now + cycles {
            self.pass(self.own.watchdog.due().saturating_sub(self.own.now));
            self.settle();
            return cycles;
        }
        match call {
            Call::Found(function) => self.set_register(0, function),
            Call::Connect => {}
            Call::Leave => self.own.flash_is_away = true,
            Call::Erase(from, bytes) => {
                assert!(self.own.flash_is_away, "{call:?} of a flash that is read");
                self.flash[from..from + bytes].fill(ERASED);
                self.written();
            }
            Call::Program(to, from, bytes) => {
                assert!(self.own.flash_is_away, "{call:?} of a flash that is read");
                // Programming clears bits, and sets none.
                let page = self.bytes(from, bytes as u32);
                for (place, byte) in self.flash[to..].iter_mut().zip(page) {
                    *place &= byte;
                }
                self.written();
            }
        }
        let back = self.register(14) & !1;
        self.core_mut().regs.set_pc(back);
        self.pass(cycles);
        self.settle();
        cycles
    }

    fn written(&mut self) {
        self.emulator.load_flash(&self.flash);
        self.writes += 1;
    }
}

/// The contents: a signature and its version, and where the functions are looked up.
pub(super) fn contents() -> [u8; ROM_SIZE] {
    let mut rom = [0; ROM_SIZE];
    rom[0x10..0x14].copy_from_slice(b"Mu\x01\x03");
    let table = 0x20_u16;
    rom[0x14..0x16].copy_from_slice(&table.to_le_bytes());
    rom[0x18..0x1A].copy_from_slice(&(LOOK_UP as u16 | 1).to_le_bytes());
    rom
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_found_by_their_codes() {
        let found = |code: &[u8; 2]| {
            let code = u32::from(u16::from_le_bytes(*code));
            match Call::at(LOOK_UP, [0x20, code, 0]) {
                Some(Call::Found(function)) => Call::at(function & !1, [4096, 8192, 256]),
                other => other,
            }
        };
        assert_eq!(found(b"IF"), Some(Call::Connect));
        assert_eq!(found(b"EX"), Some(Call::Leave));
        assert_eq!(found(b"RE"), Some(Call::Erase(4096, 8192)));
        assert_eq!(found(b"RP"), Some(Call::Program(4096, 8192, 256)));
        assert_eq!(found(b"XX"), None);
    }

    #[test]
    fn a_flash_takes_its_time() {
        assert_eq!(Call::Erase(0, 8192).cycles(), 100_000_000);
        assert_eq!(Call::Program(0, 0, 256).cycles(), 375_000);
        assert!(!Call::Erase(256, 4096).is_aligned() && !Call::Program(0, 0, 34).is_aligned());
    }
}
