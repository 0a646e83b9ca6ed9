//! `stiction view` as its clients meet it: over the socket, over HTTP, over UDP. No verdict hangs on how fast anything is.

#[cfg(unix)]
mod boards;
mod first;
mod messages;
mod obstacles;
mod outward;
mod paths;
#[cfg(unix)]
mod plugged;
mod program;
mod recordings;
mod refusals;
mod several;
#[cfg(unix)]
pub(crate) mod station;
mod written;
