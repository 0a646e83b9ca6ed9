//! The work of a step, counted in its loops, in units of about one evaluation of the motion of a single contact: the remaining budget of a
//! step, and the cost of its pieces. A piece begins only if its maximum cost is left, or as the first of a step: no step exceeds a budget
//! that has room for a piece, and no result depends on it.
//!
//! All costs were measured: from the instructions of single pieces of random drags, steps of budget 0, on an emulated Cortex-M4F with f32
//! and Cortex-M0 with fixed point, and from the cycles of a Cortex-M0+; a least-squares fit gives what each loop and each verb adds. A unit
//! is about 300 instructions of the first and 1800 of the second; where they do not agree, the more expensive one counts.

use crate::detect::Sizes;
use crate::event::StateKind;
use crate::falls::MOST_FALLS;
use crate::real::Real;
use crate::search::Looks;
use crate::state::{
    CORNER_LOOK, ContactState, MAX_HALVINGS, MOST_OF_PIECES, MOST_OF_RUN, MOST_OF_SLIDE, RUN,
    SLIDE, SPOT, SPOT_LOOK,
};
use crate::verb::Trigger;
use crate::world::World;

/// The work of a step so far, in units, and its budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Work {
    budget: u32,
    done: u32,
    /// No more than this is counted before the next piece.
    most: u32,
}

impl Work {
    /// No work so far, outside of a step.
    pub(crate) const fn none() -> Self {
        Self {
            budget: 0,
            done: 0,
            most: u32::MAX,
        }
    }

    pub(crate) const fn within(budget: u32) -> Self {
        Self {
            budget,
            done: STEP,
            most: u32::MAX,
        }
    }

    /// Returns whether a piece that takes no more than this may begin.
    pub(crate) fn allows(self, most: u32) -> bool {
        self.budget.saturating_sub(self.done) >= most
    }

    /// Begins a piece that takes no more than this; anything beyond would not be counted. The tests of contacts that fix the pose
    /// together have no bound close to their actual cost.
    pub(crate) fn begin(&mut self, most: u32) {
        self.most = self.done.saturating_add(most);
    }

    pub(crate) fn spend(&mut self, units: u32) {
        self.done = self.done.saturating_add(units).min(self.most);
    }

    pub(crate) fn done(self) -> u32 {
        self.done
    }
}

/// The base cost of every step.
const STEP: u32 = 1;
/// The cost of a certified frame with at most one contact, or an edge; and with two sliding contacts.
const CERTIFIED: u32 = 2;
const CERTIFIED_SLIDE: u32 = 9;
/// The cost of an event; and of one at which contacts come or go, or begin to slide with the hand.
const EVENT: u32 = 1;
const EVENT_OF_CONTACTS: u32 = 5;
/// The cost of the verbs without their searches: without contact, with one vertex, a sliding one, an edge, a corner, and contacts that fix
/// the pose together, without the tests of these.
const FREE: u32 = 2;
const VERTEX: u32 = 4;
const SLIDING_VERTEX: u32 = 9;
const EDGE: u32 = 5;
const CORNER: u32 = 3;
const TOGETHER: u32 = 5;
/// The cost of finding that a corner is not jammed.
const REST_OF_CORNER: u32 = 1;
/// The additional cost of a slip of a vertex.
pub(crate) const SLIP: u32 = 2;
/// The cost of beginning a search for a touch; of each surface that is near, and of each vertex that may reach it.
pub(crate) const TOUCH: u16 = 2;
pub(crate) const SURFACE: u16 = 1;
pub(crate) const VERTEX_AT_SURFACE: u16 = 1;
/// The cost of a point of a motion at which obstacles are examined; and of one at which falling functions are evaluated.
pub(crate) const PLACE: u32 = 1;
pub(crate) const LOOK_AT_FALL: u32 = 2;
/// The cost of testing whether three edges of a cone bear a load; and of bringing some edges closer to bearing it.
pub(crate) const THREE: u32 = 1;
pub(crate) const TRIAL: u32 = 2;
/// The cost of a motion that may begin where contacts give way; and the additional cost if two slide.
pub(crate) const MOTION: u32 = 1;
pub(crate) const DRIVEN: u32 = 7;
/// The maximum cost of all motions that are tried at one pose: more than any of the random drags and the scenes of the program needed, 74.
const MOST_OF_MOTIONS: u32 = 80;
/// The searches of a verb share the maximum of evaluations of a motion; this is the number of their own that they have together in
/// addition.
const OWN: u32 = 32;
const MOST_LOOKS: u32 = Looks::MOST as u32 + OWN + Looks::MOST_BESIDE as u32;

/// The cost of computing the cone of this many contacts.
pub(crate) const fn pose(contacts: u32) -> u32 {
    contacts.saturating_add(1)
}

/// The cost of examining the facets of the cone of this many contacts: each two edges may belong to one.
pub(crate) const fn facets(contacts: u32) -> u32 {
    pairs(contacts)
}

/// The numbers of pairs, and of triples, of the edges of the cone of this many contacts.
const fn pairs(contacts: u32) -> u32 {
    contacts.saturating_mul(contacts.saturating_mul(2).saturating_sub(1))
}

const fn threes(contacts: u32) -> u32 {
    pairs(contacts).saturating_mul(contacts.saturating_sub(1).saturating_mul(2)) / 3
}

/// The maximum cost of distributing a load among this many contacts: among all triples, then twice what one to three edges add.
const fn most_of_shares(contacts: u32) -> u32 {
    let trials = threes(contacts)
        .saturating_add(pairs(contacts))
        .saturating_add(contacts.saturating_mul(2));
    threes(contacts).saturating_add(trials.saturating_mul(2 * TRIAL))
}

/// The maximum cost of finding three edges of their cone that bear a load, and if there are none, the closest approach to that.
const fn most_of_bearing(contacts: u32) -> u32 {
    (pose(contacts).saturating_add(threes(contacts))).saturating_add(most_of_shares(contacts))
}

/// The maximum cost of a verb of contacts that fix the pose: no three edges bear the load, nor would they with more range of the numbers;
/// the facet that yields is found, and the rounding beyond it, then the motion.
const fn most_of_pose(contacts: u32) -> u32 {
    let bears = threes(contacts).saturating_mul(2);
    let facets = facets(contacts).saturating_mul(2);
    (bears.saturating_add(facets))
        .saturating_add(most_of_bearing(contacts))
        .saturating_add(MOST_OF_MOTIONS)
}

impl<R: Real> ContactState<R> {
    /// The number of contacts that fix the pose together.
    fn count(&self) -> u32 {
        match self {
            Self::Locked(locked) => {
                (u32::try_from(locked.others.len()).unwrap_or(u32::MAX)).saturating_add(1)
            }
            _ => 2,
        }
    }

    fn slides(&self) -> bool {
        self.regime().slide().is_some()
    }

    /// The cost of a certified frame without the cone of contacts that fix the pose; a corner has none.
    pub(crate) fn certified_work(&self) -> u32 {
        match self.kind() {
            StateKind::NonContact | StateKind::SingleVertex | StateKind::Edge => CERTIFIED,
            StateKind::TwoVertex if self.slides() => CERTIFIED_SLIDE,
            StateKind::TwoVertex | StateKind::Corner | StateKind::Locked => 0,
        }
    }

    /// The maximum cost of a certified frame.
    pub(crate) fn most_of_certified(&self) -> u32 {
        let most = match self.kind() {
            StateKind::TwoVertex => const { most_of_certified(2) },
            StateKind::Locked => most_of_certified(self.count()),
            _ => 0,
        };
        self.certified_work().saturating_add(most)
    }

    /// The cost of a verb without its searches and without its tests of contacts that fix the pose together.
    pub(crate) fn verb_work(&self) -> u32 {
        match self.kind() {
            StateKind::NonContact => FREE,
            StateKind::SingleVertex if self.slides() => SLIDING_VERTEX,
            StateKind::SingleVertex => VERTEX,
            StateKind::Edge => EDGE,
            StateKind::Corner => CORNER,
            StateKind::TwoVertex | StateKind::Locked => TOGETHER,
        }
    }

    /// The maximum cost of a verb.
    pub(crate) fn most_of_verb(&self) -> u32 {
        let most = match self.kind() {
            StateKind::TwoVertex => const { max(MOST_OF_TWO, most_of_pose(2)) },
            StateKind::Locked => most_of_pose(self.count()),
            StateKind::SingleVertex => SLIP + MOST_LOOKS,
            _ => MOST_LOOKS,
        };
        self.verb_work().saturating_add(most)
    }

    /// The cost of an event without its tests of contacts that fix the pose together.
    pub(crate) fn event_work(&self, trigger: &Trigger<R>) -> u32 {
        match trigger {
            Trigger::Touch(_) | Trigger::Keep { .. } | Trigger::Clear => EVENT_OF_CONTACTS,
            Trigger::Slide(_) if !self.regime().has_stiction() => EVENT_OF_CONTACTS,
            _ => EVENT,
        }
    }

    /// The maximum cost of an event: for contacts that let go it is computed by how much; a vertex that slides, or two that stick, may go
    /// on in a slide of two.
    pub(crate) fn most_of_event(&self, trigger: &Trigger<R>) -> u32 {
        let most = match (self.kind(), trigger) {
            (StateKind::SingleVertex, Trigger::Touch(_)) if self.slides() => MOST_OF_BEGIN,
            (StateKind::TwoVertex, Trigger::Slide(_)) => {
                const { pose(2) + facets(2) + MOST_OF_BEGIN + most_of_bearing(2) }
            }
            (StateKind::TwoVertex, _) => const { most_of_bearing(2) },
            (StateKind::Locked, _) => most_of_bearing(self.count()),
            _ => 0,
        };
        self.event_work(trigger).saturating_add(most)
    }

    /// The cost of testing whether the contacts at rest are jammed, without their cone.
    pub(crate) fn rest_work(&self) -> u32 {
        match self.kind() {
            StateKind::Corner => REST_OF_CORNER,
            _ => 0,
        }
    }

    /// The maximum cost of that test.
    pub(crate) fn most_of_rest(&self) -> u32 {
        let most = match self.kind() {
            StateKind::TwoVertex | StateKind::Corner => const { most_of_bearing(2) },
            StateKind::Locked => most_of_bearing(self.count()),
            _ => 0,
        };
        self.rest_work().saturating_add(most)
    }
}

/// The additional costs among obstacles with corners. All of them are zero without obstacles.
impl<R: Real> ContactState<R> {
    /// The average cost of finding the contacts after a trigger.
    pub(crate) fn passing_work<W: World<R>>(&self, scene: &W, trigger: &Trigger<R>) -> u32 {
        let looks = looks_of(trigger);
        if !W::CORNERS || looks == 0 {
            return 0;
        }
        let work = self.placed(scene).touching_work(scene);
        work.saturating_mul(looks)
    }

    /// The maximum cost of a verb, including what follows.
    pub(crate) fn most_of_verb_among<W: World<R>>(&self, scene: &W) -> u32 {
        if !W::CORNERS {
            return 0;
        }
        most_of_verb_among(self.kind(), Sizes::of(scene))
    }

    /// The maximum cost of a certified frame.
    pub(crate) fn most_of_certified_among<W: World<R>>(&self, scene: &W) -> u32 {
        if !W::CORNERS {
            return 0;
        }
        CERTIFIED_AMONG.saturating_add(Sizes::of(scene).most_of_frame())
    }

    /// The maximum cost of an event.
    pub(crate) fn most_of_event_among<W: World<R>>(&self, scene: &W, trigger: &Trigger<R>) -> u32 {
        if !W::CORNERS {
            return 0;
        }
        let looks = looks_of(trigger);
        let touching = Sizes::of(scene).most_of_touching();
        looks.saturating_mul(touching).saturating_add(EVENT_AMONG)
    }
}

/// How many times the touching pairs are determined after a trigger.
const fn looks_of<R: Real>(trigger: &Trigger<R>) -> u32 {
    match trigger {
        Trigger::Off { .. } => MOST_TOUCHING,
        Trigger::Touch(_) | Trigger::Keep { .. } => 2,
        Trigger::Undriven | Trigger::Clear => 1,
        _ => 0,
    }
}
const MOST_TOUCHING: u32 = 3;
/// The additional cost of a certified slide of two contacts if one is a corner; and of an event if two slide on.
pub(crate) const CERTIFIED_AMONG: u32 = 3;
const EVENT_AMONG: u32 = 2 * RUN;
/// The cost of finding that a slip of two contacts is a short one.
pub(crate) const CERTIFIED_SLIP: u32 = CERTIFIED_SLIDE + CERTIFIED_AMONG;

/// The additional maximum cost of a verb among obstacles: its searches, three of which a body without contact begins, one after the other;
/// the evaluations of motions that are examined point by point; a frame that is tried first, and the touching pairs after it.
const fn most_of_verb_among(kind: StateKind, sizes: Sizes) -> u32 {
    const FALLS: u32 = MOST_FALLS as u32 + 1;
    const HALVINGS: u32 = 2 * MAX_HALVINGS as u32 * CORNER_LOOK;
    let motion = match kind {
        StateKind::NonContact => sizes.most_of_search(PLACE).saturating_mul(3),
        StateKind::SingleVertex => max(
            (sizes.most_of_search(PLACE)).saturating_add(FALLS * LOOK_AT_FALL),
            (sizes
                .most_of_search(CORNER_LOOK)
                .saturating_add(FALLS * CORNER_LOOK))
            .saturating_mul(MOST_OF_PIECES)
            .saturating_add(HALVINGS),
        ),
        StateKind::TwoVertex => (sizes.most_of_search(SPOT))
            .saturating_add(2 * FALLS * SPOT_LOOK)
            .saturating_add(CERTIFIED_SLIP),
        _ => sizes.most_of_search(PLACE),
    };
    let touching = sizes.most_of_touching().saturating_mul(MOST_TOUCHING + 1);
    (motion.saturating_add(touching)).saturating_add(sizes.most_of_frame())
}

/// The maximum cost of trying both directions of a slide of two contacts.
const MOST_OF_BEGIN: u32 = 2 * SLIDE;
/// The maximum cost of a slip of two contacts, with its end, or of a slide.
const MOST_OF_TWO: u32 = OWN + max(MOST_OF_SLIDE, MOST_OF_RUN + pose(2) + most_of_shares(2));

/// The maximum cost of a certified frame of this many contacts that fix the pose: the edges of last time, then all triples.
const fn most_of_certified(contacts: u32) -> u32 {
    (pose(contacts).saturating_add(THREE)).saturating_add(threes(contacts))
}

/// With this budget or a larger one no step exceeds its budget: a certified frame that fails, and the most expensive verb. More than three
/// simultaneous contacts may need more.
pub(crate) const fn least(surfaces: bool) -> u32 {
    const OF_TWO: u32 = STEP + most_of_certified(2) + TOGETHER + max(MOST_OF_TWO, most_of_pose(2));
    const OF_THREE: u32 = STEP + most_of_certified(3) + TOGETHER + most_of_pose(3);
    const OF_ONE: u32 = STEP + CERTIFIED + SLIDING_VERTEX + SLIP + MOST_LOOKS;
    const OF_SURFACES: u32 = max(OF_ONE, max(OF_TWO, OF_THREE));
    if surfaces { OF_SURFACES } else { OF_ONE }
}

/// The same among obstacles: with these maximum numbers of obstacles and corners, and a body of this many vertices.
pub(crate) const fn least_among(vertices: usize, capacity: [usize; 2]) -> u32 {
    let [obstacles, corners] = capacity;
    let sizes = Sizes::new([vertices as u32, corners as u32, obstacles as u32]);
    let free = most_of_verb_among(StateKind::NonContact, sizes);
    let one = most_of_verb_among(StateKind::SingleVertex, sizes);
    let two = most_of_verb_among(StateKind::TwoVertex, sizes);
    let certified = CERTIFIED_AMONG.saturating_add(sizes.most_of_frame());
    least(true)
        .saturating_add(certified)
        .saturating_add(max(free, max(one, two)))
}

const fn max(a: u32, b: u32) -> u32 {
    if a > b { a } else { b }
}
