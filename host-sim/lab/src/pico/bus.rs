//! The bus of the core: the memory and the peripherals of the crate, and the peripherals that the crate lacks.

use rp2040_emu::Bus;
use rp2040_emu::bus::ppb::Ppb;
use rp2040_emu::core::{CoreBus, Nvic};

use super::cache::Cache;
use super::chip::{FLASH, MEGAHERTZ};
use super::uart::Uart;
use super::watchdog::Watchdog;

/// Peripherals of 16 KB each; their upper 12 KB set and clear bits of the registers in the lower 4.
const UART0: u32 = 0x4003_4000;
pub(crate) const TIMER: u32 = 0x4005_4000;
const WATCHDOG: u32 = 0x4005_8000;
const PERIPHERAL: u32 = !0x3FFF;
/// The controller of the flash (RP2040 datasheet, 4.10.13), and its register that enables it.
const SSI: u32 = 0x1800_0000;
const SSI_ENABLE: u32 = SSI + 8;
/// The first address that is no longer one of the flash.
const FLASH_END: u32 = 0x1400_0000;
/// The peripherals that the crate lacks.
#[derive(Debug, Default)]
pub(crate) struct Own {
    pub(crate) uart: Uart,
    pub(crate) watchdog: Watchdog,
    pub(crate) cache: Cache,
    pub(crate) now: u64,
    /// The flash takes commands, and cannot be read as memory.
    pub(crate) flash_is_away: bool,
    /// A peripheral that acts on its own was read or written.
    pub(crate) is_touched: bool,
}

impl Own {
    /// Code or data is read from an address, which may be one of the flash.
    ///
    /// # Panics
    /// The flash cannot be read: the chip would go on with garbage.
    #[inline]
    pub(crate) fn read_flash(&mut self, at: u32) {
        let is_flash = (FLASH..FLASH_END).contains(&at);
        assert!(
            !(is_flash && self.flash_is_away),
            "{at:#x} is read from the flash while that takes commands"
        );
        self.cache.read(at);
    }
}

/// A register of the controller of the flash that the crate does not answer as the chip does: everything is sent, a byte has arrived.
const fn ssi(offset: u32) -> Option<u32> {
    match offset {
        0x28 => Some(0b1100),
        0x60 => Some(0),
        _ => None,
    }
}

/// The address space that the core reads and writes.
pub(crate) struct Fabric<'a> {
    pub(crate) bus: &'a mut Bus,
    pub(crate) own: &'a mut Own,
}

impl Fabric<'_> {
    /// The word at an address of a peripheral that the crate lacks.
    #[inline]
    fn own_read(&mut self, at: u32) -> Option<u32> {
        if at >> 28 != 4 {
            if at & !0xFFF == SSI {
                return ssi(at & 0xFFF);
            }
            self.own.read_flash(at);
            return None;
        }
        let offset = at & 0xFFC;
        match at & PERIPHERAL {
            TIMER => self.own.is_touched = true,
            UART0 => {
                self.own.is_touched = true;
                self.own.uart.advance(self.own.now);
                return Some(self.own.uart.read(offset));
            }
            WATCHDOG if Watchdog::has(offset) => return Some(self.own.watchdog.read(offset)),
            _ => {}
        }
        None
    }

    /// Writes such a word; returns whether the address belongs to such a peripheral.
    #[inline]
    fn own_write(&mut self, at: u32, value: u32) -> bool {
        if at >> 28 != 4 {
            // Its controller is set up to read it.
            self.own.flash_is_away &= (at, value) != (SSI_ENABLE, 1);
            return false;
        }
        let (offset, own) = (at & 0xFFC, &mut *self.own);
        let changed = |stored: u32| match at >> 12 & 3 {
            0 => value,
            1 => stored ^ value,
            2 => stored | value,
            _ => stored & !value,
        };
        match at & PERIPHERAL {
            TIMER => own.is_touched = true,
            UART0 => {
                own.is_touched = true;
                own.uart.advance(own.now);
                let value = changed(own.uart.stored(offset));
                own.uart.write(offset, value, own.now);
                return true;
            }
            WATCHDOG if Watchdog::has(offset) => {
                own.is_touched = true;
                let value = changed(own.watchdog.read(offset));
                let clock = (own.now, u64::from(MEGAHERTZ));
                own.watchdog.write(offset, value, clock);
                return true;
            }
            _ => {}
        }
        false
    }
}

/// The byte or half word at an address, in the low bits of its word.
const fn part(word: u32, at: u32) -> u32 {
    word >> (at % 4 * 8)
}

impl CoreBus for Fabric<'_> {
    #[inline]
    fn read8(&mut self, at: u32) -> u8 {
        match self.own_read(at) {
            Some(word) => part(word, at) as u8,
            None => self.bus.read8(at),
        }
    }

    #[inline]
    fn read16(&mut self, at: u32) -> u16 {
        match self.own_read(at) {
            Some(word) => part(word, at) as u16,
            None => self.bus.read16(at),
        }
    }

    #[inline]
    fn read32(&mut self, at: u32) -> u32 {
        match self.own_read(at) {
            Some(word) => word,
            None => self.bus.read32(at),
        }
    }

    #[inline]
    fn write8(&mut self, at: u32, value: u8) {
        // A peripheral sees a byte in all four positions of its word.
        if !self.own_write(at, u32::from(value) * 0x0101_0101) {
            self.bus.write8(at, value);
        }
    }

    #[inline]
    fn write16(&mut self, at: u32, value: u16) {
        if !self.own_write(at, u32::from(value) * 0x0001_0001) {
            self.bus.write16(at, value);
        }
    }

    #[inline]
    fn write32(&mut self, at: u32, value: u32) {
        if !self.own_write(at, value) {
            self.bus.write32(at, value);
        }
    }

    #[inline]
    fn set_active_pc(&mut self, at: u32) {
        self.bus.set_active_pc(at);
    }

    #[inline]
    fn bus_fault(&self) -> bool {
        self.bus.bus_fault()
    }

    fn bus_fault_addr(&self) -> u32 {
        self.bus.bus_fault_addr()
    }

    fn clear_bus_fault(&mut self) {
        self.bus.clear_bus_fault();
    }

    #[inline]
    fn ppb(&self, core: usize) -> &Ppb {
        CoreBus::ppb(self.bus, core)
    }

    #[inline]
    fn ppb_mut(&mut self, core: usize) -> &mut Ppb {
        CoreBus::ppb_mut(self.bus, core)
    }

    #[inline]
    fn nvic(&self, core: usize) -> &Nvic {
        CoreBus::nvic(self.bus, core)
    }

    #[inline]
    fn nvic_mut(&mut self, core: usize) -> &mut Nvic {
        CoreBus::nvic_mut(self.bus, core)
    }

    #[inline]
    fn active_core(&self) -> usize {
        self.bus.active_core()
    }

    fn event_flag(&self, core: usize) -> bool {
        CoreBus::event_flag(self.bus, core)
    }

    fn consume_event_flag(&mut self, core: usize) -> bool {
        CoreBus::consume_event_flag(self.bus, core)
    }

    fn set_wfe_waiting(&mut self, core: usize, is_waiting: bool) {
        CoreBus::set_wfe_waiting(self.bus, core, is_waiting);
    }

    fn signal_sev(&mut self) {
        CoreBus::signal_sev(self.bus);
    }
}
