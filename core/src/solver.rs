//! 5: one step: hand -> contacts -> state -> transition -> output.

use crate::contact::Regime;
use crate::detect::Placed;
use crate::event::{Event, Status};
use crate::geometry::{Angle, Vec2};
use crate::grip::Grip;
use crate::hand::Hand;
use crate::hold::Hold;
use crate::log::Log;
use crate::model::{Full, Model};
use crate::obstacle::Obstacles;
use crate::output::Output;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::scene::Scene;
use crate::state::{ContactState, Free};
use crate::work::{Work, least, least_among};

mod answer;
mod evolution;
mod evolve;

pub use evolution::Evolution;
use evolve::{Course, Errand};

/// The solver of one scene. It holds no state of a run: one solver serves any number of runs.
///
/// ```
/// # use stiction_core::{Description, Scene, SurfaceDescription};
/// use stiction_core::{Evolution, Hand, Solver, Status};
///
/// # let scene: Scene<f32, 4, 1> = Scene::new(&Description {
/// #     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
/// #     start: [0.0, 0.03, 0.0],
/// #     weight: 0.0,
/// #     holding_point: Some([0.0, 0.02]),
/// #     reach: 0.0,
/// #     stiffness_translation: 500.0,
/// #     stiffness_rotation: 0.5,
/// #     surfaces: &[SurfaceDescription {
/// #         normal: [0.0, 1.0],
/// #         offset: 0.0,
/// #         friction_static: 0.5,
/// #         friction_dynamic: 0.3,
/// #         memory: None,
/// #     }],
/// #     obstacles: &[],
/// # })?;
/// let exact = Solver::new(scene.clone(), Evolution::Path);
/// let bounded = Solver::new(scene, Evolution::Path).with_budget(400);
///
/// // Pressed 10 mm down, dragged by 0.1 m in one frame: 48 slips. The bounded solver does as many as its
/// // budget permits.
/// let (mut state, _) = exact.start(Hand::new(0.0, 0.04, 0.0));
/// let mut twin = state.clone();
/// let hand = Hand::new(0.1, 0.04, 0.0);
/// let all = exact.step(&mut state, hand);
/// let some = bounded.step(&mut twin, hand);
/// assert_eq!((all.slips, all.status), (48, Status::Ok));
/// assert!(some.slips < 48 && some.work <= 400);
/// assert_eq!(some.status, Status::Behind);
///
/// // With the same sample it goes on from there, to the same bits.
/// while bounded.step(&mut twin, hand).behind > 0.0 {}
/// assert_eq!(twin, state);
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Solver<R: Real, const V: usize, const S: usize, M: Model = Full> {
    scene: Scene<R, V, S, M>,
    evolution: Evolution,
    budget: u32,
}

/// The state of a run: plain data, at most 256 bytes in every number type. A copy of it is a snapshot; assigned back, the run repeats bit
/// for bit, on every machine. It belongs to the scene of the solver that created it.
///
/// ```
/// # use stiction_core::{Description, Scene, SurfaceDescription};
/// use stiction_core::{Evolution, Hand, Solver};
///
/// # let scene: Scene<f32, 4, 1> = Scene::new(&Description {
/// #     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
/// #     start: [0.0, 0.03, 0.0],
/// #     weight: 0.0,
/// #     holding_point: Some([0.0, 0.02]),
/// #     reach: 0.0,
/// #     stiffness_translation: 500.0,
/// #     stiffness_rotation: 0.5,
/// #     surfaces: &[SurfaceDescription {
/// #         normal: [0.0, 1.0],
/// #         offset: 0.0,
/// #         friction_static: 0.5,
/// #         friction_dynamic: 0.3,
/// #         memory: None,
/// #     }],
/// #     obstacles: &[],
/// # })?;
/// let solver = Solver::new(scene, Evolution::Path);
/// let (mut state, _) = solver.start(Hand::new(0.0, 0.04, 0.0));
///
/// let snapshot = state.clone();
/// let mut drag = |x| solver.step(&mut state, Hand::new(x, 0.04, 0.1));
/// let first = [drag(0.01), drag(0.02)];
///
/// state = snapshot;
/// let mut drag = |x| solver.step(&mut state, Hand::new(x, 0.04, 0.1));
/// assert_eq!([drag(0.01), drag(0.02)], first);
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct State<R: Real> {
    contact: ContactState<R>,
    grip: Grip<R>,
    /// phi - theta at which the rotational spring rests.
    rest_offset: Angle<R>,
    held: bool,
    hold: Hold,
    hand: Hand<R::Si>,
    /// Why the pose is not a balance: this belongs to the grip, not to the frame, and is therefore reported until the hand moves.
    unrest: Status,
    errand: Errand<R>,
    course: Course,
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

    /// A body that is not held now was held in this way.
    pub(crate) fn keep_hold(&mut self, hold: Hold) {
        if self.hold == Hold::Never {
            self.hold = hold;
        }
    }
}

impl<R: Real, const V: usize, const S: usize, M: Model> Solver<R, V, S, M> {
    /// A solver for a scene. Its steps do as much work as is needed.
    pub const fn new(scene: Scene<R, V, S, M>, evolution: Evolution) -> Self {
        Self {
            scene,
            evolution,
            budget: u32::MAX,
        }
    }

    /// This solver with an evolution; an existing state remains valid.
    #[must_use]
    pub fn with_evolution(mut self, evolution: Evolution) -> Self {
        self.evolution = evolution;
        self
    }

    /// With this budget or a larger one no step exceeds its budget, with at most three simultaneous contacts, in units of work: a failed
    /// certified frame and the most expensive piece. Taking hold of the body is not counted.
    pub const LEAST_BUDGET: u32 = if <M::Obstacles<R, V> as Obstacles<R>>::CORNERS {
        least_among(V, <M::Obstacles<R, V> as Obstacles<R>>::CAPACITY)
    } else {
        least(S > 1)
    };

    /// A bound on the work of a step, in units of about one evaluation of the motion of a contact (the README says what a unit costs). A
    /// step takes no more: the body stays behind the hand, the status is [`Status::Behind`], and the next step goes on from there. Repeated
    /// with the same sample until [`Output::behind`] is 0, it ends in the same bits as one step without a budget; with a new sample the
    /// hand's path leads straight from where the body stands. A step does at least one piece of work: with a budget below
    /// [`Self::LEAST_BUDGET`] a single one may take more.
    #[must_use]
    pub fn with_budget(mut self, units: u32) -> Self {
        self.budget = units;
        self
    }

    /// The budget of a step, in units of work; `u32::MAX` without one.
    pub fn budget(&self) -> u32 {
        self.budget
    }

    /// Starts a run and returns its first answer: the equilibrium reached from the scene's start pose with the hand at its first pose. A
    /// hand that is not finite or out of range counts as absent: the body stays at its start until a usable one takes hold; it also does so
    /// while the hand's switch is off.
    pub fn start(&self, hand: Hand<R::Si>) -> (State<R>, Output<R::Si>) {
        let (mut work, mut log) = (Work::within(self.budget), Log::default());
        let mut state = self.placed_at_start();
        if let Some(target) = self.usable(&hand, &mut log) {
            state.hand = hand;
            if hand.held {
                self.take_hold(&mut state, target, (&mut work, &mut log));
            }
        }
        let output = self.output(&state, (work, log));
        (state, output)
    }

    /// One frame: the hand moves to its new pose and the body follows. It never fails. A sample that cannot be used leaves the body as it
    /// is, and the status reports it: [`Status::HeldLast`] for one that is not finite, [`Status::Saturated`] for one beyond the range of
    /// the number type. The next usable sample is followed from the last usable one.
    pub fn step(&self, state: &mut State<R>, hand: Hand<R::Si>) -> Output<R::Si> {
        let (mut work, mut log) = (Work::within(self.budget), Log::default());
        if let Some(target) = self.usable(&hand, &mut log) {
            let again = hand == state.hand;
            // The path of a hand that takes hold begins where it takes hold.
            let was_held = state.held;
            self.switch(state, &hand, target, (&mut work, &mut log));
            if !was_held || self.go_to(state, (target, again), (&mut work, &mut log)) {
                state.hand = hand;
            } else {
                log.limit(Status::Saturated);
            }
        }
        self.output(state, (work, log))
    }

    /// p_h / L and phi of a sample. The log records why a sample cannot be used, and that its twist is not known.
    fn usable(&self, hand: &Hand<R::Si>, log: &mut Log<R>) -> Option<(Vec2<R>, Angle<R>)> {
        let position: Vec2<R> = self.scene.units.point_from_si(hand.position);
        let (turns, rest) = hand.angle.rest.turns();
        // Also false for NaN; a remainder of more than a turn means more turns than can be counted.
        let is_usable = position.x.abs() <= R::RANGE
            && position.y.abs() <= R::RANGE
            && rest.abs() <= R::Si::TAU
            && hand.depth.is_finite();
        if !is_usable {
            log.limit(if hand.is_finite() {
                Status::Saturated
            } else {
                Status::HeldLast
            });
            return None;
        }
        if hand.tilted {
            log.limit(Status::Twist);
        }
        let angle = Angle {
            turns: hand.angle.turns.saturating_add(turns),
            rest: R::from_si(rest, R::Si::ONE),
        };
        Some((position, angle))
    }

    /// The body at its start pose, seated on the surfaces that it touches.
    fn placed_at_start(&self) -> State<R> {
        let pose = self.scene.start;
        let placed = Placed::at(&pose);
        let touching = placed.seats(&self.scene, Scene::<R, V, S, M>::start_tolerance());
        let contact = match touching.split_first() {
            None => ContactState::Free(Free::new(pose)),
            Some((&first, others)) => {
                let pivot = Pivot::at(&self.scene, &pose, first);
                ContactState::seated(&self.scene, pivot, others)
            }
        };
        State {
            contact,
            grip: Grip::default(),
            rest_offset: Angle::default(),
            held: false,
            hold: Hold::Never,
            hand: Hand::default(),
            unrest: Status::Ok,
            errand: Errand::NONE,
            course: Course::NEW,
        }
    }

    /// Grasp and release by the hold switch.
    fn switch(
        &self,
        state: &mut State<R>,
        hand: &Hand<R::Si>,
        target: (Vec2<R>, Angle<R>),
        (work, log): (&mut Work, &mut Log<R>),
    ) {
        if state.held && !hand.held {
            state.held = false;
            (state.errand, state.course) = (Errand::NONE, Course::NEW);
            log.event(Event::Release);
        } else if !state.held && hand.held {
            self.take_hold(state, target, (work, log));
        }
    }

    /// Takes hold where the hand is, if it can, and comes to rest there.
    fn take_hold(
        &self,
        state: &mut State<R>,
        target: (Vec2<R>, Angle<R>),
        (work, log): (&mut Work, &mut Log<R>),
    ) {
        if self.grasp(state, target, log) {
            self.settle(state, (work, log));
        }
    }

    /// Takes hold where the hand is, if within reach; the first time at the scene's holding point, if it defines one. Returns true if it
    /// takes hold. A call of its own: its working data is off the stack while the body comes to rest.
    #[inline(never)]
    fn grasp(
        &self,
        state: &mut State<R>,
        (position, angle): (Vec2<R>, Angle<R>),
        log: &mut Log<R>,
    ) -> bool {
        let pose = state.contact.pose(&self.scene);
        let given = (self.scene.holding_point).filter(|_| state.hold == Hold::Never);
        let (holding_point, rest_offset) = match given {
            Some(point) => (point, Angle::default()),
            None => {
                let at = pose.orientation.rotation().undo(position - pose.position);
                if self.scene.body.distance(at) > self.scene.reach {
                    return false;
                }
                (at, angle.offset_from(pose.orientation.angle()))
            }
        };
        let grip = Grip {
            holding_point,
            hand: position,
            angle: angle.offset_from(rest_offset),
        };
        if !state.contact.can_be_held(&self.scene, &grip) {
            log.limit(Status::Saturated);
            return false;
        }
        state.hold = if given.is_none() {
            log.event(Event::Grasp);
            Hold::Taken
        } else {
            Hold::Given
        };
        state.held = true;
        state.rest_offset = rest_offset;
        state.grip = grip;
        state.contact.set_regime(Regime::LOOSE);
        state.contact.press(&self.scene, &state.grip);
        true
    }
}

#[cfg(test)]
mod tests;
