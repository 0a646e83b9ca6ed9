//! What a weight gives back that was lifted with a force that a limit of size reduced: no more than it took.
//!
//! The factor of the governor leaves springs passive, as it depends on their energy alone. A weight it does not: with a factor h, the hand
//! does the work h W dh as it lifts, and if h is larger on the way down, it gets more than that. So what the hand has not paid for is
//! counted as long as there is any: per turn, the growth of what springs and weight hold, H + W (height), and what the hand was given, F d,
//! without K d²/2, which the damping takes (`limits.rs`). By the proof there, this is never more than 0 while nothing is reduced. As q may
//! change faster than springs, a force that is output late counts by what it differs more.
//!
//! A weight that is lifted owes as it rises, and bears its debt until it is down again: to the height above which it owed all of it, or to a
//! lower place. What is owed beyond that is missing in the springs: one more factor q reduces the wrench, to zero when an eighth of H is
//! missing. In a turn with the factors h and q the hand is given at most (q h F)²/2K <= q² H, less than is there. So on any path the hand gets
//! no more than springs and weight held when the debt began; and on a closed path, cycle for cycle, nothing, once that part of it is missing.

use stiction_core::Real;

/// The force is zero when this part of what the springs hold is missing: the less, the less a hand is given on the first cycles.
const MISSING: f32 = 1.0 / 8.0;

/// What springs and weight hold in a turn (J).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Held {
    /// The springs, as far as the limit of size gives it.
    pub(crate) springs: f32,
    /// The weight, times the height of the body's centroid.
    pub(crate) weight: f32,
}

/// What the hand has not paid for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Debt(Option<Open>);

#[derive(Clone, Copy, Debug, PartialEq)]
struct Open {
    held: Held,
    /// What the weight holds at the place down to which it bears the debt (J).
    lowest: f32,
    /// J, 0 or more.
    owed: f32,
}

impl Debt {
    /// Nothing is reduced, and nothing is owed.
    pub(crate) fn is_none(&self) -> bool {
        self.0.is_none()
    }

    /// The part of the force that is given in this turn, 0 to 1. `given`: what the hand was given since the turn before, without K d²/2 (J).
    /// `is_limited`: a limit of size reduces the force.
    pub(crate) fn part(&mut self, held: Held, given: f32, is_limited: bool) -> f32 {
        let open = self.0.get_or_insert(Open {
            held,
            lowest: held.weight,
            owed: 0.0,
        });
        let grown = held.springs - open.held.springs + held.weight - open.held.weight;
        open.owed = Real::max(open.owed + grown + given, 0.0);
        open.held = held;
        let lowest = Real::max(open.lowest, held.weight - open.owed);
        open.lowest = Real::min(lowest, held.weight);
        let missing = open.owed - (held.weight - open.lowest);
        if !is_limited && open.owed == 0.0 {
            self.0 = None;
            return 1.0;
        }
        let most = MISSING * held.springs;
        if missing <= 0.0 {
            1.0
        } else if missing < most {
            1.0 - missing / most
        } else {
            0.0
        }
    }
}
