//! When usable samples have stayed away for too long, by the device's clock.

/// The time of a device wraps after 71 minutes; differences beyond half of that are of the past.
const HALF: u32 = 1 << 31;

/// How long ago the last usable sample came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Silence {
    longest_us: u32,
    /// When the last usable sample came.
    heard_us: u32,
    silent: bool,
    /// Times that samples stayed away for too long.
    pub count: u32,
}

impl Silence {
    /// Nothing has come yet: silent. A sample may be so old (µs).
    pub fn new(longest_us: u32) -> Self {
        Self {
            longest_us,
            heard_us: 0,
            silent: true,
            count: 0,
        }
    }

    /// A sample may be so old (µs) from now on.
    pub fn set_longest(&mut self, longest_us: u32) {
        self.longest_us = longest_us;
    }

    /// A usable sample came at a time (µs, wrapping) of the device.
    pub fn hear(&mut self, received_us: u32) {
        self.heard_us = received_us;
        self.silent = false;
    }

    /// The last usable sample is older than allowed, or will be before `ahead_us` have passed; or there is none. Asked in every
    /// tick: silence once noticed stays until something is heard, however often the clock wraps.
    pub fn is_silent(&mut self, now_us: u32, ahead_us: u32) -> bool {
        let age = now_us.wrapping_sub(self.heard_us);
        // A time stamp of the future is of now.
        let age = if age < HALF { age } else { 0 };
        if !self.silent && age.saturating_add(ahead_us) > self.longest_us {
            self.silent = true;
            self.count = self.count.saturating_add(1);
        }
        self.silent
    }
}
