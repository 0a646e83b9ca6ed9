//! The loads on the two contacts of an edge on a path of the hand.

use super::keep;
use crate::balance_curve::Margin;
use crate::real::Real;
use crate::verb::Trigger;

/// Reactions on a path of the hand: (E4) and its change.
pub(super) struct Reaction<R> {
    /// N_1, N_2
    pub(super) parts: [Margin<R>; 2],
    /// N_1 + N_2
    pub(super) normal: Margin<R>,
    /// T
    pub(super) friction: Margin<R>,
}

impl<R: Real> Reaction<R> {
    /// One contact, or both, are pulled off.
    pub(super) fn opens(&self, sliding: Option<R>) -> Option<Trigger<R>> {
        let [first, second] = self.parts;
        match (
            first.start < -first.rounding,
            second.start < -second.rounding,
        ) {
            (true, true) => Some(Trigger::Clear),
            (true, false) => Some(keep(1, sliding)),
            (false, true) => Some(keep(0, sliding)),
            (false, false) => None,
        }
    }
}
