//! The progress of a command, on standard error: an animation on a terminal, with the time elapsed; elsewhere a line at the
//! beginning and at the end of each part.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};

use crate::report;

/// The interval at which the time elapsed is updated while nothing else happens.
const TICK: Duration = Duration::from_millis(200);

/// A bar of indicatif's `template`, which disappears when it is dropped.
pub(crate) fn bar(length: u64, template: &str) -> ProgressBar {
    ProgressBar::new(length).with_style(style(template))
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// Work that takes a while. It ends with [`Activity::end`], or silently if an error ends it.
#[derive(Debug)]
pub(crate) struct Activity {
    /// What is printed at the end, before the time.
    end: String,
    begun: Instant,
    bar: ProgressBar,
}

impl Activity {
    /// Begins work of unknown duration, such as a build.
    pub(crate) fn begin(what: String) -> Self {
        let bar = ProgressBar::no_length().with_style(style("{spinner} {msg}, {elapsed}"));
        let bar = bar.with_message(what.clone());
        let end = format!("{what}: done in");
        Self::new(bar, &what, end)
    }

    /// Begins `count` measurements.
    pub(crate) fn measuring(what: &str, count: u64) -> Self {
        let template = "{prefix}: {bar:30} {percent}%, {elapsed}, {eta} left, {msg}";
        let bar = bar(count, template).with_prefix(what.to_owned());
        let end = format!("measured {what}:");
        Self::new(bar, &format!("measuring {what}"), end)
    }

    fn new(bar: ProgressBar, what: &str, end: String) -> Self {
        match io::stderr().is_terminal() {
            true => bar.enable_steady_tick(TICK),
            false => report::tell(format_args!("{what} ...")),
        }
        let begun = Instant::now();
        Self { end, begun, bar }
    }

    /// Adds completed measurements, of which this is the last.
    pub(crate) fn advance(&self, count: u64, last: &str) {
        self.bar.set_message(last.to_owned());
        self.bar.inc(count);
    }

    pub(crate) fn end(self) {
        self.bar.finish_and_clear();
        let taken = HumanDuration(self.begun.elapsed());
        report::tell(format_args!("{} {taken}", self.end));
    }
}
