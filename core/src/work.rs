//! The work of a step, counted where its loops are, in units of about one look at the motion of a single contact: what is left of the
//! budget of a step, and what its pieces take. A piece begins only where the most that it can take is left, or as the first of a step: no
//! step exceeds a budget that has room for a piece, and nothing that is done depends on it.

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

/// What a certified frame takes of at most one contact, or an edge; of several contacts.
const CERTIFIED: u32 = 4;
const CERTIFIED_TOGETHER: u32 = 14;
/// What an event takes that leaves a single contact, or an edge; one that brings contacts to move together.
const EVENT: u32 = 6;
const EVENT_TOGETHER: u32 = 40;
/// What the verbs take but for the looks of their searches, without contact, of one vertex, an edge, a corner, of contacts that move
/// together.
const FREE: u32 = 24;
const VERTEX: u32 = 14;
const EDGE: u32 = 18;
const CORNER: u32 = 12;
const TOGETHER: u32 = 40;
/// The looks of the searches of a verb share the most of a motion; so many more of their own they have together.
const OWN: u32 = 32;
const MOST_LOOKS: u32 = Looks::MOST as u32 + OWN;

/// What the cone of so many contacts takes, whose edges are combined by threes.
const fn cone(contacts: u32) -> u32 {
    let edges = contacts.saturating_mul(2);
    edges.saturating_mul(edges).saturating_mul(edges) / 3
}

impl<R: Real> ContactState<R> {
    fn count(&self) -> u32 {
        u32::try_from(self.contacts().len()).unwrap_or(u32::MAX)
    }

    /// What a certified frame takes.
    pub(crate) fn certified_work(&self) -> u32 {
        match self.kind() {
            StateKind::NonContact | StateKind::SingleVertex | StateKind::Edge => CERTIFIED,
            StateKind::TwoVertex | StateKind::Corner | StateKind::Locked => CERTIFIED_TOGETHER,
        }
    }

    /// The most looks of a verb, in units of work: edges and what fixes the pose need none.
    fn most_looks(&self) -> u32 {
        match self.kind() {
            StateKind::NonContact | StateKind::SingleVertex | StateKind::Corner => MOST_LOOKS,
            StateKind::TwoVertex => MOST_OF_RUN + OWN,
            StateKind::Edge | StateKind::Locked => 0,
        }
    }

    /// The most that a verb takes.
    pub(crate) fn most_of_verb(&self) -> u32 {
        self.verb_work().saturating_add(self.most_looks())
    }

    /// What a verb takes but for its searches.
    pub(crate) fn verb_work(&self) -> u32 {
        match self.kind() {
            StateKind::NonContact => FREE,
            StateKind::SingleVertex => VERTEX,
            StateKind::Edge => EDGE,
            StateKind::Corner => CORNER,
            StateKind::TwoVertex | StateKind::Locked => TOGETHER.saturating_add(cone(self.count())),
        }
    }

    /// What an event takes: a slide of a vertex may go on as one of two.
    pub(crate) fn event_work<W: World<R>>(&self, _: &W) -> u32 {
        match self.kind() {
            StateKind::SingleVertex if W::SURFACES && self.regime().slide().is_some() => {
                EVENT_TOGETHER
            }
            StateKind::NonContact | StateKind::SingleVertex | StateKind::Edge => EVENT,
            StateKind::TwoVertex | StateKind::Corner | StateKind::Locked => {
                EVENT_TOGETHER.saturating_add(cone(self.count()))
            }
        }
    }

    /// What the test takes whether the contacts at rest are jammed.
    pub(crate) fn rest_work(&self) -> u32 {
        match self.kind() {
            StateKind::NonContact | StateKind::SingleVertex | StateKind::Edge => 0,
            StateKind::TwoVertex | StateKind::Corner | StateKind::Locked => cone(self.count()),
        }
    }
}

/// From this budget on no step takes more: two certified frames that fail, and the verb that takes most. More than four contacts at once
/// may need more.
pub(crate) const fn least(surfaces: bool) -> u32 {
    const OF_TWO: u32 = TOGETHER + cone(2) + MOST_OF_RUN + OWN;
    const OF_FOUR: u32 = TOGETHER + cone(4);
    const OF_SURFACES: u32 = 2 * CERTIFIED_TOGETHER + max(OF_TWO, OF_FOUR);
    const OF_ONE: u32 = 2 * CERTIFIED + FREE + MOST_LOOKS;
    if surfaces { OF_SURFACES } else { OF_ONE }
}

const fn max(a: u32, b: u32) -> u32 {
    if a > b { a } else { b }
}
