//! Ctrl-C ends what lasts as its own end does: emulators end with it, and what has come is kept.

use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C, and the request of the system to end, are heard.
pub(crate) fn listen() {
    // Where somebody else listens, he decides.
    let _ = ctrlc::set_handler(|| ASKED.store(true, Ordering::Relaxed));
}

/// Somebody wants an end.
pub(crate) fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}
