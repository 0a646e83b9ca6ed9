//! The watchdog of the chip (RP2040 datasheet, section 4.7): it resets the chip unless it is reloaded in time.

/// Its registers, by offset; the crate implements the others.
const CONTROL: u32 = 0x00;
const LOAD: u32 = 0x04;
const REASON: u32 = 0x08;

const ENABLED: u32 = 1 << 30;
const TRIGGER: u32 = 1 << 31;

/// Whether it runs, and until when.
#[derive(Debug, Default)]
pub(crate) struct Watchdog {
    control: u32,
    /// When it resets the chip (cycles), if it is enabled.
    ends: u64,
    reason: u32,
}

impl Watchdog {
    /// Whether a register is implemented here.
    pub(crate) const fn has(offset: u32) -> bool {
        offset <= REASON
    }

    /// When it resets the chip (cycles).
    pub(crate) const fn due(&self) -> u64 {
        if self.control & TRIGGER != 0 {
            0
        } else if self.control & ENABLED != 0 {
            self.ends
        } else {
            u64::MAX
        }
    }

    /// Records that it has reset the chip.
    pub(crate) fn reset(&mut self) {
        let forced = self.control & TRIGGER != 0;
        *self = Self {
            reason: if forced { 2 } else { 1 },
            ..Self::default()
        };
    }

    pub(crate) const fn read(&self, offset: u32) -> u32 {
        match offset {
            CONTROL => self.control,
            REASON => self.reason,
            _ => 0,
        }
    }

    /// Writes a register, at a time (cycles), with `per_us` cycles per µs.
    pub(crate) fn write(&mut self, offset: u32, value: u32, (now, per_us): (u64, u64)) {
        match offset {
            CONTROL => self.control = value,
            // It counts down twice per µs: erratum RP2040-E1.
            LOAD => self.ends = now + u64::from(value & 0xFF_FFFF) * per_us / 2,
            _ => {}
        }
    }
}
