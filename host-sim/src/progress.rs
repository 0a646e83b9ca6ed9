//! How far a command is: bars on a terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// The bar of a measurement, with a message: what is measured now.
pub(crate) fn measuring(length: u64) -> ProgressBar {
    bar(length, "{bar:40} {percent}%, {eta} left, {msg}")
}

/// A bar of indicatif's `template`.
pub(crate) fn bar(length: u64, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template);
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length).with_style(style)
}
