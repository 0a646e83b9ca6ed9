//! Runs jobs on all threads, with results in the order of the jobs: from job numbers to a sink that receives them one by one.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::sync_channel;

use rayon::ThreadPool;

/// Jobs per thread that are running or waiting: at most this number of results waits for an earlier one.
pub(super) const AHEAD: usize = 8;

/// Runs `jobs` on the threads of `pool` and passes the results to `sink`, in order, as soon as they are available. It ends early
/// if `work` returns nothing: all results before that job have then been passed.
pub(super) fn in_order<T: Send, E>(
    pool: &ThreadPool,
    mut jobs: Range<u64>,
    work: impl Fn(u64) -> Option<T> + Sync,
    mut sink: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    let (over, work) = (AtomicBool::new(false), &work);
    let over = &over;
    pool.in_place_scope_fifo(|scope| {
        let mut waiting = VecDeque::new();
        loop {
            let room = AHEAD * pool.current_num_threads() - waiting.len();
            for job in jobs.by_ref().take(room) {
                let (sender, receiver) = sync_channel(1);
                scope.spawn_fifo(move |_| {
                    let result = (!over.load(Ordering::Relaxed)).then(|| work(job));
                    // Nobody listens once it is over.
                    let _ = sender.send(result.flatten());
                });
                waiting.push_back(receiver);
            }
            let next = waiting.pop_front().and_then(|first| first.recv().ok());
            let Some(result) = next.flatten() else {
                over.store(true, Ordering::Relaxed);
                return Ok(());
            };
            if let Err(error) = sink(result) {
                over.store(true, Ordering::Relaxed);
                return Err(error);
            }
        }
    })
}
