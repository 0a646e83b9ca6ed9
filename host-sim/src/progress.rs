//! The progress of a command, on standard error: an animation on a terminal, with the time elapsed; elsewhere a line at the
//! beginning and at the end of each part.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};

use crate::report;

/// The interval at which the time elapsed is updated while nothing else happens.
const TICK: Duration = Duration::from_millis(200);

/// A bar of indicatif's `template`.
pub(crate) fn bar(length: u64, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template);
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length).with_style(style)
}

/// Work of unknown duration, such as a build. It ends with [`Activity::end`], or silently if an error ends it.
#[derive(Debug)]
pub(crate) struct Activity {
    what: String,
    begun: Instant,
    bar: ProgressBar,
}

impl Activity {
    /// Begins.
    pub(crate) fn begin(what: String) -> Self {
        let bar = ProgressBar::no_length();
        let style = ProgressStyle::with_template("{spinner} {msg}, {elapsed}");
        let style = style.unwrap_or_else(|_| ProgressStyle::default_spinner());
        let bar = bar.with_style(style).with_message(what.clone());
        match io::stderr().is_terminal() {
            true => bar.enable_steady_tick(TICK),
            false => report::tell(format_args!("{what} ...")),
        }
        let begun = Instant::now();
        Self { what, begun, bar }
    }

    /// The work is complete.
    pub(crate) fn end(self) {
        self.bar.finish_and_clear();
        let taken = HumanDuration(self.begun.elapsed());
        report::tell(format_args!("{}: done in {taken}", self.what));
    }
}

impl Drop for Activity {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Measurements of a known number. They end in the same manner as an [`Activity`].
#[derive(Debug)]
pub(crate) struct Measuring {
    what: String,
    begun: Instant,
    bar: ProgressBar,
}

/// Begins `count` measurements.
pub(crate) fn measuring(what: &str, length: u64) -> Measuring {
    let template = "{prefix}: {bar:30} {percent}%, {elapsed}, {eta} left, {msg}";
    let bar = bar(length, template).with_prefix(what.to_owned());
    match io::stderr().is_terminal() {
        true => bar.enable_steady_tick(TICK),
        false => report::tell(format_args!("measuring {what} ...")),
    }
    Measuring {
        what: what.to_owned(),
        begun: Instant::now(),
        bar,
    }
}

impl Measuring {
    /// Adds completed measurements, of which this is the last.
    pub(crate) fn advance(&self, count: u64, last: &str) {
        self.bar.set_message(last.to_owned());
        self.bar.inc(count);
    }

    /// All are complete.
    pub(crate) fn end(&self) {
        self.bar.finish_and_clear();
        let taken = HumanDuration(self.begun.elapsed());
        report::tell(format_args!("measured {}: {taken}", self.what));
    }
}

impl Drop for Measuring {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
