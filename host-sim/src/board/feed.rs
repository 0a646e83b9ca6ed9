//! The source of samples, in real time: a path, or the live tracker.

use stiction_scene::Sample;

use std::collections::VecDeque;
use std::iter::Peekable;
use std::time::{Duration, Instant};

/// Maximum number of samples that wait for the line: an older hand is useless.
const MOST_WAITING: usize = 2;
/// Maximum number of samples that wait for the line if each counts, as those of a tracker: half a minute of them.
const MOST_TRACKED: usize = 4096;

pub(super) enum Feed<'a> {
    /// A path, whose first sample is due immediately.
    Path {
        rest: Peekable<Box<dyn Iterator<Item = Sample> + Send + 'a>>,
        /// When it began, and the time of its first sample.
        begun: Option<(Instant, f64)>,
    },
    /// Samples as they arrive.
    Live {
        waiting: VecDeque<Sample>,
        /// The number of samples that may wait for the line.
        most: usize,
        ended: bool,
    },
}

impl<'a> Feed<'a> {
    pub(super) fn path(samples: impl Iterator<Item = Sample> + Send + 'a) -> Self {
        let rest: Box<dyn Iterator<Item = Sample> + Send + 'a> = Box::new(samples);
        Self::Path {
            rest: rest.peekable(),
            begun: None,
        }
    }

    pub(super) const fn live() -> Self {
        Self::Live {
            waiting: VecDeque::new(),
            most: MOST_TRACKED,
            ended: false,
        }
    }

    /// Samples as they arrive; those that the line has no time for are overtaken by newer ones.
    pub(super) const fn newest() -> Self {
        Self::Live {
            waiting: VecDeque::new(),
            most: MOST_WAITING,
            ended: false,
        }
    }

    /// Returns when the next sample is due; nothing if this is unknown.
    pub(super) fn next_due(&mut self, now: Instant) -> Option<Instant> {
        match self {
            Self::Path { rest, begun } => {
                let next = rest.peek()?;
                let (start, first) = *begun.get_or_insert((now, next.t));
                Some(start + Duration::from_secs_f64((next.t - first).max(0.0)))
            }
            Self::Live { waiting, .. } => (!waiting.is_empty()).then_some(now),
        }
    }

    /// Returns the next sample, if it is due.
    pub(super) fn take(&mut self, now: Instant) -> Option<Sample> {
        if self.next_due(now)? > now {
            return None;
        }
        match self {
            Self::Path { rest, .. } => rest.next(),
            Self::Live { waiting, .. } => waiting.pop_front(),
        }
    }

    /// Adds a sample that has arrived. Returns whether the oldest waiting one is overtaken.
    pub(super) fn push(&mut self, sample: Sample) -> bool {
        let Self::Live { waiting, most, .. } = self else {
            return false;
        };
        waiting.push_back(sample);
        let is_overtaken = waiting.len() > *most;
        if is_overtaken {
            waiting.pop_front();
        }
        is_overtaken
    }

    /// Returns whether only the newest sample matters, not every sample.
    pub(super) const fn is_hasty(&self) -> bool {
        matches!(self, Self::Live { most, .. } if *most == MOST_WAITING)
    }

    /// Drops the samples that were not sent yet.
    pub(super) fn drop_waiting(&mut self) {
        if let Self::Live { waiting, .. } = self {
            waiting.clear();
        }
    }

    /// Returns whether there are no more samples.
    pub(super) fn is_over(&mut self) -> bool {
        match self {
            Self::Path { rest, .. } => rest.peek().is_none(),
            Self::Live { waiting, ended, .. } => *ended && waiting.is_empty(),
        }
    }

    /// The tracker is disconnected: the samples that it delivered are still to be sent.
    pub(super) fn close(&mut self) {
        if let Self::Live { ended, .. } = self {
            *ended = true;
        }
    }

    /// Ends immediately; drops the remaining samples.
    pub(super) fn end(&mut self) {
        match self {
            Self::Path { rest, .. } => {
                let nothing: Box<dyn Iterator<Item = Sample> + Send + 'a> =
                    Box::new(std::iter::empty());
                *rest = nothing.peekable();
            }
            Self::Live { waiting, ended, .. } => {
                waiting.clear();
                *ended = true;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiction_core::Hand;

    fn sample(t: f64) -> Sample {
        Sample {
            t,
            hand: Hand::new(0.0, 0.0, 0.0),
        }
    }

    #[test]
    fn samples_of_a_path_are_due_at_their_times() {
        let mut feed = Feed::path([5.0, 5.25, 6.0].into_iter().map(sample));
        let begun = Instant::now();
        let after = |ms| begun + Duration::from_millis(ms);
        let mut taken = |ms| feed.take(after(ms)).map(|sample| sample.t);
        assert_eq!((taken(0), taken(0)), (Some(5.0), None));
        assert_eq!((taken(249), taken(250)), (None, Some(5.25)));
        assert_eq!((taken(2000), taken(3000)), (Some(6.0), None));
        assert!(feed.is_over());
    }

    #[test]
    fn samples_of_a_tracker_are_due_when_they_come() {
        let (mut feed, now) = (Feed::live(), Instant::now());
        assert!(feed.take(now).is_none() && !feed.is_over());
        feed.push(sample(1.0));
        assert_eq!(feed.next_due(now), Some(now));
        assert!(feed.take(now).is_some());
        feed.end();
        assert!(feed.is_over());
    }

    #[test]
    fn samples_of_a_tracker_wait_in_a_bounded_queue() {
        let mut feed = Feed::live();
        let overtaken = (0..5000).filter(|&t| feed.push(sample(f64::from(t))));
        assert_eq!(overtaken.count(), 5000 - MOST_TRACKED);
    }

    #[test]
    fn a_sample_that_the_line_has_no_time_for_is_overtaken() {
        let (mut feed, now) = (Feed::newest(), Instant::now());
        let overtaken: Vec<bool> = (0..4).map(|t| feed.push(sample(f64::from(t)))).collect();
        assert_eq!(overtaken, [false, false, true, true]);
        let left: Vec<f64> = std::iter::from_fn(|| feed.take(now))
            .map(|sample| sample.t)
            .collect();
        assert_eq!(left, [2.0, 3.0]);
    }
}
