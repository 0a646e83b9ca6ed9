//! The work of a step, counted where its loops are, in units of about one look at the motion of a single contact: what is left of the
//! budget of a step, and what its pieces take. A piece begins only where the most that it can take is left, so that no step exceeds its
//! budget and nothing that is done depends on it.

use crate::event::StateKind;
use crate::real::Real;
use crate::search::Looks;
use crate::state::{ContactState, MOST_OF_RUN};
use crate::world::World;

/// The work of a step so far, in units, and its budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Work {
    budget: u32,
    done: u32,
}

impl Work {
    pub(crate) const fn within(budget: u32) -> Self {
        Self { budget, done: 0 }
    }

    /// A piece that takes no more may begin.
    pub(crate) fn allows(self, most: u32) -> bool {
        self.budget.saturating_sub(self.done) >= most
    }

    pub(crate) fn spend(&mut self, units: u32) {
        self.done = self.done.saturating_add(units);
    }

    pub(crate) fn done(self) -> u32 {
        self.done
    }
}

/// A certified frame, or a verb but for its searches, of at most one contact.
const CERTIFIED: u32 = 4;
const VERB: u32 = 8;
/// A verb of two contacts that move together, but for its searches.
const TWO: u32 = 40;
/// The looks of the searches of one verb: the most of them, four motions, has a free body that comes to rest.
const MOST_OF_LOOKS: u32 = 4 * Looks::MOST as u32;

/// What the cone of so many contacts takes, whose edges are combined by threes.
const fn cone(contacts: u32) -> u32 {
    let edges = 2 * contacts;
    edges * edges * edges / 4
}

/// The most that a piece takes with so many contacts at once.
const fn most(contacts: u32) -> u32 {
    if contacts < 2 {
        VERB + MOST_OF_LOOKS
    } else {
        let looks = if MOST_OF_LOOKS > MOST_OF_RUN {
            MOST_OF_LOOKS
        } else {
            MOST_OF_RUN
        };
        TWO + cone(contacts) + looks
    }
}

impl<R: Real> ContactState<R> {
    fn count(&self) -> u32 {
        u32::try_from(self.contacts().len()).unwrap_or(u32::MAX)
    }

    /// What a certified frame takes.
    pub(crate) fn certified_work(&self) -> u32 {
        match self.kind() {
            StateKind::NonContact | StateKind::SingleVertex | StateKind::Edge => CERTIFIED,
            _ => TWO,
        }
    }

    /// What a verb takes but for its searches, with what follows from it.
    pub(crate) fn verb_work(&self) -> u32 {
        match self.kind() {
            StateKind::NonContact | StateKind::SingleVertex | StateKind::Edge => VERB,
            StateKind::TwoVertex | StateKind::Corner | StateKind::Locked => {
                TWO + cone(self.count())
            }
        }
    }

    /// The most that the next piece of a step takes.
    pub(crate) fn most_work<W: World<R>>(&self, _: &W) -> u32 {
        if W::SURFACES {
            most(self.count())
        } else {
            most(1)
        }
    }
}

/// The least budget of a scene: what one piece may take, with a certified frame before it. More than four contacts at once have more.
pub(crate) const fn least(surfaces: bool) -> u32 {
    if surfaces {
        TWO + most(4)
    } else {
        CERTIFIED + most(1)
    }
}
