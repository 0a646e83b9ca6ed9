//! A long run on two threads: the solver steps on one; the other prepares its samples and records its answers. Contacts take longer than
//! a step and are not always wanted: they are made of the states, when they are asked for.

use std::panic::resume_unwind;
use std::sync::mpsc;
use std::thread;

use stiction_core::{Hand, Output, State, narrow_hand};
use stiction_scene::{HostModel, HostSolver, Indices, Sample};

use super::{Running, Shared, answer};
use crate::record::{ContactRecord, Frame, rename, set_contacts};

/// So many samples go from thread to thread together: what a thread waits for another one is then little beside their steps, and
/// two batches stay in the cache of a core.
const BATCH: usize = 512;
/// One that is stepped through, one that is recorded, and one that waits.
const BATCHES: usize = 3;

/// Samples on their way to the solver, or answers on their way back.
struct Batch<R: Shared> {
    samples: Vec<(f64, Hand<R::Si>)>,
    outputs: Vec<(f64, Output<R::Si>)>,
    states: Vec<State<R>>,
}

impl<R: Shared> Batch<R> {
    fn new() -> Self {
        Self {
            samples: Vec::with_capacity(BATCH),
            outputs: Vec::with_capacity(BATCH),
            states: Vec::with_capacity(BATCH),
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
            self.states.push(state.clone());
            self.outputs.push((t, output));
        }
        self
    }
}

/// The states of a run, for the contacts in them.
struct States<R: Shared, M: HostModel> {
    solver: HostSolver<R, M>,
    indices: Option<Indices>,
    batches: Vec<Vec<State<R>>>,
}

/// The contacts of a run, not yet made.
pub trait Contacts: Send + Sync {
    /// Gives those of every frame, in their order.
    fn each(&self, take: &mut dyn FnMut(&[ContactRecord]));
}

impl<R: Shared, M: HostModel> Contacts for States<R, M>
where
    HostSolver<R, M>: Send + Sync,
{
    fn each(&self, take: &mut dyn FnMut(&[ContactRecord])) {
        let mut contacts = Vec::new();
        for state in self.batches.iter().flatten() {
            set_contacts(&mut contacts, &self.solver, state);
            rename(&mut contacts, self.indices.as_ref());
            take(&contacts);
        }
    }
}

impl<R: Shared, M: HostModel> Running<R, M>
where
    HostSolver<R, M>: Send + Sync,
{
    /// Steps through `samples` and gives every frame, without its contacts, to `take`, both on a thread of their own.
    pub(crate) fn pipeline(
        &mut self,
        samples: &mut (dyn Iterator<Item = Sample> + Send),
        take: &mut (dyn FnMut(&Frame) + Send),
    ) -> Box<dyn Contacts> {
        let (solver, state) = (&self.solver, &mut self.state);
        let (to_solver, batches) = mpsc::channel();
        let (to_record, answered) = mpsc::channel();
        let record = move || {
            let mut samples = samples.fuse();
            let mut frame = Frame::default();
            let mut under_way = 0;
            let mut empty: Vec<_> = (0..BATCHES).map(|_| Batch::new()).collect();
            let mut all = Vec::new();
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
                    return all;
                }
                let Ok(mut batch): Result<Batch<R>, _> = answered.recv() else {
                    return all;
                };
                under_way -= 1;
                for ((t, output), state) in batch.outputs.drain(..).zip(&batch.states) {
                    frame = frame.renewed(t, solver, state, &output);
                    take(&frame);
                }
                all.push(batch.states);
                batch.states = Vec::with_capacity(BATCH);
                empty.push(batch);
            }
        };
        let batches = thread::scope(move |scope| {
            let record = scope.spawn(record);
            for batch in batches {
                let _ = to_record.send(batch.answered(solver, state));
            }
            drop(to_record);
            record.join()
        });
        Box::new(States {
            solver: self.solver.clone(),
            indices: self.indices.clone(),
            batches: batches.unwrap_or_else(|panic| resume_unwind(panic)),
        })
    }
}
