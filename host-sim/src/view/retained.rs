//! Holds the solver's large data, uploaded paths and recordings, until no other owner is left. Thus the solver's thread never
//! frees the memory, which takes the system some milliseconds.

use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};

/// The data that is held.
#[derive(Debug, Default)]
pub(super) struct Retained(Mutex<Vec<Arc<dyn Any + Send + Sync>>>);

impl Retained {
    /// Adds data, once.
    pub(super) fn keep(&self, large: Arc<dyn Any + Send + Sync>) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if !all.iter().any(|known| Arc::ptr_eq(known, &large)) {
            all.push(large);
        }
    }

    /// Drops data without another owner.
    pub(super) fn tidy(&self) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // It can be reached only through counted references.
        all.retain(|large| Arc::strong_count(large) > 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::{Sender, channel};
    use std::thread::{self, ThreadId};

    /// Reports which thread drops it.
    struct Large(Sender<ThreadId>);

    impl Drop for Large {
        fn drop(&mut self) {
            let _ = self.0.send(thread::current().id());
        }
    }

    #[test]
    fn what_the_solver_lets_go_is_dropped_by_another_thread() {
        let (dropped, lost) = channel();
        let (retained, large) = (Retained::default(), Arc::new(Large(dropped)));
        retained.keep(Arc::clone(&large) as _);
        retained.keep(Arc::clone(&large) as _);
        retained.tidy();
        assert!(lost.try_recv().is_err(), "the solver has it");
        let solver = thread::spawn(move || drop(large));
        solver.join().expect("it ends");
        assert!(lost.try_recv().is_err(), "it is held");
        retained.tidy();
        assert_eq!(lost.try_recv(), Ok(thread::current().id()));
    }
}
