//! The solver over a hand's motion, for any number type: samples in, recorded frames out.

use std::time::{Duration, Instant};

use stiction_core::{Real, SiFloat, narrow_hand};
use stiction_scene::{HostSolver, Sample};

use crate::record::Frame;

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
    let mut state = None;
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
            let output = match &mut state {
                Some(state) => solver.step(state, hand),
                None => {
                    let (first, output) = solver.start(hand);
                    state = Some(first);
                    output
                }
            };
            outputs.extend(state.clone().map(|state| (t, state, output)));
        }
        spent += begun.elapsed();
        for (t, state, output) in outputs.drain(..) {
            sink(Frame::new(t, &solver, &state, &output))?;
        }
    }
}
