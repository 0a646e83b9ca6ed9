//! A time limit and a net for panics, so that one scene that loops or panics does not hide the others.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// What became of a piece of work.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome<T> {
    /// It is done.
    Done(T),
    /// It panicked, with these words.
    Panic(String),
    /// It took longer than the limit; its thread goes on until the process ends.
    Late,
}

/// Runs a piece of work in a thread of its own.
pub fn within<T: Send + 'static>(
    limit: Duration,
    work: impl FnOnce() -> T + Send + 'static,
) -> Outcome<T> {
    let (send, receive) = mpsc::channel();
    let spawned = thread::Builder::new().stack_size(16 << 20).spawn(move || {
        // Nobody listens any more where it was late.
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

/// What a piece of work gives, or the words of its panic.
///
/// # Errors
/// The words of the panic.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|thrown| {
        let words = thrown.downcast_ref::<String>().cloned();
        let words = words.or_else(|| thrown.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        words.unwrap_or_else(|| "a panic without words".to_owned())
    })
}
