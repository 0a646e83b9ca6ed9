//! Ticks that did not come, counted by the device's clock.

/// Differences beyond this mean that the clock went backwards.
const HALF: u32 = 1 << 31;

/// The permitted lateness of a tick (µs): half a period.
pub(crate) fn lateness(period_us: u32) -> u32 {
    period_us / 2
}

/// The longest time from one tick to the next (µs): if more passes, one is missing.
pub(crate) fn latest(period_us: u32) -> u32 {
    period_us.saturating_add(lateness(period_us))
}

/// Counts ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ticks {
    period_us: u32,
    last_us: Option<u32>,
    /// Ticks done.
    pub done: u32,
    /// Ticks missed.
    pub missed: u32,
}

impl Ticks {
    /// With a period (µs).
    pub fn new(period_us: u32) -> Self {
        Self {
            period_us,
            last_us: None,
            done: 0,
            missed: 0,
        }
    }

    /// Sets a new period (µs), from the last tick on. The counts continue.
    pub fn set_period(&mut self, period_us: u32) {
        self.period_us = period_us;
    }

    /// A tick at a time (µs, wrapping) of the device: returns how many are missing between the previous one and this
    /// one, to the nearest.
    pub fn tick(&mut self, now_us: u32) -> u32 {
        let elapsed = match self.last_us {
            None => 0,
            Some(last) => now_us.wrapping_sub(last),
        };
        self.last_us = Some(now_us);
        self.done = self.done.saturating_add(1);
        // Without a division if nothing is missing.
        if elapsed >= HALF || elapsed < latest(self.period_us) {
            return 0;
        }
        let periods = elapsed
            .saturating_add(lateness(self.period_us))
            .checked_div(self.period_us);
        let missed = periods.unwrap_or(0).saturating_sub(1);
        self.missed = self.missed.saturating_add(missed);
        missed
    }
}
