//! Counts of the samples: answered, late, lost; and the counts of the board.

use std::time::Instant;

use stiction_wire::Health;

use super::latency::Latency;

/// Counts of a stream, over all its sessions.
#[derive(Clone, Debug, Default)]
pub(super) struct Counts {
    /// Samples that were due.
    pub(super) samples: u64,
    /// Samples that were followed by a pose.
    pub(super) poses: u64,
    /// Of these, samples whose answer is missing a part: they are not in the trace.
    pub(super) incomplete: u64,
    /// Samples that were not followed by a pose: late or lost.
    pub(super) unanswered: u64,
    /// Of these, samples that were never sent because a newer one was available.
    pub(super) overtaken: u64,
    pub(super) faults: u64,
    pub(super) latency: Latency,
    pub(super) begun: Option<Instant>,
    /// Late samples of sessions that have ended.
    late_before: u64,
    /// The board's health at the beginning of the session, and in its latest report.
    health: Option<(Health, Health)>,
    /// Unanswered samples at the time of that report.
    unanswered_then: u64,
}

impl Counts {
    /// Adds `count` samples that were overtaken by newer ones before they were sent.
    pub(super) fn overtake(&mut self, count: u64) {
        self.samples += count;
        self.unanswered += count;
        self.overtaken += count;
    }

    pub(super) fn begin(&mut self, health: Option<Health>) {
        self.late_before = self.late() - self.overtaken;
        self.health = health.map(|health| (health, health));
    }

    /// Stores the board's report of its health.
    pub(super) fn note(&mut self, health: Health) {
        let (first, _) = self.health.unwrap_or((health, health));
        self.health = Some((first, health));
        self.unanswered_then = self.unanswered;
    }

    /// Samples that were overtaken by a newer one, here or before the board made a step with them.
    pub(super) fn late(&self) -> u64 {
        let now = self.health.map_or(0, |(first, last)| {
            u64::from(last.late_samples.saturating_sub(first.late_samples))
        });
        self.late_before + now + self.overtaken
    }

    /// Samples that did not reach the board, or whose poses did not return.
    pub(super) fn lost(&self) -> u64 {
        let unanswered = match self.health {
            Some(_) => self.unanswered_then,
            None => self.unanswered,
        };
        unanswered.saturating_sub(self.late())
    }

    /// The latest report of the board.
    pub(super) fn health(&self) -> Option<&Health> {
        self.health.as_ref().map(|(_, last)| last)
    }

    /// The stream has ended: unanswered samples remain unanswered.
    pub(super) fn end(&mut self) {
        self.unanswered_then = self.unanswered;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A session with a board that has counted so many late samples before it, and so many after it.
    fn session(counts: &mut Counts, late_samples: [u32; 2], unanswered: u64) -> (u64, u64) {
        let [before, after] = late_samples.map(|late_samples| Health {
            late_samples,
            ..Health::default()
        });
        counts.begin(Some(before));
        counts.unanswered = unanswered;
        counts.note(after);
        (counts.late(), counts.lost())
    }

    #[test]
    fn what_is_not_late_is_lost() {
        let mut counts = Counts::default();
        assert_eq!(session(&mut counts, [100, 105], 7), (5, 2));
        // A new session, with a board that counts from 0 again.
        assert_eq!(session(&mut counts, [0, 1], 10), (6, 4));
        // Without a word of the board, all are lost.
        let counts = Counts {
            unanswered: 3,
            ..Counts::default()
        };
        assert_eq!((counts.late(), counts.lost()), (0, 3));
    }

    #[test]
    fn what_is_overtaken_here_is_late() {
        let mut counts = Counts {
            overtaken: 3,
            ..Counts::default()
        };
        assert_eq!(session(&mut counts, [10, 11], 5), (4, 1));
        counts.begin(Some(Health::default()));
        assert_eq!(counts.late(), 4);
    }
}
