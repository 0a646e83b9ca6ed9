//! What the core of the RP2350 reads and writes: flash, RAM, peripherals, and of its ROM where the program looks for functions. There is no
//! other core, no pin and no waiting.

use std::sync::Arc;

use rp2350_emu::core::CoreBus;
use rp2350_emu::threaded::CoreAtomics;

use super::peripherals::Peripherals;
use super::{FLASH, LOOKUP, RAM, RAM_SIZE};

/// Words of the ROM: the version 2 behind its mark; in the upper half, where the function begins that looks up functions (RP2350 datasheet,
/// 5.4).
const VERSION_AT: u32 = 0x10;
const VERSION: u32 = u32::from_le_bytes(*b"Mu\x02\x02");
const LOOKUP_AT: u32 = 0x14;

/// What the core reads and writes.
pub(super) struct Fabric {
    atomics: Arc<CoreAtomics>,
    flash: Vec<u8>,
    pub(super) ram: Vec<u8>,
    pub(super) peripherals: Peripherals,
    /// Bytes written to the core's own peripherals, where the crate takes words only.
    pub(super) core_bytes: Vec<(u32, u8)>,
    last_fetch: u32,
}

impl Fabric {
    pub(super) fn new(flash: Vec<u8>, atomics: Arc<CoreAtomics>) -> Self {
        Self {
            atomics,
            flash,
            ram: vec![0; RAM_SIZE],
            peripherals: Peripherals::default(),
            core_bytes: Vec::new(),
            last_fetch: 0,
        }
    }

    fn memory(&mut self, at: u32) -> Option<&mut [u8]> {
        let (memory, start) = match at >> 28 {
            1 => (&mut self.flash, FLASH),
            2 => (&mut self.ram, RAM),
            _ => return None,
        };
        memory.get_mut((at - start) as usize..)
    }

    fn read<const N: usize>(&mut self, at: u32) -> [u8; N] {
        if let Some(bytes) = self.memory(at).and_then(|memory| memory.first_chunk()) {
            return *bytes;
        }
        let word = match at & !3 {
            VERSION_AT => VERSION,
            LOOKUP_AT => (LOOKUP | 1) << 16,
            aligned => self.peripherals.read(aligned),
        };
        let bytes = word.to_le_bytes();
        std::array::from_fn(|byte| bytes[(at as usize + byte) % 4])
    }

    pub(super) fn write<const N: usize>(&mut self, at: u32, value: [u8; N]) {
        if let Some(bytes) = self.memory(at).and_then(|memory| memory.first_chunk_mut()) {
            *bytes = value;
            return;
        }
        // A peripheral gets a byte in all four places of its word (2.1.5).
        let word = std::array::from_fn(|byte| value[byte % N]);
        self.peripherals.write(at & !3, u32::from_le_bytes(word));
    }
}

impl CoreBus for Fabric {
    fn read8(&mut self, at: u32, _: u8) -> u8 {
        self.read::<1>(at)[0]
    }

    fn read16(&mut self, at: u32, _: u8) -> u16 {
        u16::from_le_bytes(self.read(at))
    }

    fn read32(&mut self, at: u32, _: u8) -> u32 {
        u32::from_le_bytes(self.read(at))
    }

    fn write8(&mut self, at: u32, value: u8, _: u8) {
        self.write(at, [value]);
    }

    fn write16(&mut self, at: u32, value: u16, _: u8) {
        self.write(at, value.to_le_bytes());
    }

    fn write32(&mut self, at: u32, value: u32, _: u8) {
        self.write(at, value.to_le_bytes());
    }

    fn atomics(&self) -> &Arc<CoreAtomics> {
        &self.atomics
    }

    fn last_fetch_addr(&self) -> u32 {
        self.last_fetch
    }

    fn set_last_fetch_addr(&mut self, at: u32) {
        self.last_fetch = at;
    }

    fn mmio_trace_enabled(&self) -> bool {
        true
    }

    fn emit_mmio_trace(&mut self, direction: char, size: u32, at: u32, value: u32, _: u8) {
        if direction == 'W' && size == 1 {
            self.core_bytes.push((at, value as u8));
        }
    }

    fn bus_fault(&self, _: u8) -> bool {
        false
    }

    fn bus_fault_addr(&self, _: u8) -> u32 {
        0
    }

    fn gpio_read_out(&self) -> u32 {
        0
    }

    fn gpio_read_oe(&self) -> u32 {
        0
    }

    fn gpio_read_in(&self) -> u32 {
        0
    }

    fn extra_wait_states(&self) -> u32 {
        0
    }

    fn take_extra_wait_states(&mut self) -> u32 {
        0
    }

    fn set_active_pc(&mut self, _: u32, _: u8) {}
    fn clear_bus_fault(&mut self, _: u8) {}
    fn set_burst_mode(&mut self, _: bool) {}
    fn add_extra_wait_states(&mut self, _: u32) {}
    fn reset_extra_wait_states(&mut self) {}
    fn gpio_write_out(&mut self, _: u32) {}
    fn gpio_set_out(&mut self, _: u32) {}
    fn gpio_clear_out(&mut self, _: u32) {}
    fn gpio_xor_out(&mut self, _: u32) {}
    fn gpio_write_oe(&mut self, _: u32) {}
    fn gpio_set_oe(&mut self, _: u32) {}
    fn gpio_clear_oe(&mut self, _: u32) {}
    fn gpio_xor_oe(&mut self, _: u32) {}
}
