//! The work of a step, counted where its loops are, in units of about one look at the motion of a single contact: what is left of the
//! budget of a step, and what its pieces take. A piece begins only where the most that it can take is left, or as the first of a step: no
//! step exceeds a budget that has room for a piece, and nothing that is done depends on it.
//!
//! What anything takes was found from the instructions of single pieces of random drags, steps of budget 0, on an emulated Cortex-M4F with
//! f32 and Cortex-M0 with fixed point, and from the cycles of a Cortex-M0+: by least squares, what each loop and each verb adds. A unit is
//! about 300 instructions of the first and 1800 of the second; where they do not agree, the dearer one counts.

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
    /// More is not counted before the next piece.
    most: u32,
}

impl Work {
    /// Nothing yet, of what is not a step.
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

    /// A piece that takes no more may begin.
    pub(crate) fn allows(self, most: u32) -> bool {
        self.budget.saturating_sub(self.done) >= most
    }

    /// A piece begins that takes no more; if it did, nothing beyond that would be counted. What contacts that fix the pose together may
    /// be asked has no bound that is not far beyond what they are asked.
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

/// What every step takes.
const STEP: u32 = 1;
/// What a certified frame takes of at most one contact, or an edge; of two contacts that slide.
const CERTIFIED: u32 = 2;
const CERTIFIED_SLIDE: u32 = 9;
/// What an event takes; one at which contacts come or go, or begin to slide with the hand.
const EVENT: u32 = 1;
const EVENT_OF_CONTACTS: u32 = 5;
/// What the verbs take but for their searches, without contact, of one vertex, one that slides, an edge, a corner, of contacts that fix
/// the pose together but for what these are asked.
const FREE: u32 = 2;
const VERTEX: u32 = 4;
const SLIDING_VERTEX: u32 = 9;
const EDGE: u32 = 5;
const CORNER: u32 = 3;
const TOGETHER: u32 = 5;
/// What it takes to see that a corner is not jammed.
const REST_OF_CORNER: u32 = 1;
/// What a slip of a vertex takes besides.
pub(crate) const SLIP: u32 = 2;
/// What a search for a touch takes to begin; what each surface adds that is near, and each vertex that may reach it.
pub(crate) const TOUCH: u16 = 2;
pub(crate) const SURFACE: u16 = 1;
pub(crate) const VERTEX_AT_SURFACE: u16 = 1;
/// What a place of a motion takes at which obstacles are looked at; one at which functions are looked at that fall.
pub(crate) const PLACE: u32 = 1;
pub(crate) const LOOK_AT_FALL: u32 = 2;
/// What three edges of a cone take that are to bear a load; some that are to come nearer to bearing it.
pub(crate) const THREE: u32 = 1;
pub(crate) const TRIAL: u32 = 2;
/// What a motion takes that may begin where contacts give way; so much more where two slide.
pub(crate) const MOTION: u32 = 1;
pub(crate) const DRIVEN: u32 = 7;
/// So much all motions take that are tried at one place: more than any of the random drags and the scenes of the program needed, 74.
const MOST_OF_MOTIONS: u32 = 80;
/// The looks of the searches of a verb share the most of a motion; so many more of their own they have together.
const OWN: u32 = 32;
const MOST_LOOKS: u32 = Looks::MOST as u32 + OWN + Looks::MOST_BESIDE as u32;

/// What it takes to know the cone of so many contacts.
pub(crate) const fn pose(contacts: u32) -> u32 {
    contacts.saturating_add(1)
}

/// What it takes to look at the facets of the cone of so many contacts: each two edges may be of one.
pub(crate) const fn facets(contacts: u32) -> u32 {
    pairs(contacts)
}

/// So many pairs, and threes, of the edges of the cone of so many contacts there are.
const fn pairs(contacts: u32) -> u32 {
    contacts.saturating_mul(contacts.saturating_mul(2).saturating_sub(1))
}

const fn threes(contacts: u32) -> u32 {
    pairs(contacts).saturating_mul(contacts.saturating_sub(1).saturating_mul(2)) / 3
}

/// The most that it takes to share out a load among so many contacts: among all threes, then twice what one to three edges add.
const fn most_of_shares(contacts: u32) -> u32 {
    let trials = threes(contacts)
        .saturating_add(pairs(contacts))
        .saturating_add(contacts.saturating_mul(2));
    threes(contacts).saturating_add(trials.saturating_mul(2 * TRIAL))
}

/// The most that it takes to find three edges of their cone that bear a load, and if there are none, what comes near to that.
const fn most_of_bearing(contacts: u32) -> u32 {
    (pose(contacts).saturating_add(threes(contacts))).saturating_add(most_of_shares(contacts))
}

/// The most that a verb of contacts takes that fix the pose: no three edges bear the load, nor do they but for the numbers; the facet
/// is found that yields, and the rounding beyond it, then the motion.
const fn most_of_pose(contacts: u32) -> u32 {
    let bears = threes(contacts).saturating_mul(2);
    let facets = facets(contacts).saturating_mul(2);
    (bears.saturating_add(facets))
        .saturating_add(most_of_bearing(contacts))
        .saturating_add(MOST_OF_MOTIONS)
}

impl<R: Real> ContactState<R> {
    /// The contacts that fix the pose together.
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

    /// What a certified frame takes but for the cone of contacts that fix the pose; a corner has none.
    pub(crate) fn certified_work(&self) -> u32 {
        match self.kind() {
            StateKind::NonContact | StateKind::SingleVertex | StateKind::Edge => CERTIFIED,
            StateKind::TwoVertex if self.slides() => CERTIFIED_SLIDE,
            StateKind::TwoVertex | StateKind::Corner | StateKind::Locked => 0,
        }
    }

    /// The most that one takes.
    pub(crate) fn most_of_certified(&self) -> u32 {
        let most = match self.kind() {
            StateKind::TwoVertex => const { most_of_certified(2) },
            StateKind::Locked => most_of_certified(self.count()),
            _ => 0,
        };
        self.certified_work().saturating_add(most)
    }

    /// What a verb takes but for its searches and what it asks of contacts together.
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

    /// The most that a verb takes.
    pub(crate) fn most_of_verb(&self) -> u32 {
        let most = match self.kind() {
            StateKind::TwoVertex => const { max(MOST_OF_TWO, most_of_pose(2)) },
            StateKind::Locked => most_of_pose(self.count()),
            StateKind::SingleVertex => SLIP + MOST_LOOKS,
            _ => MOST_LOOKS,
        };
        self.verb_work().saturating_add(most)
    }

    /// What an event takes but for what it asks of contacts together.
    pub(crate) fn event_work(&self, trigger: &Trigger<R>) -> u32 {
        match trigger {
            Trigger::Touch(_) | Trigger::Keep { .. } | Trigger::Clear => EVENT_OF_CONTACTS,
            Trigger::Slide(_) if !self.regime().has_stiction() => EVENT_OF_CONTACTS,
            _ => EVENT,
        }
    }

    /// The most that an event takes: contacts that let go are asked by how much; a vertex that slides, or two that stick, may go on in a
    /// slide of two.
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

    /// What the test takes whether the contacts at rest are jammed, but for their cone.
    pub(crate) fn rest_work(&self) -> u32 {
        match self.kind() {
            StateKind::Corner => REST_OF_CORNER,
            _ => 0,
        }
    }

    /// The most that it takes.
    pub(crate) fn most_of_rest(&self) -> u32 {
        let most = match self.kind() {
            StateKind::TwoVertex | StateKind::Corner => const { most_of_bearing(2) },
            StateKind::Locked => most_of_bearing(self.count()),
            _ => 0,
        };
        self.rest_work().saturating_add(most)
    }
}

/// What there is to do besides among obstacles with corners. All of it is nothing without them.
impl<R: Real> ContactState<R> {
    /// What it takes to see which contacts there are after a trigger, on average.
    pub(crate) fn passing_work<W: World<R>>(&self, scene: &W, trigger: &Trigger<R>) -> u32 {
        let looks = looks_of(trigger);
        if !W::CORNERS || looks == 0 {
            return 0;
        }
        let work = self.placed(scene).touching_work(scene);
        work.saturating_mul(looks)
    }

    /// The most that a verb takes, with what follows.
    pub(crate) fn most_of_verb_among<W: World<R>>(&self, scene: &W) -> u32 {
        if !W::CORNERS {
            return 0;
        }
        most_of_verb_among(self.kind(), Sizes::of(scene))
    }

    /// The most that a certified frame takes.
    pub(crate) fn most_of_certified_among<W: World<R>>(&self, scene: &W) -> u32 {
        if !W::CORNERS {
            return 0;
        }
        CERTIFIED_AMONG.saturating_add(Sizes::of(scene).most_of_frame())
    }

    /// The most that an event takes.
    pub(crate) fn most_of_event_among<W: World<R>>(&self, scene: &W, trigger: &Trigger<R>) -> u32 {
        if !W::CORNERS {
            return 0;
        }
        let looks = looks_of(trigger);
        let touching = Sizes::of(scene).most_of_touching();
        looks.saturating_mul(touching).saturating_add(EVENT_AMONG)
    }
}

/// So often it is looked at after a trigger which pairs touch.
const fn looks_of<R: Real>(trigger: &Trigger<R>) -> u32 {
    match trigger {
        Trigger::Off { .. } => MOST_TOUCHING,
        Trigger::Touch(_) | Trigger::Keep { .. } => 2,
        Trigger::Undriven | Trigger::Clear => 1,
        _ => 0,
    }
}
const MOST_TOUCHING: u32 = 3;
/// What a certified slide of two contacts takes more where one is a corner; an event more where two slide on.
pub(crate) const CERTIFIED_AMONG: u32 = 3;
const EVENT_AMONG: u32 = 2 * RUN;
/// What it takes to see that a slip of two contacts is a short one.
pub(crate) const CERTIFIED_SLIP: u32 = CERTIFIED_SLIDE + CERTIFIED_AMONG;

/// The most that a verb takes more among obstacles: its searches, of which a body without contact begins three, one after the other; the
/// looks of motions that are looked at place by place; a frame that is tried first, and what touches after it.
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

/// The most that it takes to try both senses of a slide of two contacts.
const MOST_OF_BEGIN: u32 = 2 * SLIDE;
/// The most that a slip of two contacts takes, with its end, or a slide.
const MOST_OF_TWO: u32 = OWN + max(MOST_OF_SLIDE, MOST_OF_RUN + pose(2) + most_of_shares(2));

/// The most that a certified frame takes of so many contacts that fix the pose: the edges of the last time, then all threes.
const fn most_of_certified(contacts: u32) -> u32 {
    (pose(contacts).saturating_add(THREE)).saturating_add(threes(contacts))
}

/// From this budget on no step takes more: a certified frame that fails, and the verb that takes most. More than three contacts at once
/// may need more.
pub(crate) const fn least(surfaces: bool) -> u32 {
    const OF_TWO: u32 = STEP + most_of_certified(2) + TOGETHER + max(MOST_OF_TWO, most_of_pose(2));
    const OF_THREE: u32 = STEP + most_of_certified(3) + TOGETHER + most_of_pose(3);
    const OF_ONE: u32 = STEP + CERTIFIED + SLIDING_VERTEX + SLIP + MOST_LOOKS;
    const OF_SURFACES: u32 = max(OF_ONE, max(OF_TWO, OF_THREE));
    if surfaces { OF_SURFACES } else { OF_ONE }
}

/// The same among obstacles: at most so many, with so many corners, and a body of so many vertices.
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
