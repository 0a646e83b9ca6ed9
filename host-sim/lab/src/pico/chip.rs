//! The chip: one core of the RP2040, its memory and its peripherals, one instruction after another.

mod rom;

use rp2040_emu::core::CortexM0Plus;
use rp2040_emu::{Config, Emulator, ROM_SIZE};

use super::bus::{Fabric, Own, TIMER};
use super::cache::MISS;
use super::handlers::{FIRST_INTERRUPT, Handlers};
use rom::{ERASED, FLASH_SIZE};

/// The start of the flash.
pub const FLASH: u32 = 0x1000_0000;
/// The start of the RAM.
const RAM: u32 = 0x2000_0000;
/// The clock of the chip (MHz).
pub const MEGAHERTZ: u32 = 125;
/// The vector table follows the second boot stage.
pub const VECTORS: u32 = 0x100;

/// Timer register: the alarms, 0 to 3, that request their interrupts.
const ALARMS: u32 = TIMER + 0x40;
/// The interrupt of the serial line.
const UART0_INTERRUPT: u8 = 20;

/// The chip. Its clock counts cycles from power-up, and continues when the chip is reset.
pub struct Chip {
    emulator: Emulator,
    flash: Vec<u8>,
    /// How often the flash was erased or programmed.
    writes: u32,
    own: Own,
    /// The next time at which a peripheral does something on its own (cycles).
    next: u64,
    /// When the chip was last reset (cycles).
    reset_at: u64,
    resets: u32,
    /// The levels of its pins, set by the connected devices.
    levels: u32,
    handlers: Handlers,
}

impl std::fmt::Debug for Chip {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Own { uart, watchdog, .. } = &self.own;
        f.debug_struct("Chip")
            .field("cycles", &self.own.now)
            .field("at", &self.at())
            .field("uart", uart)
            .field("watchdog", watchdog)
            .finish_non_exhaustive()
    }
}

impl Chip {
    /// A chip after power-up, with the contents of its flash, which starts at [`FLASH`].
    pub fn new(mut flash: Vec<u8>) -> Self {
        flash.resize(FLASH_SIZE, ERASED);
        let mut emulator = Emulator::new(Config::default());
        emulator.load_bootrom(&rom::contents());
        emulator.load_flash(&flash);
        let mut chip = Self {
            emulator,
            flash,
            writes: 0,
            own: Own::default(),
            next: 0,
            reset_at: 0,
            resets: 0,
            levels: 0,
            handlers: Handlers::new(),
        };
        chip.boot();
        chip
    }

    fn boot(&mut self) {
        self.emulator.reset();
        self.emulator.bus.gpio_in = self.levels;
        self.emulator.direct_boot_from_flash(VECTORS);
        self.own.flash_is_away = false;
        self.reset_at = self.own.now;
        self.settle();
    }

    /// Cycles since power-up.
    pub const fn cycles(&self) -> u64 {
        self.own.now
    }

    /// How often the watchdog has reset it.
    pub const fn resets(&self) -> u32 {
        self.resets
    }

    /// The contents of its flash: what remains without power.
    pub fn flash(&self) -> &[u8] {
        &self.flash
    }

    /// How often its flash has been erased or programmed.
    pub const fn flash_writes(&self) -> u32 {
        self.writes
    }

    /// The cycles since power-up for which the core would have waited for its flash, at the least; they are not in [`Self::cycles`].
    pub const fn waits(&self) -> u64 {
        MISS * self.own.cache.misses()
    }

    /// The longest time since power-up that the handler of an interrupt took, including all that interrupted it (cycles).
    pub const fn longest(&self, interrupt: u32) -> u64 {
        self.handlers.longest(interrupt)
    }

    /// Bytes that arrive over the serial line from now on.
    pub fn bring(&mut self, bytes: &[u8]) {
        self.own.uart.bring(bytes, self.own.now);
        self.settle();
    }

    /// The number of bytes in transit to it.
    pub fn coming(&self) -> usize {
        self.own.uart.coming()
    }

    /// The bytes that it has sent over the serial line since the last call.
    pub fn gone(&mut self) -> Vec<u8> {
        self.own.uart.gone()
    }

    /// From now on, connected devices set the pins in a mask to these levels, bit by bit.
    pub const fn set_pins(&mut self, mask: u32, levels: u32) {
        self.levels = self.levels & !mask | levels & mask;
        self.emulator.bus.gpio_in = self.levels;
    }

    /// A word of memory, or of a register that can be read without a side effect.
    pub fn word(&mut self, at: u32) -> u32 {
        self.emulator.bus.read32(at & !3)
    }

    /// A range of memory.
    pub fn bytes(&self, from: u32, length: u32) -> Vec<u8> {
        let byte = |at: u32| self.emulator.peek(at & !3).to_le_bytes()[(at & 3) as usize];
        (from..from + length).map(byte).collect()
    }

    /// Writes to its RAM.
    pub fn load(&mut self, to: u32, bytes: &[u8]) {
        self.emulator.load_image(to, bytes);
    }

    fn core(&self) -> &CortexM0Plus {
        &self.emulator.cores[0]
    }

    fn core_mut(&mut self) -> &mut CortexM0Plus {
        &mut self.emulator.cores[0]
    }

    /// A register of its core, 0 to 15.
    pub fn register(&self, number: usize) -> u32 {
        self.core().reg(number)
    }

    /// Changes a register of its core, 0 to 15.
    pub fn set_register(&mut self, number: usize, value: u32) {
        self.core_mut().set_reg(number, value);
    }

    /// The address of the next instruction.
    pub fn at(&self) -> u32 {
        self.core().regs.pc()
    }

    /// Continues at this address; the core no longer sleeps.
    pub fn go_on_at(&mut self, at: u32) {
        let core = self.core_mut();
        core.wake();
        core.regs.set_pc(at);
    }

    /// Whether it is in the hard fault handler.
    pub fn is_in_hard_fault(&self) -> bool {
        self.core().is_in_hardfault()
    }

    /// The instruction at an address of the flash or the RAM, or the first half of a long one.
    pub fn instruction(&self, at: u32) -> Option<u16> {
        if at >> 28 == RAM >> 28 {
            let word = self.emulator.peek(at & !3);
            return Some((word >> (at % 4 * 8)) as u16);
        }
        let offset = at.wrapping_sub(FLASH) as usize;
        let bytes = self.flash.get(offset..)?.first_chunk()?;
        Some(u16::from_le_bytes(*bytes))
    }

    /// Whether it is locked up by a second fault, and does nothing more on its own.
    pub fn is_locked_up(&self) -> bool {
        let core = self.core();
        core.is_halted() && core.is_in_hardfault()
    }

    /// Runs for this many cycles, or up to one instruction longer.
    pub fn run(&mut self, cycles: u64) {
        let end = self.own.now + cycles;
        while self.own.now < end {
            if self.core().is_halted() {
                self.sleep(end);
            } else {
                self.step();
            }
        }
    }

    /// Sleeps until an interrupt occurs, or up to a time (cycles).
    fn sleep(&mut self, end: u64) {
        if self.emulator.bus.nvics[0].pending_and_enabled() != 0 && !self.is_locked_up() {
            self.core_mut().wake();
        } else {
            let cycles = self.next.min(end).saturating_sub(self.own.now);
            self.pass(cycles);
            self.settle();
        }
    }

    /// Executes one instruction, or the entry of an exception. Returns the cycles that it took.
    pub fn step(&mut self) -> u64 {
        let at = self.at();
        if (at as usize) < ROM_SIZE {
            return self.call_rom(at);
        }
        let active = self.emulator.bus.ppb[0].active;
        // The crate's core does not let an interrupt preempt another one.
        let hides = active != 0 && self.is_preempted(active);
        let Emulator { cores, bus, .. } = &mut self.emulator;
        if hides {
            bus.ppb[0].active = 0;
        }
        let own = &mut self.own;
        own.read_flash(at);
        let mut cycles = u64::from(cores[0].step(&mut Fabric { bus, own }));
        if hides {
            bus.ppb[0].active |= active;
        }
        if !bus.pending_cache_invalidations.is_empty() {
            cores[0].invalidate_decode_cache_entries(&bus.pending_cache_invalidations);
            bus.pending_cache_invalidations.clear();
        }
        if bus.pending_invalidation_regions != 0 {
            cores[0].invalidate_decode_cache_regions(bus.pending_invalidation_regions);
            bus.pending_invalidation_regions = 0;
        }
        // Only branches lead to another address than the next one; the entry of an exception takes 15 cycles, one less as well.
        let is_active = bus.ppb[0].active;
        let after = cores[0].regs.pc();
        let length = self.instruction(at).map_or(2, length);
        cycles -= u64::from(after != at + length && cycles > 1);
        if is_active != active {
            (self.handlers).pass([active, is_active], self.own.now, cycles);
        }
        self.pass(cycles);
        if self.own.is_touched || is_active != active || self.own.now >= self.next {
            self.settle();
        }
        cycles
    }

    /// Whether a pending interrupt has a higher priority than all active ones.
    fn is_preempted(&self, active: u64) -> bool {
        let nvic = &self.emulator.bus.nvics[0];
        if nvic.pending_and_enabled() == 0 {
            return false;
        }
        let priority = |exception: u32| match exception.checked_sub(FIRST_INTERRUPT) {
            Some(irq) => i16::from(nvic.get_priority(irq as u8)),
            None => self.emulator.bus.ppb[0].exception_priority(exception as u16),
        };
        let exceptions = (0..u64::BITS).filter(|exception| active >> exception & 1 != 0);
        let highest = exceptions.map(priority).min();
        let waiting = nvic.highest_priority_pending();
        waiting.is_some_and(|(_, waiting)| highest.is_none_or(|active| i16::from(waiting) < active))
    }

    fn pass(&mut self, cycles: u64) {
        self.own.now += cycles;
        self.emulator.bus.advance_lazy_scheduled(cycles);
        for pio in &mut self.emulator.bus.pio {
            if pio.any_sm_enabled() {
                pio.step_n(cycles as u32, self.levels);
            }
        }
    }

    /// Processes all events around the core up to now, and schedules the
    /// next one. A requested interrupt becomes pending, unless it is active.
    fn settle(&mut self) {
        let Own {
            uart,
            watchdog,
            now,
            is_touched,
            ..
        } = &mut self.own;
        *is_touched = false;
        uart.advance(*now);
        if watchdog.due() <= *now {
            self.resets += 1;
            watchdog.reset();
            uart.reset();
            return self.boot();
        }
        let bus = &mut self.emulator.bus;
        let alarms = bus.read32(ALARMS);
        let asked = alarms & 0xF | u32::from(uart.interrupts()) << UART0_INTERRUPT;
        let waiting = asked & !((bus.ppb[0].active >> FIRST_INTERRUPT) as u32);
        for irq in (0..u32::BITS as u8).filter(|irq| waiting >> irq & 1 != 0) {
            bus.nvics[0].set_pending(irq);
        }
        let alarm = bus.next_scheduled_lazy_deadline();
        let alarm = alarm.map_or(u64::MAX, |at| self.reset_at + at);
        self.next = uart.due().min(watchdog.due()).min(alarm);
    }
}

/// The length of an instruction, from its first half (bytes).
pub const fn length(instruction: u16) -> u32 {
    if instruction >> 11 > 0b11100 { 4 } else { 2 }
}
