//! What happens to a body along the straight path of the hand: the first of the events that its sticking or sliding contacts can
//! meet. The pose at a point of the hand's path shows whether an event has already happened; the point of the event is bisected.

use super::scene::{Pose, length};
use super::search::bisect;
use super::{CLEARANCE, Reference};

/// The largest number of events in a sub-step.
const EVENTS: u32 = 400;
/// A foot that moves back faster than this, per length of the hand's path, has reversed.
pub(super) const BACK: f64 = 1e-8;

/// What can happen on the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Happening {
    /// The balance is lost: its branch folds.
    Fold,
    /// A vertex has reached a surface.
    Touch,
    /// No contact presses, and the free body opens them all.
    Lift,
    /// One vertex or an edge no longer presses, but the free body would not leave the surface.
    Hold,
    /// The contact with this index no longer presses.
    Open(usize),
    /// Friction at rest does not bear the load.
    Yield,
    /// The load reaches N*, or the slips that two contacts would make reach the memory length.
    Memory,
    /// A sliding foot turns back.
    Reversal,
    /// The contact with this index slides off its side.
    Off(usize),
}

impl Reference {
    /// Follows the hand to `to`, from event to event.
    pub(super) fn advance(&mut self, to: [f64; 3]) {
        let Some(way) = self.direction(self.hand, to) else {
            if self.slide.take().is_some() {
                self.stiction = false;
            }
            return;
        };
        let from = self.hand;
        let place = |part: f64| [0, 1, 2].map(|k| from[k] + part * (to[k] - from[k]));
        let mut done = 0.0;
        for _ in 0..EVENTS {
            self.look();
            self.before = self.pose;
            if let Ok(pose) = self.carried(to, way) {
                self.pose = pose;
                self.hand = to;
                return;
            }
            let (before, after) = bisect(done, 1.0, |part| self.carried(place(part), way).is_err());
            let Err(event) = self.carried(place(after), way) else {
                break;
            };
            if let Ok(pose) = self.carried(place(before), way) {
                self.pose = pose;
            }
            self.hand = place(after);
            self.events += 1;
            self.meet(event, way);
            if self.ambiguous {
                return;
            }
            done = after;
        }
        self.skipped = true;
        self.relax(to);
        self.hand = to;
    }

    /// The direction of the hand, scaled to one body size; `None` if it rests.
    fn direction(&self, from: [f64; 3], to: [f64; 3]) -> Option<[f64; 3]> {
        let way = [0, 1, 2].map(|k| to[k] - from[k]);
        let whole = length([way[0], way[1]]) / self.size + way[2].abs();
        (whole > 0.0).then(|| way.map(|part| part / whole))
    }

    /// The pose with the hand at `hand`, or the event that has happened before.
    fn carried(&self, hand: [f64; 3], way: [f64; 3]) -> Result<Pose, Happening> {
        let pose = self.followed(hand).ok_or(Happening::Fold)?;
        if self.slide.is_some()
            && let Some(index) = self.off_side(&pose, &self.contacts)
        {
            return Err(Happening::Off(index));
        }
        if self.enters(&pose, CLEARANCE) {
            return Err(Happening::Touch);
        }
        match *self.contacts.as_slice() {
            [] => return Ok(pose),
            [_] => self.still_presses(&pose, hand)?,
            [_, _] if self.flat() => self.edge_presses(&pose, hand)?,
            _ => {}
        }
        if self.slide.is_some() {
            self.slides_still(&pose, hand, way)?;
        } else if !self.stiction && self.pressed_hard(&pose, hand) {
            return Err(Happening::Memory);
        } else if !self.admissible(&pose, &self.contacts, hand) {
            let lifts = self.contacts.len() > 1 && self.lifts_off(hand);
            return Err(if lifts {
                Happening::Lift
            } else {
                Happening::Yield
            });
        }
        Ok(pose)
    }

    /// Whether the free body keeps clear of all contacts by more than `least` body sizes.
    pub(super) fn comes_free(&self, hand: [f64; 3], least: f64) -> bool {
        let free = self.free_pose(hand);
        let clear = |&touch| self.scene.gap(&free, touch) >= least * self.size;
        self.contacts.iter().all(clear)
    }

    /// Whether the body comes free of all contacts, among obstacles also at the start of its path.
    fn lifts_off(&self, hand: [f64; 3]) -> bool {
        self.comes_free(hand, 0.0) && (self.scene.obstacles.is_empty() || self.opens(hand))
    }

    /// The event at N = 0 of one vertex.
    fn still_presses(&self, pose: &Pose, hand: [f64; 3]) -> Result<(), Happening> {
        let normal = self.reaction(pose, self.contacts[0], hand)[0];
        let tolerance = self.force_tolerance(pose, hand);
        if normal > tolerance {
            return Ok(());
        }
        let least = if normal < -tolerance {
            0.0
        } else {
            10.0 * CLEARANCE
        };
        if self.comes_free(hand, least) {
            return Err(Happening::Lift);
        }
        let before = self.reaction(&self.pose, self.contacts[0], self.hand)[0];
        if normal < -tolerance && before >= -tolerance {
            return Err(Happening::Hold);
        }
        Ok(())
    }

    /// The event at N_i = 0 of an edge.
    fn edge_presses(&self, pose: &Pose, hand: [f64; 3]) -> Result<(), Happening> {
        let normals = self.edge_normals(pose, [self.contacts[0], self.contacts[1]], hand);
        let weak = usize::from(normals[1] < normals[0]);
        let tolerance = self.force_tolerance(pose, hand);
        if normals[weak] >= -tolerance {
            return Ok(());
        }
        if normals[0] + normals[1] <= tolerance && self.comes_free(hand, 0.0) {
            return Err(Happening::Lift);
        }
        Err(Happening::Open(weak))
    }

    /// The events that end a slide.
    fn slides_still(&self, pose: &Pose, hand: [f64; 3], way: [f64; 3]) -> Result<(), Happening> {
        if let (Some(pair), Some(ways)) = (self.pair(), self.pair_ways()) {
            let normals = self
                .pair_normals(pose, pair, ways, hand)
                .ok_or(Happening::Fold)?;
            let weak = usize::from(normals[1] < normals[0]);
            if normals[weak] < -self.force_tolerance(pose, hand) {
                let lifts = self.lifts_off(hand);
                return Err(if lifts {
                    Happening::Lift
                } else {
                    Happening::Open(weak)
                });
            }
            if self.would_slip(pose, pair, ways, hand) {
                return Err(Happening::Memory);
            }
        } else if self.pressed_hard(pose, hand) {
            return Err(Happening::Memory);
        }
        if self.turned_back(hand, way) {
            return Err(Happening::Reversal);
        }
        Ok(())
    }

    /// Whether a sliding foot moves against its slide as the hand continues.
    pub(super) fn turned_back(&self, hand: [f64; 3], way: [f64; 3]) -> bool {
        let rates = self.rates(hand, way);
        rates.is_some_and(|rates| rates.iter().any(|&rate| rate < -BACK))
    }
}
