//! How far a command is, on standard error: on a terminal what moves, with the time so far; elsewhere a line at the begin and at the end
//! of each part.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};

use crate::report;

/// The time so far goes on while nothing else happens.
const TICK: Duration = Duration::from_millis(200);

/// A bar of indicatif's `template`.
pub(crate) fn bar(length: u64, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template);
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length).with_style(style)
}

/// Work of which nobody knows how long it takes, such as a build. It ends with [`Activity::end`], or, without a word, where an error
/// ends it.
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

    /// It is done.
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

/// Measurements of which the number is known. They end as an [`Activity`] does.
#[derive(Debug)]
pub(crate) struct Measuring {
    what: String,
    begun: Instant,
    bar: ProgressBar,
}

/// Begins so many measurements of something.
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
    /// So many more are done, the last of them this one.
    pub(crate) fn advance(&self, count: u64, last: &str) {
        self.bar.set_message(last.to_owned());
        self.bar.inc(count);
    }

    /// All are done.
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
