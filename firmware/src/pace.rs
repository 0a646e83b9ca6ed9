//! When ticks are due: whole numbers of periods apart, whatever the duration of a tick. For a board that ticks in its main loop.

use core::num::NonZero;

/// The pace of ticks, by a clock in µs that may wrap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pace {
    period_us: NonZero<u32>,
    /// When the last tick was due.
    last_us: u32,
}

impl Pace {
    /// At a rate (Hz; 0 counts as 1), with the first tick a period after now.
    pub fn new(rate: u16, now_us: u32) -> Self {
        Self {
            period_us: period(rate),
            last_us: now_us,
        }
    }

    /// Sets the ticks per second, from the last tick on.
    pub fn set_rate(&mut self, rate: u16) {
        self.period_us = period(rate);
    }

    /// Returns whether a tick is due. It must be called more often than ticks come; returns true once for each of them. Of those that are
    /// due together, all but the last are missed.
    pub fn is_due(&mut self, now_us: u32) -> bool {
        let passed = now_us.wrapping_sub(self.last_us);
        if passed < self.period_us.get() {
            return false;
        }
        self.last_us = now_us.wrapping_sub(passed % self.period_us);
        true
    }
}

fn period(rate: u16) -> NonZero<u32> {
    let rate = NonZero::new(u32::from(rate)).unwrap_or(NonZero::<u32>::MIN);
    NonZero::new(1_000_000 / rate).unwrap_or(NonZero::<u32>::MIN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_keep_their_grid_across_the_wrap_of_the_clock() {
        let begun = u32::MAX - 2_500;
        let mut pace = Pace::new(1_000, begun);
        let due: [u32; 5] = {
            let mut passed = (0..6_000).filter(|&us| pace.is_due(begun.wrapping_add(us)));
            core::array::from_fn(|_| passed.next().unwrap())
        };
        assert_eq!(due, [1_000, 2_000, 3_000, 4_000, 5_000]);
    }

    #[test]
    fn a_long_tick_misses_those_within_it_and_the_next_one_is_on_the_grid() {
        let mut pace = Pace::new(1_000, 0);
        assert!(pace.is_due(1_000) && !pace.is_due(1_999));
        assert!(pace.is_due(4_300) && !pace.is_due(4_999) && pace.is_due(5_000));
    }

    #[test]
    fn another_rate_counts_from_the_last_tick() {
        let mut pace = Pace::new(1_000, 0);
        assert!(pace.is_due(1_010));
        pace.set_rate(100);
        assert!(!pace.is_due(10_999) && pace.is_due(11_000));
        pace.set_rate(0);
        assert!(!pace.is_due(1_010_999) && pace.is_due(1_011_000));
    }
}
