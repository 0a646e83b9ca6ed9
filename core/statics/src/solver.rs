//! The door: hands in SI units in, poses, events and forces out.

use crate::contact::{Feature, MAX_CONTACTS, Sense};
use crate::description::Described;
use crate::errand::{Errand, Next, Stage};
use crate::geometry::{Rotation, Vec2, one_in};
use crate::list::gather;
use crate::log::Log;
use crate::output::Output;
use crate::real::Real;
use crate::state::{Body, HandPose};
use crate::step::Step;
use crate::thresholds::Thresholds;
use crate::world::{Statics, Stiffness};
use heapless::Vec;
use stiction_core::{
    Angle, Contact, Description, Hand, ObstacleDescription, SceneError, Status, Touching, Wrench,
};

/// The solver of one scene with at most V vertices, S surfaces and C corners. It holds no state of a run.
#[derive(Clone, Debug)]
pub struct Solver<R: Real, const V: usize, const S: usize, const C: usize> {
    pub(crate) scene: Described<R, V, S, C>,
}

/// The state of a run: plain data. A copy of it is a snapshot.
#[derive(Clone, Debug)]
pub struct State<R: Real> {
    pub(crate) body: Body<R>,
    /// Whole turns by which the angles of body and hand are more than their numbers.
    turns: i32,
    errand: Errand<R>,
    /// Why the pose is not a balance: reported until the hand moves.
    unrest: Status,
    depth: R::Si,
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Solver<R, V, S, C> {
    /// A solver for a scene.
    ///
    /// # Errors
    /// [`SceneError`] names the first parameter that is not usable, its value and what is allowed.
    pub fn new(description: &Description<'_, R::Si>) -> Result<Self, SceneError<R::Si>> {
        Self::among(description, &[])
    }
    /// A solver for a scene with obstacles.
    ///
    /// # Errors
    /// [`SceneError`] names the first parameter that is not usable, its value and what is allowed.
    pub fn among(
        description: &Description<'_, R::Si>,
        obstacles: &[ObstacleDescription<'_, R::Si>],
    ) -> Result<Self, SceneError<R::Si>> {
        Ok(Self {
            scene: Described::new(description, obstacles)?,
        })
    }
    /// The statics as the scene has it.
    fn statics(&self) -> Statics<'_, R, V, S, C> {
        self.scene.world.held_at(self.scene.holding_point)
    }
    /// The statics with a spring that holds the angle where nothing else does, unless it is off (R34).
    pub(crate) fn held(&self, loose: bool) -> Statics<'_, R, V, S, C> {
        let mut statics = self.statics();
        if self.swings() && !loose {
            statics.stiffness = Stiffness::new(R::swing(), R::swing() * R::from_int(64));
        }
        statics
    }
    /// Nothing holds the angle: no spring, and no weight that turns.
    fn swings(&self) -> bool {
        let world = &self.scene.world;
        let arm = world.centroid - self.scene.holding_point;
        let is_loose = world.weight == R::ZERO || arm == Vec2::ZERO;
        world.stiffness.value == R::ZERO && is_loose
    }

    /// Starts a run: the equilibrium that is reached from the scene's start pose with the hand at its first pose. A hand that cannot be
    /// used counts as absent.
    pub fn start(&self, hand: Hand<R::Si>) -> (State<R>, Output<R::Si>) {
        let (statics, mut log) = (self.held(false), Log::default());
        let HandPose { at, angle } = self.scene.start;
        let holding = at + Rotation::by(angle).apply(self.scene.holding_point);
        let first = HandPose { at: holding, angle };
        let mut state = State {
            body: Body::new(holding, angle, first),
            turns: self.scene.turns,
            errand: Errand::none(),
            unrest: Status::Ok,
            depth: R::Si::ZERO,
        };
        // In floats: not every number type represents this.
        let near = R::from_si(one_in(100_000), R::Si::ONE);
        statics.join_closed(&mut state.body, near);
        if let Some(target) = self.usable(&state, &hand, &mut log) {
            state.depth = hand.depth;
            state.body.hand = target;
            state.errand.target = target;
            if self.swings() {
                state.body.hand.angle = state.body.angle;
            }
            state.errand.settle(Next::Relax(Sense::Rests));
            let mut step = Step {
                statics: &statics,
                body: &mut state.body,
                errand: &mut state.errand,
                log: &mut log,
            };
            while step.errand.stage != Stage::Still {
                step.piece(target);
            }
        }
        let output = self.output(&state, log);
        (state, output)
    }

    /// One frame: the hand moves to its new pose and the body follows. It never fails. A sample that cannot be used leaves the body as it
    /// is, and the status reports it.
    pub fn step(&self, state: &mut State<R>, hand: Hand<R::Si>) -> Output<R::Si> {
        self.step_until(state, hand, || true)
    }
    /// One frame, as far as `more` permits: it is asked between two pieces of work, each about one evaluation of a motion. What is left is
    /// done by the next step: the status is [`Status::Behind`].
    pub fn step_until(
        &self,
        state: &mut State<R>,
        hand: Hand<R::Si>,
        more: impl FnMut() -> bool,
    ) -> Output<R::Si> {
        let (statics, mut log) = (self.held(false), Log::default());
        if let Some(mut target) = self.usable(state, &hand, &mut log) {
            let is_still = state.errand.stage == Stage::Still;
            if is_still && self.unwind(state, &target) {
                target = self.relative(state, &hand);
            }
            if self.swings() {
                target.angle = if is_still {
                    state.body.angle
                } else {
                    state.errand.target.angle
                };
                if is_still {
                    state.body.hand.angle = target.angle;
                }
            }
            if self.is_representable(&statics, &state.body, &target) {
                state.depth = hand.depth;
                if is_still && state.body.hand == target {
                    log.limit(state.unrest);
                } else {
                    self.follow(state, target, &mut log, more);
                    state.unrest = match log.status {
                        Status::Ok | Status::EventLimit | Status::Twist | Status::Behind => {
                            Status::Ok
                        }
                        Status::IterationLimit
                        | Status::Jammed
                        | Status::Ambiguous
                        | Status::Saturated
                        | Status::HeldLast => log.status,
                    };
                }
            } else {
                log.limit(Status::Saturated);
            }
        }
        self.output(state, log)
    }

    /// Follows the hand; where nothing holds the angle the body comes to its own balance at the end.
    fn follow(
        &self,
        state: &mut State<R>,
        target: HandPose<R>,
        log: &mut Log<R>,
        mut more: impl FnMut() -> bool,
    ) {
        let [held, loose] = [false, true].map(|loose| self.held(loose));
        let mut step = Step {
            statics: &held,
            body: &mut state.body,
            errand: &mut state.errand,
            log,
        };
        if step.errand.loose {
            let before = step.errand.target;
            let mut step = Step {
                statics: &loose,
                body: &mut *step.body,
                errand: &mut *step.errand,
                log: &mut *step.log,
            };
            step.errand.loose = !step.follow_to(before, &mut more);
            if step.errand.loose || before == target {
                return;
            }
        }
        if step.follow_to(target, &mut more) && self.swings() {
            let mut step = Step {
                statics: &loose,
                ..step
            };
            step.errand.target = target;
            step.rebalance();
            step.errand.loose = !step.follow_to(target, &mut more);
        }
    }

    /// A sample relative to the whole turns of the state.
    fn relative(&self, state: &State<R>, hand: &Hand<R::Si>) -> HandPose<R> {
        let (turns, rest) = hand.angle.rest.turns();
        let hand_angle = Angle {
            turns: hand.angle.turns.saturating_add(turns),
            rest: R::from_si(rest, R::Si::ONE),
        };
        let base = Angle {
            turns: state.turns,
            rest: R::ZERO,
        };
        HandPose {
            at: self.scene.units.point(hand.position),
            angle: hand_angle.minus(base),
        }
    }
    /// A sample that can be used; the log records why it cannot.
    fn usable(
        &self,
        state: &State<R>,
        hand: &Hand<R::Si>,
        log: &mut Log<R>,
    ) -> Option<HandPose<R>> {
        if !hand.is_finite() {
            log.limit(Status::HeldLast);
            return None;
        }
        let pose = self.relative(state, hand);
        let (_, rest) = hand.angle.rest.turns();
        let is_inside = pose.at.x.abs() <= R::RANGE && pose.at.y.abs() <= R::RANGE;
        // A remainder of more than a turn means more turns than can be counted.
        if !is_inside || rest.abs() > R::Si::TAU {
            log.limit(Status::Saturated);
            return None;
        }
        if hand.tilted {
            log.limit(Status::Twist);
        }
        hand.held.then_some(pose)
    }
    /// The number type can represent the pull, the turn, and the moments of both.
    fn is_representable(
        &self,
        statics: &Statics<'_, R, V, S, C>,
        body: &Body<R>,
        target: &HandPose<R>,
    ) -> bool {
        let turn = (target.angle - body.angle).abs();
        let pull = (target.at - body.holding).length_bound();
        let arm = statics.size();
        let moment = arm * (pull + arm) + statics.stiffness.of(turn);
        turn <= R::TURN && pull <= R::RANGE && moment <= R::LOAD
    }
    /// Whole turns of the body are counted apart, so that its angle keeps its digits. Returns whether the numbers have changed.
    fn unwind(&self, state: &mut State<R>, target: &HandPose<R>) -> bool {
        if state.body.angle.abs() <= R::TAU {
            return false;
        }
        let (turns, rest) = state.body.angle.turns();
        let is_at_rest = state.body.hand == *target;
        let whole = R::from_int(turns) * R::TAU;
        state.turns = state.turns.saturating_add(turns);
        state.body.angle = rest;
        state.body.rotation = Rotation::by(rest);
        state.body.hand.angle = if is_at_rest {
            target.angle - whole
        } else {
            state.body.hand.angle - whole
        };
        true
    }

    fn output(&self, state: &State<R>, log: Log<R>) -> Output<R::Si> {
        let body = &state.body;
        let units = &self.scene.units;
        let origin = body.holding - body.rotation.apply(self.scene.holding_point);
        let (turns, rest) = body.angle.turns();
        Output {
            position: [origin.x, origin.y].map(|x| x.to_si(units.length)),
            angle: Angle {
                turns: state.turns.saturating_add(turns),
                rest: rest.to_si(R::Si::ONE),
            },
            depth: state.depth,
            state: self.statics().kind(&body.contacts),
            slips: log.slips,
            longest_slip: log.longest_slip.to_si(units.length),
            status: log.status,
            work: log.evaluations,
            events: log.events,
        }
    }

    /// Force and moment of the hand's springs on the body, world frame.
    pub fn wrench(&self, state: &State<R>) -> Wrench<R::Si> {
        let body = &state.body;
        let units = &self.scene.units;
        let force = body.hand.at - body.holding;
        let turn = body.hand.angle - body.angle;
        let moment = self.scene.world.stiffness.of(turn);
        Wrench {
            force: [force.x, force.y].map(|f| f.to_si(units.force)),
            moment: moment.to_si(units.moment),
        }
    }
    /// The contacts with their reactions, in an order that is fixed as long as the state lasts; for a body that is not held without them.
    pub fn contacts(&self, state: &State<R>) -> Vec<Contact<R::Si>, MAX_CONTACTS> {
        let (body, units) = (&state.body, &self.scene.units);
        let statics = self.statics();
        let reactions = statics.reactions(body);
        let all = body.contacts.iter().zip(&reactions);
        gather(all.map(|(contact, &[n, t])| {
            let frame = statics.frame(contact, body.rotation, body.holding);
            let point = body.holding + frame.r;
            let [vertex, surface] = match contact.feature {
                Feature::Vertex { vertex, side } => [vertex, side],
                Feature::Corner { corner, body_side } => [body_side, corner],
            };
            Contact {
                vertex: usize::from(vertex),
                surface: usize::from(surface),
                point: [point.x, point.y].map(|x| x.to_si(units.length)),
                normal: n.max(R::ZERO).to_si(units.force),
                friction: t.to_si(units.force),
                sliding: contact.sense.integer(),
            }
        }))
    }
    /// What touches what, and the normals of the contacts, in the order of [`Self::contacts`].
    pub fn touches(&self, state: &State<R>) -> Vec<Touching<R::Si>, MAX_CONTACTS> {
        let (body, statics) = (&state.body, self.statics());
        gather(body.contacts.iter().map(|contact| {
            let n = statics.frame(contact, body.rotation, body.holding).n;
            Touching {
                touch: statics.touch_of(contact),
                direction: [n.x, n.y].map(|x| x.to_si(R::Si::ONE)),
            }
        }))
    }
    /// Whether the contacts have stiction.
    #[doc(hidden)]
    pub fn has_stiction(&self, state: &State<R>) -> bool {
        state.body.stiction
    }
}
