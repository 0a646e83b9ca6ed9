//! The solver over a hand's motion, for any number type: samples in, recorded frames out.

use std::time::{Duration, Instant};

use stiction_core::{Full, Hand, Model, Output, Real, SiFloat, State, narrow_hand};
use stiction_scene::{HostSolver, Sample};

use crate::record::Frame;

/// A solver with the state of its run.
pub(crate) struct Running<R: Real, M: Model = Full> {
    solver: HostSolver<R, M>,
    state: Option<State<R>>,
}

impl<R: Real, M: Model> Running<R, M> {
    /// Before its first hand.
    pub(crate) const fn new(solver: HostSolver<R, M>) -> Self {
        Self {
            solver,
            state: None,
        }
    }

    /// The answer to the next hand, with the solver and the state after it; the first hand starts the scene.
    pub(crate) fn step(
        &mut self,
        hand: Hand<R::Si>,
    ) -> (&HostSolver<R, M>, &State<R>, Output<R::Si>) {
        let mut started = None;
        let state = self.state.get_or_insert_with(|| {
            let (state, output) = self.solver.start(hand);
            started = Some(output);
            state
        });
        let output = started.unwrap_or_else(|| self.solver.step(state, hand));
        (&self.solver, state, output)
    }
}

/// So many steps are timed together, so that the clock costs nothing beside them.
const BATCH: usize = 64;

/// Steps through `samples` and gives every frame to `sink`. Returns the time that the solver's steps took; `sink` is not
/// in it.
///
/// # Errors
/// The first error of `sink`.
pub fn simulate<R: Real, E>(
    solver: HostSolver<R>,
    samples: impl Iterator<Item = Sample>,
    mut sink: impl FnMut(Frame) -> Result<(), E>,
) -> Result<Duration, E>
where
    R::Si: SiFloat,
{
    let mut running = Running::new(solver);
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
            let (_, state, output) = running.step(hand);
            outputs.push((t, state.clone(), output));
        }
        spent += begun.elapsed();
        for (t, state, output) in outputs.drain(..) {
            sink(Frame::new(t, &running.solver, &state, &output))?;
        }
    }
}
