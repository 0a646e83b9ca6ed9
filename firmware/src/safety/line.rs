//! Which samples of the hand are new: by the sender's count and by the device's clock.

use super::ticks::latest;

/// The time of a device wraps after 71 minutes; differences beyond half of that are of the past.
const HALF: u32 = 1 << 31;

/// What a sample is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Arrival {
    /// Newer than all before it.
    New,
    /// As old as one that came before, or older: not to be used.
    Late,
}

/// The samples' way in: counts those that are late and lost, and tells when there is silence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line {
    silence_us: u32,
    period_us: u32,
    last: Option<u16>,
    /// A sample that would be the first of a sender that counts anew.
    candidate: Option<u16>,
    /// When the last usable sample came.
    heard_us: u32,
    silent: bool,
    /// See [`super::Health`].
    pub late: u32,
    /// See [`super::Health`].
    pub lost: u32,
    /// See [`super::Health`].
    pub restarts: u32,
    /// See [`super::Health`].
    pub silences: u32,
}

impl Line {
    /// A line on which nothing has come yet: silent.
    pub fn new(silence_us: u32, period_us: u32) -> Self {
        Self {
            silence_us,
            period_us,
            last: None,
            candidate: None,
            heard_us: 0,
            silent: true,
            late: 0,
            lost: 0,
            restarts: 0,
            silences: 0,
        }
    }

    /// Another silence, another period of ticks (µs).
    pub fn set_times(&mut self, silence_us: u32, period_us: u32) {
        self.silence_us = silence_us;
        self.period_us = period_us;
    }

    /// A sample with the sender's number has come. Of longer numbers the lower 16 bits will do.
    ///
    /// A sender that counts anew is believed in silence only, and with its second sample: one alone could be an old one
    /// that was long under way.
    pub fn arrive(&mut self, number: u16) -> Arrival {
        let ahead = match self.last {
            None => 1,
            Some(last) => number.wrapping_sub(last),
        };
        if is_ahead(ahead) {
            self.lost = self.lost.saturating_add(u32::from(ahead.saturating_sub(1)));
        } else if self.silent && self.follows_candidate(number) {
            self.restarts = self.restarts.saturating_add(1);
        } else {
            self.candidate = self.silent.then_some(number);
            self.late = self.late.saturating_add(1);
            return Arrival::Late;
        }
        self.last = Some(number);
        self.candidate = None;
        Arrival::New
    }

    fn follows_candidate(&self, number: u16) -> bool {
        self.candidate
            .is_some_and(|first| is_ahead(number.wrapping_sub(first)))
    }

    /// A usable sample came at a time (µs, wrapping) of the device.
    pub fn hear(&mut self, received_us: u32) {
        self.heard_us = received_us;
        self.silent = false;
    }

    /// The last usable sample is, or may be before the next tick, older than allowed; or there is none. The next tick may be
    /// late. Asked in every tick: silence once noticed stays until something is heard, however often the clock wraps.
    pub fn is_silent(&mut self, now_us: u32) -> bool {
        let age = now_us.wrapping_sub(self.heard_us);
        // A time stamp of the future is of now.
        let age = if age < HALF { age } else { 0 };
        if !self.silent && age.saturating_add(latest(self.period_us)) > self.silence_us {
            self.silent = true;
            self.silences = self.silences.saturating_add(1);
        }
        self.silent
    }
}

/// A difference of two numbers that is of the future: 1 to 32 767.
fn is_ahead(difference: u16) -> bool {
    (1..0x8000).contains(&difference)
}
