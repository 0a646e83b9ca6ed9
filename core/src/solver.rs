//! The door: hands in SI units in, poses, events and forces out.

use crate::errand::Errand;
use crate::event::Status;
use crate::evolution::Evolution;
use crate::geometry::Angle;
use crate::geometry::Rotation;
use crate::grasp::{Sample, is_representable};
use crate::hand::Hand;
use crate::hold::Hold;
use crate::log::Log;
use crate::output::Output;
use crate::real::Real;
use crate::scene::Scene;
use crate::state::{Body, HandPose};
use crate::step::Step;
use crate::world::{Grip, Statics};

/// The solver of one scene with at most V vertices, S surfaces and C corners. It holds no state of a run: one solver serves any number of
/// runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Solver<R: Real, const V: usize, const S: usize, const C: usize = 0> {
    pub(crate) scene: Scene<R, V, S, C>,
    evolution: Evolution,
    budget: u32,
}

/// The state of a run: plain data. A copy of it is a snapshot; assigned back, the run repeats bit for bit, on every machine. It belongs to
/// the scene of the solver that created it.
#[derive(Clone, Debug, PartialEq)]
pub struct State<R: Real> {
    pub(crate) body: Body<R>,
    /// Where the hand holds the body or held it last.
    pub(crate) grip: Grip<R>,
    /// phi - theta at which the rotational spring rests.
    pub(crate) rest_offset: Angle<R>,
    /// Whole turns by which the angles of body and hand are more than their numbers.
    pub(crate) turns: i32,
    pub(crate) held: bool,
    pub(crate) hold: Hold,
    pub(crate) hand: Hand<R::Si>,
    pub(crate) errand: Errand<R>,
    /// What limited the answer when the body was last followed.
    pub(crate) limited: Status,
}

impl<R: Real> State<R> {
    /// The last usable sample of the hand, as it was given: the one that the state belongs to. Before the first one: x = y = phi = 0, not
    /// holding.
    pub fn hand(&self) -> &Hand<R::Si> {
        &self.hand
    }
    /// How the hand came to hold the body, or, if it has let go, came to hold it last.
    pub fn hold(&self) -> Hold {
        self.hold
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Solver<R, V, S, C> {
    /// A solver for a scene, without a budget.
    pub fn new(scene: Scene<R, V, S, C>, evolution: Evolution) -> Self {
        Self {
            scene,
            evolution,
            budget: u32::MAX,
        }
    }
    /// This solver with an evolution (R40); an existing state remains valid.
    #[must_use]
    pub fn with_evolution(mut self, evolution: Evolution) -> Self {
        self.evolution = evolution;
        self
    }
    /// This solver with a bound on the work of a step, in pieces (R41): a window of a motion, a word of settling or a candidate of a
    /// selection. A step does no more, but at least one: the body stays behind the hand, the status is [`Status::Behind`], and the next step
    /// goes on from there. Repeated with the same sample until [`Output::behind`] is 0, it ends in the same bits as one step without a
    /// budget; with a new sample the hand's path leads straight from where the body is certain to be.
    #[must_use]
    pub fn with_budget(mut self, pieces: u32) -> Self {
        self.budget = pieces;
        self
    }
    /// The most pieces of work of a step; `u32::MAX` without a budget.
    pub fn budget(&self) -> u32 {
        self.budget
    }

    /// The statics as the scene has it, with the body held where it is.
    pub(crate) fn statics<'a>(&'a self, state: &'a State<R>) -> Statics<'a, R, V, S, C> {
        self.scene.world.held(&state.grip)
    }

    /// Starts a run: the equilibrium that is reached from the scene's start pose with the hand at its first pose. A hand that is not finite
    /// or out of range counts as absent: the body stays at its start until a usable one takes hold; it also does so while the hand's switch
    /// is off.
    pub fn start(&self, hand: Hand<R::Si>) -> (State<R>, Output<R::Si>) {
        let mut state = self.placed_at_start();
        let output = self.step(&mut state, hand);
        (state, output)
    }
    /// The body at its start pose, seated on what it touches (R45).
    #[inline(never)]
    fn placed_at_start(&self) -> State<R> {
        let HandPose { at, angle } = self.scene.start;
        let world = &self.scene.world;
        let holding_point = self.scene.holding_point.unwrap_or(world.centroid);
        let holding = at + Rotation::by(angle).apply(holding_point);
        let first = HandPose { at: holding, angle };
        let mut state = State {
            body: Body::new(holding, angle, first),
            grip: world.grip(holding_point),
            rest_offset: Angle::default(),
            turns: self.scene.turns,
            held: false,
            hold: Hold::Never,
            hand: Hand::default(),
            errand: Errand::none(),
            limited: Status::Ok,
        };
        world
            .held(&state.grip)
            .join_closed(&mut state.body, Scene::<R, V, S, C>::start_tolerance());
        state
    }

    /// One frame: the hand moves to its new pose and the body follows; by its switch it takes hold and lets go. It never fails. A sample that
    /// cannot be used leaves the body as it is, and the status reports it: [`Status::HeldLast`] for one that is not finite,
    /// [`Status::Saturated`] for one beyond the range of the number type. The next usable sample is followed from the last usable one.
    pub fn step(&self, state: &mut State<R>, hand: Hand<R::Si>) -> Output<R::Si> {
        self.step_until(state, hand, || true)
    }
    /// One frame, as far as `more` and the budget permit: `more` is asked between two pieces of work, each about one evaluation of a motion.
    /// What is left is done by the next step: the status is [`Status::Behind`].
    pub fn step_until(
        &self,
        state: &mut State<R>,
        hand: Hand<R::Si>,
        mut more: impl FnMut() -> bool,
    ) -> Output<R::Si> {
        let mut log = Log::default();
        if let Some(sample) = self.usable(&hand, &mut log) {
            let is_new = hand != state.hand;
            let aim = match (state.held, hand.held) {
                (true, true) => self.aim(state, &sample, is_new, &mut log),
                (true, false) => {
                    state.let_go(&mut log);
                    Some(None)
                }
                (false, true) => Some(self.take_hold(state, &sample, &mut log)),
                (false, false) => Some(None),
            };
            match aim {
                Some(target) => {
                    state.hand = hand;
                    if let Some(target) = target {
                        self.follow(state, (target, is_new), &mut log, &mut more);
                    }
                }
                None => log.limit(Status::Saturated),
            }
        }
        self.output(state, log)
    }
    /// Where a sample, a new one or again, leads the hand that holds the body; nowhere if it is there, and all is done. None if the sample is
    /// out of range.
    #[inline(always)]
    fn aim(
        &self,
        state: &mut State<R>,
        sample: &Sample<R>,
        is_new: bool,
        log: &mut Log<R>,
    ) -> Option<Option<HandPose<R>>> {
        let is_still = state.errand.is_still();
        let mut target = state.relative(sample);
        if is_new && is_still && state.unwind() {
            target = state.relative(sample);
        }
        if state.grip.swings {
            if is_new && is_still {
                state.body.hand.angle = state.body.angle;
            }
            // The hand turns nothing.
            target.angle = state.body.hand.angle;
        }
        // A sample that was accepted is followed to its end.
        if is_new && !is_representable(&self.statics(state), &state.body, &target) {
            return None;
        }
        let unrest = unrest_of(state.limited);
        if is_still && state.body.hand == target {
            log.limit(unrest);
            return Some(None);
        }
        if is_new {
            // Out of balance there is no path.
            state.errand.jumps |= is_still && !matches!(unrest, Status::Ok | Status::Jammed);
        } else {
            log.limit(state.limited);
        }
        Some(Some(target))
    }

    /// Follows the hand to where a sample leads it, a new one or again.
    #[inline(always)]
    fn follow(
        &self,
        state: &mut State<R>,
        (target, is_new): (HandPose<R>, bool),
        log: &mut Log<R>,
        more: &mut impl FnMut() -> bool,
    ) {
        let from = state.body.hand;
        let statics = self.scene.world.held(&state.grip);
        let mut step = Step {
            statics: &statics,
            body: &mut state.body,
            errand: &mut state.errand,
            log,
            evolution: self.evolution,
            budget: self.budget,
        };
        let is_done = step.follow_to(target, more);
        state.limited = log.status;
        if is_done {
            state.errand.has_caught_up();
        } else {
            if is_new {
                state.errand.whole = from.distance(&target);
            }
            state.errand.is_left(&state.body.hand, &target);
            log.limit(Status::Behind);
        }
    }
}

/// The part of a status that means the pose is not a balance, or not for long.
fn unrest_of(status: Status) -> Status {
    match status {
        Status::Ok | Status::EventLimit | Status::Twist | Status::Behind => Status::Ok,
        Status::IterationLimit
        | Status::Jammed
        | Status::Ambiguous
        | Status::Saturated
        | Status::HeldLast => status,
    }
}
