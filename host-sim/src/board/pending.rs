//! Samples on their way to the board: which of them a pose answers, and which will no longer be answered.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use stiction_core::{Hand, Status};
use stiction_scene::Sample;
use stiction_wire::Pose;

use super::verify::Expected;

/// Sequence numbers repeat after 256: from there on, an older sample cannot be distinguished from a newer one.
const MOST: usize = 128;

#[derive(Clone, Debug)]
pub(super) struct Sent {
    /// The sequence number of its frame.
    pub(super) number: u8,
    /// The index of the sample, from 0.
    pub(super) index: u64,
    pub(super) sample: Sample,
    /// The sample as it was sent.
    pub(super) hand: Hand<f32>,
    pub(super) at: Instant,
    /// The result of the host's solver, if it is compared.
    pub(super) expected: Option<Box<Expected>>,
}

/// The samples on their way, in the order in which they were sent.
#[derive(Clone, Debug, Default)]
pub(super) struct Pending {
    waiting: VecDeque<Sent>,
}

impl Pending {
    /// Adds a sample. Returns those that are too old to be answered.
    pub(super) fn add(&mut self, sent: Sent) -> Vec<Sent> {
        self.waiting.push_back(sent);
        let beyond = self.waiting.len().saturating_sub(MOST);
        self.waiting.drain(..beyond).collect()
    }

    /// Returns the sample that a pose answers first, and the earlier ones, which it overtakes.
    pub(super) fn answer(&mut self, pose: &Pose) -> Option<(Sent, Vec<Sent>)> {
        let place = self.waiting.iter().position(|sent| {
            // A pose that is repeated because no samples arrive has the number of an earlier one.
            let held = pose.status == Status::HeldLast && sent.hand.is_finite();
            sent.number == pose.sample && !held
        })?;
        let overtaken = self.waiting.drain(..place).collect();
        let answered = self.waiting.pop_front()?;
        Some((answered, overtaken))
    }

    pub(super) fn len(&self) -> usize {
        self.waiting.len()
    }

    /// Returns when the oldest one will have waited for this duration.
    pub(super) fn overdue(&self, patience: Duration) -> Option<Instant> {
        self.waiting.front().map(|sent| sent.at + patience)
    }

    /// Returns the samples; no pose will answer them.
    pub(super) fn give_up(&mut self) -> Vec<Sent> {
        self.waiting.drain(..).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sent(index: u64) -> Sent {
        let hand = Hand::new(0.0, 0.0, 0.0);
        Sent {
            number: index as u8,
            index,
            sample: Sample {
                t: index as f64,
                hand: Hand::new(0.0, 0.0, 0.0),
            },
            hand,
            at: Instant::now(),
            expected: None,
        }
    }

    fn pose(sample: u8) -> Pose {
        Pose {
            sample,
            ..Pose::default()
        }
    }

    #[test]
    fn a_pose_answers_its_sample_once_and_overtakes_those_before() {
        let mut pending = Pending::default();
        (0..5).for_each(|index| assert!(pending.add(sent(index)).is_empty()));
        let (answered, overtaken) = pending.answer(&pose(2)).expect("it waits");
        assert_eq!((answered.index, overtaken.len()), (2, 2));
        assert!(
            pending.answer(&pose(2)).is_none(),
            "a pose of the next tick"
        );
        assert!(pending.answer(&pose(1)).is_none(), "a pose that came late");
        assert_eq!(pending.len(), 2);
    }

    #[test]
    fn a_pose_held_in_silence_answers_no_sample() {
        let mut pending = Pending::default();
        pending.add(sent(9));
        let held = Pose {
            status: Status::HeldLast,
            ..pose(9)
        };
        assert!(pending.answer(&held).is_none());
        let mut lost = sent(10);
        lost.hand.position[0] = f32::NAN;
        pending.add(lost);
        let held = Pose { sample: 10, ..held };
        assert!(
            pending.answer(&held).is_some(),
            "a sample that was not finite"
        );
    }

    #[test]
    fn a_number_comes_again_after_256() {
        let mut pending = Pending::default();
        let old: Vec<u64> = (0..300)
            .flat_map(|index| pending.add(sent(index)))
            .map(|sent| sent.index)
            .collect();
        assert_eq!(old, (0..172).collect::<Vec<_>>());
        let (answered, _) = pending.answer(&pose(255)).expect("it waits");
        assert_eq!(answered.index, 255);
    }
}
