//! A time limit and a panic guard, so that one scene that loops or panics does not hide the others.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// The outcome of a task.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome<T> {
    /// It finished.
    Done(T),
    /// It panicked with this message.
    Panic(String),
    /// It took longer than the limit; its thread goes on until the process ends.
    Late,
}

/// Runs a task in its own thread.
pub fn within<T: Send + 'static>(
    limit: Duration,
    work: impl FnOnce() -> T + Send + 'static,
) -> Outcome<T> {
    let (send, receive) = mpsc::channel();
    let spawned = thread::Builder::new().stack_size(16 << 20).spawn(move || {
        // After the deadline, nobody receives the result.
        let _ = send.send(caught(work));
    });
    if let Err(error) = spawned {
        return Outcome::Panic(error.to_string());
    }
    match receive.recv_timeout(limit) {
        Ok(Ok(done)) => Outcome::Done(done),
        Ok(Err(words)) => Outcome::Panic(words),
        Err(_) => Outcome::Late,
    }
}

/// The result of a task, or the message of its panic.
fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|thrown| {
        let words = thrown.downcast_ref::<String>().cloned();
        let words = words.or_else(|| thrown.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        words.unwrap_or_else(|| "a panic without a message".to_owned())
    })
}
