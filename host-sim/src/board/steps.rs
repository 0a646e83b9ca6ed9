//! Combines pose, forces and events of a step, which arrive as separate frames, by their time (FRAME 7).

use std::collections::VecDeque;
use std::time::Instant;

use stiction_wire::{EventSet, Mode, Pose};

use super::message::{Events, Forces, Received, Said};

/// A step is given up as incomplete after this number of later steps has begun.
const PATIENCE: usize = 4;
/// Maximum number of events that are stored for steps whose poses do not arrive; slips are still counted beyond it.
const MOST_EVENTS: usize = 1024;

#[derive(Clone, Debug)]
pub(super) struct Step {
    /// Arrival time of its pose.
    pub(super) at: Instant,
    pub(super) pose: Pose,
    pub(super) forces: Option<Forces>,
    /// Since the previous pose; none if nothing happened.
    pub(super) events: Option<Events>,
    /// Nothing of it was lost.
    pub(super) is_whole: bool,
}

#[derive(Clone, Debug)]
struct Parts {
    time: u32,
    pose: Option<(Instant, Pose)>,
    forces: Option<Forces>,
    events: Option<Events>,
}

impl Parts {
    /// Returns whether the pose arrived, and all its events are among those reported since the previous pose.
    fn has_pose(&self, reported: EventSet) -> bool {
        let is_reported = |pose: &Pose| reported.union(pose.events) == reported;
        self.pose.is_some_and(|(_, pose)| is_reported(&pose))
    }

    fn lacks(&self, said: &Said) -> bool {
        match said {
            Said::Pose(_) => self.pose.is_none(),
            Said::Forces(_) => self.forces.is_none(),
            Said::Events(_) => self.events.is_none(),
            Said::Answer(_) | Said::About(_) | Said::Health(_) | Said::Pong | Said::Knob(_) => {
                false
            }
        }
    }
}

/// The set of events, in the form in which a pose reports it.
fn set(events: Option<&Events>) -> EventSet {
    events.map_or_else(EventSet::default, |events| EventSet::of(&events.list))
}

#[derive(Clone, Debug)]
pub(super) struct Steps {
    pending: VecDeque<Parts>,
    /// Forces come with every pose, not only with some.
    with_forces: bool,
    /// Events of steps whose pose was not sent: they belong to the next pose that is sent.
    earlier: Option<Events>,
}

impl Steps {
    /// Those of a board in this mode.
    pub(super) fn of(mode: &Mode) -> Self {
        Self {
            pending: VecDeque::new(),
            with_forces: mode.forces_every == mode.pose_every,
            earlier: None,
        }
    }

    /// Nothing of it was lost. Forces follow their pose, so where not every pose has some, what comes next says that there are none.
    fn is_whole(&self, parts: &Parts, reported: EventSet, is_last: bool) -> bool {
        let has_forces = parts.forces.is_some() || !(self.with_forces || is_last);
        has_forces && parts.has_pose(reported)
    }

    /// Adds a part. Returns the steps for which nothing more will arrive, in order.
    pub(super) fn add(&mut self, received: Received) -> Vec<Step> {
        let Received { at, time, said } = received;
        let place = self
            .pending
            .iter()
            .position(|parts| parts.time == time && parts.lacks(&said));
        let place = place.unwrap_or_else(|| {
            self.pending.push_back(Parts {
                time,
                pose: None,
                forces: None,
                events: None,
            });
            self.pending.len() - 1
        });
        let parts = &mut self.pending[place];
        match said {
            Said::Pose(pose) => parts.pose = Some((at, pose)),
            Said::Forces(forces) => parts.forces = Some(forces),
            Said::Events(events) => parts.events = Some(events),
            Said::Answer(_) | Said::About(_) | Said::Health(_) | Said::Pong | Said::Knob(_) => {}
        }
        let beyond = self.pending.len().saturating_sub(PATIENCE);
        self.finish(beyond.max(self.up_to_the_last_whole()))
    }

    /// The number of steps up to the last complete one.
    fn up_to_the_last_whole(&self) -> usize {
        let mut reported = set(self.earlier.as_ref());
        let mut count = 0;
        for (k, parts) in self.pending.iter().enumerate() {
            reported = reported.union(set(parts.events.as_ref()));
            if self.is_whole(parts, reported, k + 1 == self.pending.len()) {
                count = k + 1;
            }
            if parts.pose.is_some() {
                reported = EventSet::default();
            }
        }
        count
    }

    /// Events of a step that was not requested belong to the next one.
    pub(super) fn keep(&mut self, events: Option<Events>) {
        if let Some(events) = events {
            match &mut self.earlier {
                Some(earlier) => earlier.merge(events, MOST_EVENTS),
                None => self.earlier = Some(events),
            }
        }
    }

    /// When the pose arrived whose forces may not be due: that of the last step, where not every pose has some.
    pub(super) fn last_pose_at(&self) -> Option<Instant> {
        let last = self.pending.back().filter(|_| !self.with_forces)?;
        last.pose.map(|(at, _)| at)
    }

    /// Returns the rest when nothing more will arrive.
    pub(super) fn flush(&mut self) -> Vec<Step> {
        self.finish(self.pending.len())
    }

    fn finish(&mut self, count: usize) -> Vec<Step> {
        let mut steps = Vec::new();
        let done: Vec<Parts> = self.pending.drain(..count).collect();
        for mut parts in done {
            self.keep(parts.events.take());
            let is_whole = self.is_whole(&parts, set(self.earlier.as_ref()), false);
            if let Some((at, pose)) = parts.pose {
                steps.push(Step {
                    at,
                    pose,
                    forces: parts.forces,
                    events: self.earlier.take(),
                    is_whole,
                });
            }
        }
        steps
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiction_core::{Event, Wrench};

    fn received(time: u32, said: Said) -> Received {
        Received {
            at: Instant::now(),
            time,
            said,
        }
    }

    fn pose(events: &[Event]) -> Said {
        Said::Pose(Pose {
            events: EventSet::of(events),
            ..Pose::default()
        })
    }

    fn forces(turns: i32) -> Said {
        Said::Forces(Forces {
            wrench: Wrench::default(),
            turns,
            contacts: Vec::new(),
        })
    }

    fn events(list: &[Event]) -> Said {
        Said::Events(Events {
            slips: 1,
            longest_slip: 0.5,
            list: list.to_vec(),
        })
    }

    /// Of a board that sends every pose, and forces with one pose in so many.
    fn steps(forces_every: u16) -> Steps {
        Steps::of(&Mode {
            forces_every,
            ..Mode::default()
        })
    }

    /// After these parts, with their times: of each step for which nothing more will come, whether it is whole. All come with the last
    /// part.
    fn whole(parts: &[(u32, Said)]) -> (Vec<bool>, Option<Events>) {
        let mut steps = steps(1);
        let mut done = Vec::new();
        for (time, part) in parts {
            assert!(done.is_empty(), "{parts:?}");
            done = steps.add(received(*time, part.clone()));
        }
        let last = done.last().and_then(|step| step.events.clone());
        (done.iter().map(|step| step.is_whole).collect(), last)
    }

    #[test]
    fn parts_come_in_any_order() {
        let touch = [Event::Touch];
        let [pose, forces, events] =
            [pose(&touch), forces(1), events(&touch)].map(|part| (7, part));
        for [a, b, c] in [
            [&pose, &forces, &events],
            [&pose, &events, &forces],
            [&forces, &pose, &events],
            [&forces, &events, &pose],
            [&events, &pose, &forces],
            [&events, &forces, &pose],
        ] {
            assert_eq!(whole(&[a, b, c].map(Clone::clone)).0, [true]);
        }
    }

    #[test]
    fn a_step_is_whole_when_its_forces_and_all_its_events_have_come() {
        use Event::{Slip, Touch};
        // Without events, it needs none.
        assert_eq!(whole(&[(1, pose(&[])), (1, forces(0))]).0, [true]);
        // One with a lost part comes before the next whole one.
        let lost = [(1, pose(&[])), (2, pose(&[])), (2, forces(0))];
        assert_eq!(whole(&lost).0, [false, true]);
        // Events of steps before do not stand for those that were lost.
        let part = [
            (1, events(&[Touch])),
            (2, pose(&[Touch, Slip])),
            (2, forces(0)),
            (3, pose(&[])),
            (3, forces(0)),
        ];
        assert_eq!(whole(&part).0, [false, true]);
        // A pose may report of steps before alone.
        let before = [(1, events(&[Slip])), (2, pose(&[Slip])), (2, forces(0))];
        assert_eq!(whole(&before).0, [true]);
    }

    #[test]
    fn a_step_whose_forces_are_not_due_is_whole_when_the_next_part_comes() {
        let mut steps = steps(2);
        let parts = [
            (1, pose(&[])),
            (2, pose(&[])),
            (2, forces(0)),
            (3, pose(&[])),
        ];
        let done = parts.map(|(time, part)| {
            let done = steps.add(received(time, part));
            done.iter().map(|step| step.is_whole).collect::<Vec<_>>()
        });
        assert_eq!(done, [vec![], vec![true], vec![true], vec![]]);
        let last: Vec<_> = steps.flush().iter().map(|step| step.is_whole).collect();
        assert_eq!(last, [true]);
    }

    #[test]
    fn events_without_a_pose_are_of_the_next_one() {
        use Event::{Slip, Touch};
        let (_, reported) = whole(&[
            (1, events(&[Touch])),
            (2, pose(&[Touch, Slip])),
            (2, events(&[Slip])),
            (2, forces(0)),
        ]);
        let reported = reported.expect("events");
        assert_eq!((reported.slips, reported.list), (2, vec![Touch, Slip]));
    }

    #[test]
    fn events_of_a_step_without_a_sample_are_of_the_next_one() {
        let mut steps = steps(1);
        for slips in 1..3 {
            steps.keep(Some(Events {
                slips,
                ..Events::default()
            }));
        }
        steps.keep(None);
        steps.add(received(9, pose(&[])));
        let done = steps.add(received(9, forces(0)));
        assert_eq!(done[0].events.as_ref().map(|events| events.slips), Some(3));
    }

    #[test]
    fn events_without_a_pose_stay_in_a_bounded_list() {
        let mut steps = steps(1);
        for time in 0..10_000 {
            assert!(steps.add(received(time, events(&[Event::Slip]))).is_empty());
        }
        steps.add(received(10_000, pose(&[Event::Slip])));
        let done = steps.add(received(10_000, forces(0)));
        let reported = done[0].events.as_ref().expect("events");
        assert_eq!((reported.slips, reported.list.len()), (10_000, MOST_EVENTS));
    }

    #[test]
    fn what_is_lost_does_not_hold_back_the_others() {
        let mut steps = steps(1);
        let done: usize = (0..100)
            .map(|k| steps.add(received(k, pose(&[]))).len())
            .sum();
        assert_eq!(done + steps.flush().len(), 100);
    }
}
