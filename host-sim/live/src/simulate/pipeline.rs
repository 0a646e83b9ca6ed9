//! A long run on two threads: the solver steps on one; the other prepares its samples and records its answers.

use std::sync::mpsc;
use std::thread;

use stiction_core::{Hand, Output, State, narrow_hand};
use stiction_scene::{HostModel, HostSolver, Sample};

use super::{Running, Shared, answer};
use crate::record::Frame;

/// So many samples go from thread to thread together: what a thread waits for another one is then little beside their steps, and
/// two batches stay in the cache of a core.
const BATCH: usize = 512;
/// One that is stepped through, one that is recorded, and one that waits.
const BATCHES: usize = 3;

/// Samples on their way to the solver, or answers on their way back.
struct Batch<R: Shared> {
    samples: Vec<(f64, Hand<R::Si>)>,
    answers: Vec<(f64, State<R>, Output<R::Si>)>,
}

impl<R: Shared> Batch<R> {
    fn new() -> Self {
        Self {
            samples: Vec::with_capacity(BATCH),
            answers: Vec::with_capacity(BATCH),
        }
    }

    /// With the next samples; `None` after the last one.
    fn filled(mut self, samples: &mut dyn Iterator<Item = Sample>) -> Option<Self> {
        let narrow = |sample: Sample| (sample.t, narrow_hand(&sample.hand));
        self.samples.extend(samples.take(BATCH).map(narrow));
        (!self.samples.is_empty()).then_some(self)
    }

    /// With the answers of the solver.
    fn answered<M: HostModel>(
        mut self,
        solver: &HostSolver<R, M>,
        state: &mut Option<State<R>>,
    ) -> Self {
        for (t, hand) in self.samples.drain(..) {
            let (state, output) = answer(solver, state, hand);
            self.answers.push((t, state.clone(), output));
        }
        self
    }
}

impl<R: Shared, M: HostModel> Running<R, M>
where
    HostSolver<R, M>: Send + Sync,
{
    /// Steps through `samples` and gives every frame to `take`, both on a thread of their own.
    pub(crate) fn pipeline(
        &mut self,
        samples: &mut (dyn Iterator<Item = Sample> + Send),
        take: &mut (dyn FnMut(&Frame) + Send),
    ) {
        let (solver, state) = (&self.solver, &mut self.state);
        let indices = self.indices.as_ref();
        let (to_solver, batches) = mpsc::channel();
        let (to_record, answered) = mpsc::channel();
        let record = move || {
            let mut samples = samples.fuse();
            let mut frame = Frame::default();
            let mut under_way = 0;
            let mut empty: Vec<_> = (0..BATCHES).map(|_| Batch::new()).collect();
            loop {
                let full = empty
                    .drain(..)
                    .filter_map(|batch| batch.filled(&mut samples));
                for batch in full {
                    // Not heard where the other thread has panicked, as in `recv`.
                    let _ = to_solver.send(batch);
                    under_way += 1;
                }
                if under_way == 0 {
                    return;
                }
                let Ok(mut batch): Result<Batch<R>, _> = answered.recv() else {
                    return;
                };
                under_way -= 1;
                for (t, state, output) in &batch.answers {
                    frame = frame
                        .renewed(*t, solver, state, output)
                        .with_indices(indices);
                    take(&frame);
                }
                batch.answers.clear();
                empty.push(batch);
            }
        };
        thread::scope(move |scope| {
            scope.spawn(record);
            for batch in batches {
                let _ = to_record.send(batch.answered(solver, state));
            }
        });
    }
}
