//! What ended a motion.

use crate::contact::{Feature, Sense};

/// What ended a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The end of the displacement.
    End,
    /// The evaluations are used up, or the bounds end; nothing has happened so far.
    GoesOn,
    /// Balance of a frozen motion, or the excess of a slip is used up.
    Stopped,
    /// The branch of balance ends.
    Fold,
    /// A gap closes.
    Touch(Feature),
    /// A contact slides off the end of its side.
    Ends(Which),
    /// The cone of a stick ends on the side of a slide.
    Yields(Sense),
    /// The reaction of a single contact vanishes.
    Clear,
    /// The contacts press hard enough for stiction.
    Pressed,
    /// A slide comes to a halt.
    Halt,
    /// The reaction of one of two contacts that slide vanishes.
    Opens(Which),
    /// The contacts do not bear the load any more.
    GivesWay,
}

impl Ending {
    pub(crate) fn is_touch(self) -> bool {
        matches!(self, Self::Touch(_))
    }
}

/// One of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Which {
    First,
    Second,
}
impl Which {
    pub(crate) fn other(self) -> Self {
        match self {
            Self::First => Self::Second,
            Self::Second => Self::First,
        }
    }
    pub(crate) fn index(self) -> usize {
        match self {
            Self::First => 0,
            Self::Second => 1,
        }
    }
    pub(crate) fn of<T: Copy>(self, [first, second]: [T; 2]) -> T {
        match self {
            Self::First => first,
            Self::Second => second,
        }
    }
}
