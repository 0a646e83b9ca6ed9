//! Runs the solver over a hand's motion, for any number type and any surroundings: takes samples, returns recorded frames.
//! `with_solver` chooses the type of solver that a scene needs.

mod again;
pub use again::Contacts;

use stiction_core::{Evolution, Fixed, Hand, Output, Real, SiFloat, Solver, State, narrow_hand};
use stiction_scene::{HostSolver, Indices, InputError, Sample, SceneFile};
use web_time::{Duration, Instant};

use crate::number::Number;
use crate::record::Frame;

/// A solver with the state of its run.
#[derive(Clone)]
pub struct Running<R: Real> {
    solver: HostSolver<R>,
    state: Option<State<R>>,
    indices: Option<Indices>,
}

impl<R: Real> Running<R> {
    /// Creates a run before its first hand.
    pub const fn new(solver: HostSolver<R>) -> Self {
        Self {
            solver,
            state: None,
            indices: None,
        }
    }

    /// Returns the answer to the next hand, with the solver and the state after it; the first hand starts the scene.
    pub fn step(&mut self, hand: Hand<R::Si>) -> (&HostSolver<R>, &State<R>, Output<R::Si>) {
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

impl<R: Real<Si: SiFloat>> Running<R> {
    /// Creates a run of a scene, with the budget of a frame (pieces of work).
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
    fn with<R: Shared>(self, running: Running<R>) -> Self::Done
    where
        HostSolver<R>: Send + Sync;
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
    /// The budget of a frame (pieces of work); `u32::MAX`: none.
    pub budget: u32,
}

/// Runs a task with the solver of a scene.
///
/// # Errors
/// The scene is refused.
pub fn with_solver<T: Task>(scene: &SceneFile, kind: Kind, task: T) -> Result<T::Done, InputError> {
    let Kind {
        evolution, budget, ..
    } = kind;
    Ok(match kind.number {
        Number::F32 => task.with(Running::<f32>::of(scene, evolution, budget)?),
        Number::F64 => task.with(Running::<f64>::of(scene, evolution, budget)?),
        Number::Fixed => task.with(Running::<Fixed>::of(scene, evolution, budget)?),
    })
}
