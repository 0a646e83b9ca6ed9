//! One turn of the solver: whether the sample is new, what the solver computes from it, and which force it demands of the servo loop.

use super::ports::{Actuators, Sample, Source};
use super::refusal::Refusal;
use super::servo::{Demand, LockServo};
use super::settings::Settings;
use super::store::Store;
use crate::safety::{Arrival, Arrivals, Debt, Flags, Health, Wanted};
use stiction_core::{
    Angle, Description, Hand, Output, Real, Scene, Solver, State, StateKind, Status, Wrench,
};

/// The pose of the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Position of the body's origin, world frame (m).
    pub position: [f32; 2],
    /// Its orientation theta, unwrapped.
    pub angle: Angle<f32>,
    /// The depth of the hand (m), passed through.
    pub depth: f32,
    /// The contact state.
    pub state: StateKind,
    /// The hand holds it.
    pub held: bool,
}

impl Pose {
    pub(super) fn of(output: &Output<f32>) -> Self {
        Self {
            position: output.position,
            angle: output.angle,
            depth: output.depth,
            state: output.state,
            held: output.held,
        }
    }
}

/// The result of a turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    /// The solver's answer, if a new sample arrived, or the body was behind the hand and went on.
    pub output: Option<Output<f32>>,
    /// The last valid pose.
    pub pose: Pose,
    /// Force (N) and moment (N·m) to the hand, world frame, within the limits.
    pub force: Wrench<f32>,
    /// Why the force has this value.
    pub flags: Flags,
    /// A fault of the device lasts: no force until everything is reset, by a new controller.
    pub latched: bool,
}

/// A run: the solver, its state after the first sample, and the last pose of the body.
#[derive(Clone, Debug)]
pub(super) struct Run<R: Real, const V: usize, const S: usize, const C: usize> {
    pub(super) store: Store<V, S, C>,
    pub(super) solver: Solver<R, V, S, C>,
    pub(super) state: Option<State<R>>,
    /// Whole turns by which the solver's angles are less than those outside.
    pub(super) turns: i32,
    pub(super) pose: Pose,
    /// The last step left work to do.
    behind: bool,
}

/// The solver of a device, and its demands on the servo loop: plain data, no hardware. V, S and M are those of the scene.
#[derive(Clone, Debug)]
pub struct Controller<R: Real, const V: usize, const S: usize, const C: usize = 0> {
    pub(super) settings: Settings,
    pub(super) run: Run<R, V, S, C>,
    pub(super) demand: Demand,
    pub(super) debt: Debt,
    arrivals: Arrivals,
    /// The force at the end of the last turn.
    pub(super) given: Wrench<f32>,
    /// At the end of the turn before.
    pub(super) former: Wrench<f32>,
    /// At the end of the last turn.
    silent: bool,
    health: Health,
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize> Run<R, V, S, C> {
    pub(super) fn new(
        description: &Description<'_, f32>,
        settings: &Settings,
    ) -> Result<Self, Refusal> {
        let solver = solver(description, settings)?;
        let store = Store::new(description).ok_or(Refusal::Unsettled(Status::Saturated))?;
        let (_, output) = solver.start(NO_HAND);
        Ok(Self {
            store,
            solver,
            state: None,
            turns: 0,
            pose: Pose::of(&output),
            behind: false,
        })
    }

    /// The body is at the start of its scene, in no hand.
    #[inline(never)]
    pub(super) fn begin(&mut self) {
        let (_, output) = self.solver.start(NO_HAND);
        self.pose = Pose::of(&output);
        (self.state, self.turns, self.behind) = (None, 0, false);
    }

    fn step(&mut self, hand: &Hand<f32>) -> Output<f32> {
        let hand = hand.turned(self.turns.saturating_neg());
        let output = match &mut self.state {
            Some(state) => self.solver.step(state, hand),
            None => {
                let (state, output) = self.solver.start(hand);
                self.state = Some(state);
                output
            }
        };
        self.accept(output)
    }

    /// Continues towards the last usable sample, if the body is behind it.
    fn go_on(&mut self) -> Option<Output<f32>> {
        let state = self.state.as_mut().filter(|_| self.behind)?;
        let hand = *state.hand();
        let output = self.solver.step(state, hand);
        Some(self.accept(output))
    }

    /// Stores the pose of the body after a step; returns the answer with the turns as seen from outside.
    pub(super) fn accept(&mut self, mut output: Output<f32>) -> Output<f32> {
        output.angle.turns = output.angle.turns.saturating_add(self.turns);
        self.pose = Pose::of(&output);
        self.behind = output.behind > 0.0;
        output
    }
}

/// No hand, a sample without usable numbers: the body stays where it is.
pub(crate) const NO_HAND: Hand<f32> = Hand {
    position: [f32::NAN; 2],
    angle: Angle {
        turns: 0,
        rest: 0.0,
    },
    depth: 0.0,
    held: false,
    tilted: false,
};

pub(super) fn solver<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize>(
    description: &Description<'_, f32>,
    settings: &Settings,
) -> Result<Solver<R, V, S, C>, Refusal> {
    let scene = Scene::new(description)?;
    settings.admit(description)?;
    Ok(settings.apply(Solver::new(scene, settings.evolution)))
}

/// Returns whether the solver held the last pose instead of computing an answer.
fn is_held_last(status: Status) -> bool {
    matches!(status, Status::Saturated | Status::HeldLast)
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize> Controller<R, V, S, C> {
    /// A device with a scene. The body starts with the first sample, at its start pose.
    ///
    /// # Errors
    /// [`Refusal`] contains what cannot be used, and what is allowed.
    pub fn new(description: &Description<'_, f32>, settings: &Settings) -> Result<Self, Refusal> {
        settings.check()?;
        Ok(Self {
            settings: *settings,
            run: Run::new(description, settings)?,
            demand: Demand::new(&settings.limits),
            debt: Debt::default(),
            arrivals: Arrivals::default(),
            given: Wrench::default(),
            former: Wrench::default(),
            silent: true,
            health: Health::default(),
        })
    }

    /// One turn, with a sample if one arrived, after one or several ticks of the servo loop: it takes the time of a tick, or longer.
    pub fn turn<D: Source + Actuators>(
        &mut self,
        sample: Option<&Sample>,
        servo: &mut impl LockServo<D>,
    ) -> Turn {
        let output = sample
            .and_then(|sample| self.take(sample))
            .or_else(|| self.go_on());
        let settled = servo.lock(|servo| servo.settle(&self.demand));
        self.demand.taken();
        self.silent = settled.flags.silent;
        if settled.flags.is_safe_state() || settled.flags.rate_limited {
            self.debt = Debt::default();
        }
        self.former = core::mem::replace(&mut self.given, settled.force);
        let Health {
            ticks,
            missed_ticks,
            silences,
            actuator_faults,
            ..
        } = settled.health;
        self.health = Health {
            ticks,
            missed_ticks,
            silences,
            actuator_faults,
            ..self.health
        };
        Turn {
            output,
            pose: self.run.pose,
            force: settled.force,
            flags: settled.flags,
            latched: settled.latched,
        }
    }

    fn take(&mut self, sample: &Sample) -> Option<Output<f32>> {
        if self.arrivals.arrive(sample.number, self.silent) == Arrival::Late {
            return None;
        }
        // A body at its start is moved by no hand yet.
        if self.run.state.is_none() {
            self.demand.grows_from = Some(0.0);
        }
        let before = self.run.state.as_ref().map(|state| *state.hand());
        let output = self.run.step(&sample.hand);
        self.health.samples = self.health.samples.saturating_add(1);
        self.demand.held_last = is_held_last(output.status);
        if self.demand.held_last {
            self.health.unusable_samples = self.health.unusable_samples.saturating_add(1);
        } else {
            self.demand.received_us = Some(sample.received_us);
            self.want(before);
        }
        Some(output)
    }

    /// Without a new sample the body continues to follow the last one, unless that one could not be used: then its pose is held.
    fn go_on(&mut self) -> Option<Output<f32>> {
        if !self.settings.goes_on || self.demand.held_last {
            return None;
        }
        let output = self.run.go_on()?;
        self.want(None);
        Some(output)
    }

    /// Records the duration of a step, in any unit: the longest one counts.
    pub fn measured(&mut self, step: u32) {
        self.health.worst_step = self.health.worst_step.max(step);
    }

    /// The counts up to the end of the last turn.
    pub fn health(&self) -> Health {
        Health {
            late_samples: self.arrivals.late,
            lost_samples: self.arrivals.lost,
            restarts: self.arrivals.restarts,
            ..self.health
        }
    }

    /// How the device runs.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The scene as it was given, with the present parameters.
    pub(crate) fn store(&self) -> &Store<V, S, C> {
        &self.run.store
    }

    /// The solver of the scene.
    pub fn solver(&self) -> &Solver<R, V, S, C> {
        &self.run.solver
    }

    /// The state of the run; `None` before the first sample.
    pub fn state(&self) -> Option<&State<R>> {
        self.run.state.as_ref()
    }

    /// Restarts everything: the body at the start pose of its scene, the force zero immediately. Counters continue.
    pub fn reset(&mut self) {
        let store = &self.run.store;
        // It was checked when it was accepted.
        if let Ok(run) = store.with_given(|given| Run::new(given, &self.settings)) {
            self.run = run;
        }
        self.let_go();
    }
    /// The force is zero immediately.
    pub(super) fn let_go(&mut self) {
        self.demand.wanted = Wanted::default();
        self.debt = Debt::default();
        self.demand.held_last = false;
        self.demand.cut = true;
    }
}
