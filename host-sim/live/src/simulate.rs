//! Runs the solver over a hand's motion, for any number type and any surroundings: takes samples, returns recorded frames.
//! `with_solver` chooses the type of solver that a scene needs.

mod again;
pub use again::Contacts;

use stiction_core::{
    Evolution, Fixed, Full, Hand, Model, Output, Real, SiFloat, Solver, State, narrow_hand,
};
use stiction_scene::{Among, HostSolver, Indices, InputError, Sample, SceneFile};
use web_time::{Duration, Instant};

use crate::number::Number;
use crate::record::Frame;

/// A solver with the state of its run.
#[derive(Clone)]
pub struct Running<R: Real, M: Model = Full> {
    solver: HostSolver<R, M>,
    state: Option<State<R>>,
    indices: Option<Indices>,
}

impl<R: Real, M: Model> Running<R, M> {
    /// Creates a run before its first hand.
    pub const fn new(solver: HostSolver<R, M>) -> Self {
        Self {
            solver,
            state: None,
            indices: None,
        }
    }

    /// Returns the answer to the next hand, with the solver and the state after it; the first hand starts the scene.
    pub fn step(&mut self, hand: Hand<R::Si>) -> (&HostSolver<R, M>, &State<R>, Output<R::Si>) {
        let solver = &self.solver;
        let mut started = None;
        let state = self.state.get_or_insert_with(|| {
            let (state, output) = solver.start(hand);
            started = Some(output);
            state
        });
        let output = started.unwrap_or_else(|| solver.step(state, hand));
        (solver, state, output)
    }
}

impl<R: Real<Si: SiFloat>, M: Model> Running<R, M> {
    /// Creates a run of a scene, with the budget of a frame (units of work).
    ///
    /// # Errors
    /// The scene is refused.
    pub fn of(scene: &SceneFile, evolution: Evolution, budget: u32) -> Result<Self, InputError> {
        let (scene, indices) = scene.written.scene_in()?;
        Ok(Self {
            indices,
            ..Self::new(Solver::new(scene, evolution).with_budget(budget))
        })
    }

    /// Returns the frame of the next sample.
    pub fn frame(&mut self, sample: &Sample) -> Frame {
        let (solver, state, output) = self.step(narrow_hand(&sample.hand));
        let frame = Frame::new(sample.t, solver, state, &output);
        frame.with_indices(self.indices.as_ref())
    }

    /// Steps through `samples` and passes every frame to `sink`. Returns the time that the solver's steps took, without `sink`.
    ///
    /// # Errors
    /// The first error of `sink`.
    pub fn simulate<E>(
        mut self,
        samples: impl Iterator<Item = Sample>,
        mut sink: impl FnMut(Frame) -> Result<(), E>,
    ) -> Result<Duration, E> {
        let mut samples = samples.map(|sample| (sample.t, narrow_hand(&sample.hand)));
        let mut batch = Vec::with_capacity(BATCH);
        let mut outputs = Vec::with_capacity(BATCH);
        let mut spent = Duration::ZERO;
        loop {
            batch.extend(samples.by_ref().take(BATCH));
            if batch.is_empty() {
                return Ok(spent);
            }
            let begun = Instant::now();
            for (t, hand) in batch.drain(..) {
                let (_, state, output) = self.step(hand);
                outputs.push((t, state.clone(), output));
            }
            spent += begun.elapsed();
            for (t, state, output) in outputs.drain(..) {
                let frame = Frame::new(t, &self.solver, &state, &output);
                sink(frame.with_indices(self.indices.as_ref()))?;
            }
        }
    }
}

/// Number of steps timed together, so that the cost of the clock is negligible.
const BATCH: usize = 64;

/// A task for a solver of any type.
pub trait Task {
    /// Result of the task.
    type Done;
    /// Runs the task.
    fn with<R: Shared, M: Model>(self, running: Running<R, M>) -> Self::Done
    where
        HostSolver<R, M>: Send + Sync;
}

/// A number type of the solver that threads can share.
pub trait Shared: Real<Si: SiFloat + Send + Sync> + Send + Sync {}

impl<R: Real<Si: SiFloat + Send + Sync> + Send + Sync> Shared for R {}

/// What may be chosen of a solver.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// The number type.
    pub number: Number,
    /// The evolution within a frame.
    pub evolution: Evolution,
    /// The budget of a frame (units of work); `u32::MAX`: none.
    pub budget: u32,
}

/// Runs a task with the solver that a scene needs: with obstacles only if the scene has some.
///
/// # Errors
/// The scene is refused.
pub fn with_solver<T: Task>(scene: &SceneFile, kind: Kind, task: T) -> Result<T::Done, InputError> {
    match kind.number {
        Number::F32 => with_model::<f32, T>(scene, kind, task),
        Number::F64 => with_model::<f64, T>(scene, kind, task),
        Number::Fixed => with_model::<Fixed, T>(scene, kind, task),
    }
}

/// Whether the solver with obstacles is built in.
pub const OBSTACLES: bool = cfg!(feature = "obstacles");

/// Checks that the solver of a scene is built in.
///
/// # Errors
/// It has obstacles, and the feature `obstacles` is off.
pub fn has_solver(scene: &SceneFile) -> Result<(), InputError> {
    if OBSTACLES || scene.obstacles.is_empty() {
        return Ok(());
    }
    let problem = "a scene with obstacles, allowed in this build: one without";
    Err(scene.source().error(problem))
}

fn with_model<R: Shared, T: Task>(
    scene: &SceneFile,
    kind: Kind,
    task: T,
) -> Result<T::Done, InputError>
where
    Running<R, Full>: Send + Sync,
    Running<R, Among>: Send + Sync,
{
    has_solver(scene)?;
    let Kind {
        evolution, budget, ..
    } = kind;
    Ok(if !OBSTACLES || scene.obstacles.is_empty() {
        task.with(Running::<R, Full>::of(scene, evolution, budget)?)
    } else {
        task.with(Running::<R, Among>::of(scene, evolution, budget)?)
    })
}
