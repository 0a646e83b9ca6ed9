//! Ticks and time of a Raspberry Pi chip.

use fugit::{ExtU32, MicrosDurationU32};
use stiction_firmware::line;

use super::chip::{Alarm, Timer};
use super::hal::fugit;
use super::hal::timer::{Alarm as _, Instant};
use crate::{Ticks, stop};

/// Ticks and time, both from one counter that never stops.
pub struct Clock {
    timer: Timer,
    alarm: Alarm,
    rate: u16,
    next: Instant,
}

impl Clock {
    pub(super) fn new(mut timer: Timer, rate: u16) -> Self {
        let Some(alarm) = timer.alarm_0() else { stop() };
        let next = timer.get_counter();
        let mut clock = Self {
            timer,
            alarm,
            rate,
            next,
        };
        clock.arm();
        clock.alarm.enable_interrupt();
        clock
    }

    fn period(&self) -> MicrosDurationU32 {
        (1_000_000 / u32::from(self.rate.max(1))).micros()
    }

    /// The next tick is a whole number of periods after the previous one, and not in the past.
    fn arm(&mut self) {
        let (period, now) = (self.period(), self.timer.get_counter());
        self.next += period;
        while self.next <= now {
            self.next += period;
        }
        let _ = self.alarm.schedule_at(self.next);
    }
}

impl Ticks for Clock {
    /// Beginning with the next one.
    fn set_rate(&mut self, rate: u16) {
        if rate != self.rate {
            self.next -= self.period();
            self.rate = rate;
            self.arm();
        }
    }

    fn tick(&mut self) -> u32 {
        self.alarm.clear_interrupt();
        self.arm();
        self.timer.get_counter_low()
    }
}

impl line::Clock for Clock {
    fn now_ns(&mut self) -> u32 {
        self.timer.get_counter_low().wrapping_mul(1_000)
    }
}
