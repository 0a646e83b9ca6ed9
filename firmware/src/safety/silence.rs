//! Detects that usable samples have stayed away for too long, by the device's clock.

/// The time of a device wraps after 71 minutes; differences beyond half of that lie in the past.
const HALF: u32 = 1 << 31;

/// How long ago the last usable sample arrived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Silence {
    longest_us: u32,
    /// When the last usable sample arrived.
    last_us: u32,
    silent: bool,
    /// Times that samples stayed away for too long.
    pub count: u32,
}

impl Silence {
    /// Nothing has arrived yet: silent. `longest_us`: the permitted age of a sample (µs).
    pub fn new(longest_us: u32) -> Self {
        Self {
            longest_us,
            last_us: 0,
            silent: true,
            count: 0,
        }
    }

    /// Sets the permitted age of a sample (µs) from now on.
    pub fn set_longest(&mut self, longest_us: u32) {
        self.longest_us = longest_us;
    }

    /// A usable sample arrived at a time (µs, wrapping) of the device.
    pub fn restart(&mut self, received_us: u32) {
        self.last_us = received_us;
        self.silent = false;
    }

    /// Returns whether the last usable sample is older than permitted, or will be before `ahead_us` have passed; or whether there is none.
    /// Called in every tick: silence once noticed stays until a sample arrives, however often the clock wraps.
    pub fn is_silent(&mut self, now_us: u32, ahead_us: u32) -> bool {
        let age = now_us.wrapping_sub(self.last_us);
        // A time stamp in the future counts as now.
        let age = if age < HALF { age } else { 0 };
        if !self.silent && age.saturating_add(ahead_us) > self.longest_us {
            self.silent = true;
            self.count = self.count.saturating_add(1);
        }
        self.silent
    }
}
