//! The hand between samples: it moves in a straight line from its present pose to the newest sample, one pose per tick. When
//! the switch changes, the hand is at that sample for a tick of its own, however soon the next sample follows: it closes
//! exactly where the sample says.

use std::collections::VecDeque;
use std::time::Duration;

use stiction_core::{Angle, Hand};

/// Fewest and most ticks of the path to a sample; a tick is 1 ms.
const LEAST: f64 = 1.0;
const MOST: f64 = 20.0;
/// Changes of the switch that wait for their ticks: if a client makes more than one per tick, the oldest are dropped.
const SWITCHES: usize = 8;

/// x, y (m), phi (rad), depth (m) and the hold switch of a live hand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandPose {
    /// x, y (m), phi (rad).
    pub pose: [f64; 3],
    /// Depth coordinate (m).
    pub depth: f64,
    /// The hold switch.
    pub held: bool,
}

impl HandPose {
    /// Returns the pose of a hand.
    pub fn of(hand: &Hand<f64>) -> Self {
        let [x, y] = hand.position;
        Self {
            // No negative zero: a recorded path would lose its sign.
            pose: [x, y, hand.angle.radians()].map(|value| value + 0.0),
            depth: hand.depth,
            held: hand.held,
        }
    }

    /// Returns the hand as the solver takes it, and as it is read from a file with these numbers.
    pub fn hand(&self) -> Hand<f64> {
        let [x, y, phi] = self.pose;
        Hand {
            position: [x, y],
            angle: Angle::from_radians(phi),
            depth: self.depth,
            held: self.held,
            tilted: false,
        }
    }
}

/// Moves the hand from sample to sample.
#[derive(Clone, Debug)]
pub struct Guide {
    now: HandPose,
    target: HandPose,
    /// Ticks until the target.
    left: u32,
    /// Samples that changed the switch, the oldest first: the hand visits each of them before it moves on.
    switches: VecDeque<HandPose>,
}

impl Guide {
    /// Returns a guide with the hand at rest.
    pub const fn at(pose: HandPose) -> Self {
        Self {
            now: pose,
            target: pose,
            left: 0,
            switches: VecDeque::new(),
        }
    }

    /// Takes a sample; `since`: the time since the previous one.
    pub fn lead(&mut self, target: HandPose, since: Duration) {
        let ticks = (since.as_secs_f64() * 1e3).round().clamp(LEAST, MOST);
        if target.held != self.target.held {
            if self.switches.len() == SWITCHES {
                self.switches.pop_front();
            }
            self.switches.push_back(target);
        }
        self.target = target;
        self.left = ticks as u32;
    }

    /// Moves the hand to another pose; with the next tick it returns and continues from there.
    pub fn leave_for(&mut self, pose: HandPose) {
        if self.now != pose {
            self.switches.push_front(self.now);
            self.now = pose;
        }
    }

    /// Returns the present pose of the hand.
    pub const fn now(&self) -> HandPose {
        self.now
    }

    /// Returns the pose of the hand at the next tick.
    pub fn advance(&mut self) -> HandPose {
        if let Some(switch) = self.switches.pop_front() {
            self.now = switch;
            return self.now;
        }
        let (from, to) = (self.now, self.target);
        let part = 1.0 / f64::from(self.left.max(1));
        let between = |from: f64, to: f64| from + (to - from) * part + 0.0;
        self.now = if self.left <= 1 {
            to
        } else {
            HandPose {
                pose: std::array::from_fn(|i| between(from.pose[i], to.pose[i])),
                depth: between(from.depth, to.depth),
                held: to.held,
            }
        };
        self.left = self.left.saturating_sub(1);
        self.now
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(x: f64) -> HandPose {
        HandPose {
            pose: [x, 0.0, 0.0],
            depth: 0.0,
            held: true,
        }
    }

    #[test]
    fn the_hand_goes_straight_in_the_time_between_samples() {
        let mut guide = Guide::at(pose(0.0));
        guide.lead(pose(8.0), Duration::from_millis(4));
        let way: Vec<f64> = (0..6).map(|_| guide.advance().pose[0]).collect();
        assert_eq!(way, [2.0, 4.0, 6.0, 8.0, 8.0, 8.0]);
    }

    #[test]
    fn the_time_between_samples_is_taken_as_1_to_20_ms() {
        for (since, ticks) in [(0, 1), (1, 1), (20, 20), (5000, 20)] {
            let mut guide = Guide::at(pose(0.0));
            guide.lead(pose(1.0), Duration::from_millis(since));
            let count = (1..).find(|_| guide.advance() == pose(1.0));
            assert_eq!(count, Some(ticks), "{since} ms");
        }
    }

    /// A press and a move of 20 m, arriving in one tick or in two.
    #[test]
    fn the_hand_closes_where_the_press_was_and_then_goes_on() {
        let open = |x| HandPose {
            held: false,
            ..pose(x)
        };
        for ms in [0, 1, 10] {
            let mut guide = Guide::at(open(0.0));
            guide.lead(pose(10.0), Duration::from_millis(15));
            guide.lead(pose(30.0), Duration::from_millis(ms));
            assert_eq!(guide.advance(), pose(10.0), "{ms} ms");
            let ticks = ms.max(1);
            let way: Vec<HandPose> = (0..ticks).map(|_| guide.advance()).collect();
            assert_eq!(way[0], pose(10.0 + 20.0 / ticks as f64));
            assert_eq!(way.last(), Some(&pose(30.0)));
        }
        // Released and grasped elsewhere between two ticks: it is open in between.
        let mut guide = Guide::at(pose(0.0));
        for to in [open(0.0), pose(5.0), pose(6.0)] {
            guide.lead(to, Duration::ZERO);
        }
        let way = [(); 3].map(|()| guide.advance());
        assert_eq!(way, [open(0.0), pose(5.0), pose(6.0)]);
    }

    #[test]
    fn a_switch_that_never_rests_keeps_no_more_than_8() {
        let mut guide = Guide::at(pose(0.0));
        for k in 0..1001 {
            let held = k % 2 == 1;
            guide.lead(HandPose { held, ..pose(0.0) }, Duration::ZERO);
        }
        assert_eq!(guide.switches.len(), SWITCHES);
        // The last one opens.
        assert!((0..SWITCHES).all(|k| guide.advance().held == (k % 2 == 0)));
        assert!(!guide.advance().held);
    }
}
