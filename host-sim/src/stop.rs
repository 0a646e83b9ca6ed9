//! Requests to end: Ctrl-C, the system's, that of a closing terminal. A command that listens ends normally, and keeps its
//! results; emulators end with it. Any other command is ended immediately, and its unfinished files are removed.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::files::whole as files;

static LISTENED: AtomicBool = AtomicBool::new(false);
static ASKED: AtomicBool = AtomicBool::new(false);

/// Installs the handling of requests; called at the start of the program, before it writes anything.
pub(crate) fn begin() {
    // If another part of the program listens, it decides.
    let _ = handle();
}

/// From now on, the command listens for requests.
pub(crate) fn listen() {
    LISTENED.store(true, Ordering::Relaxed);
}

pub(crate) fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Processes a request; `end` ends the program.
fn request(end: impl FnOnce()) {
    if LISTENED.load(Ordering::Relaxed) {
        ASKED.store(true, Ordering::Relaxed);
    } else {
        files::discard();
        end();
    }
}

#[cfg(unix)]
fn handle() -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::low_level::emulate_default_handler;

    // `nohup` and the background of a shell ignore some signals; these remain ignored.
    let ignored = ignored();
    let signals = [SIGHUP, SIGINT, SIGTERM].into_iter();
    let signals = signals.filter(|signal| ignored & (1 << (signal - 1)) == 0);
    let mut signals = signal_hook::iterator::Signals::new(signals)?;
    std::thread::Builder::new().spawn(move || {
        for signal in signals.forever() {
            // The parent process learns which signal ended it.
            request(|| drop(emulate_default_handler(signal)));
        }
    })?;
    Ok(())
}

/// The signals that were ignored when the program began, a bit for each, from 1; none if the system does not report them.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.unwrap_or_default()
}

#[cfg(not(unix))]
fn handle() -> Result<(), ctrlc::Error> {
    // The status of a program that was ended by Ctrl-C.
    ctrlc::set_handler(|| request(|| std::process::exit(130)))
}
