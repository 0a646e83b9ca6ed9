//! Requests to end: Ctrl-C, the system's, that of a terminal that closes. A command that listens ends as it does by itself, and keeps
//! what has come; emulators end with it. Any other one is ended at once, without the files that it has not finished.

use std::sync::atomic::{AtomicBool, Ordering};

use stiction_tools::files;

static LISTENED: AtomicBool = AtomicBool::new(false);
static ASKED: AtomicBool = AtomicBool::new(false);

/// For the beginning of the program, before it writes anything: what a request does from now on.
pub fn begin() {
    // Where somebody else listens, he decides.
    let _ = handle();
}

/// From now on requests are heard.
pub(crate) fn listen() {
    LISTENED.store(true, Ordering::Relaxed);
}

/// Somebody wants an end.
pub(crate) fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Takes a request; `end` ends the program.
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

    // `nohup` and the background of a shell have some ignored, and that is to stay so.
    let ignored = ignored();
    let heard = [SIGHUP, SIGINT, SIGTERM].into_iter();
    let heard = heard.filter(|signal| ignored & (1 << (signal - 1)) == 0);
    let mut signals = signal_hook::iterator::Signals::new(heard)?;
    std::thread::Builder::new().spawn(move || {
        for signal in signals.forever() {
            // Whoever waits for the program learns what ended it.
            request(|| drop(emulate_default_handler(signal)));
        }
    })?;
    Ok(())
}

/// The signals that were ignored when the program began, a bit for each, from 1; none where the system does not tell.
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
    // As a program does that was ended by Ctrl-C.
    ctrlc::set_handler(|| request(|| std::process::exit(130)))
}
