//! Times of the solver's steps during the last second.

use std::time::Duration;

/// Number of steps in a second.
const SECOND: usize = 1000;
/// Number of steps after which the median is computed again.
const EVERY: usize = 100;

/// Times of the steps of the last second (s).
#[derive(Clone, Debug)]
pub struct StepTimes {
    times: Vec<f32>,
    next: usize,
    sorted: Vec<f32>,
    median: f32,
    worst: f32,
}

impl Default for StepTimes {
    fn default() -> Self {
        Self {
            times: Vec::with_capacity(SECOND),
            next: 0,
            sorted: Vec::with_capacity(SECOND),
            median: 0.0,
            worst: 0.0,
        }
    }
}

impl StepTimes {
    /// Adds the time of a step.
    pub fn add(&mut self, time: Duration) {
        let time = time.as_secs_f32();
        match self.times.get_mut(self.next) {
            Some(old) => *old = time,
            None => self.times.push(time),
        }
        self.next = (self.next + 1) % SECOND;
        if self.next.is_multiple_of(EVERY) {
            self.sorted.clone_from(&self.times);
            let middle = self.sorted.len() / 2;
            let (_, median, _) = self.sorted.select_nth_unstable_by(middle, f32::total_cmp);
            self.median = *median;
            self.worst = self.times.iter().fold(0.0, |worst, &time| worst.max(time));
        }
    }

    /// Returns the median and the worst time (s).
    pub const fn summary(&self) -> [f32; 2] {
        [self.median, self.worst]
    }
}
