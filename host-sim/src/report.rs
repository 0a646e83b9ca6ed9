//! Text for standard output and standard error: all commands use this module.

use std::fmt::{Display, Write as _};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The first error of standard output.
static FAILURE: Mutex<Option<io::Error>> = Mutex::new(None);

/// Reports where a file was written: a line of a summary.
pub(crate) fn written(what: &str, place: &Path) -> String {
    format!("  {what:<18}{}\n", place.display())
}

/// Reports which plots were written, and where.
pub(crate) fn plots(folder: &Path, files: &[PathBuf]) -> String {
    let mut text = written("plots", folder);
    for file in files {
        // Writing to a string does not fail.
        let _ = writeln!(text, "  {:<18}{}", "", file.display());
    }
    text
}

/// Prints. Errors are reported at the end, by [`failure`].
pub(crate) fn print(text: &str) {
    printed(io::stdout().write_all(text.as_bytes()));
}

/// Processes the result of printing; a reader that has gone is no error.
pub(crate) fn printed(result: io::Result<()>) {
    if let Err(error) = result.and_then(|()| io::stdout().flush())
        && error.kind() != ErrorKind::BrokenPipe
    {
        let mut first = FAILURE.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    }
}

/// Why the output is incomplete, if it is.
pub(crate) fn failure() -> Option<io::Error> {
    let mut first = FAILURE.lock().unwrap_or_else(PoisonError::into_inner);
    first.take()
}

/// Prints to standard error. Text from a file may have any length, and may contain control characters of a terminal: both are
/// removed. Errors of standard error cannot be reported.
pub(crate) fn tell(text: impl Display) {
    let text = text.to_string();
    let lines: Vec<String> = text.lines().map(plain).collect();
    let _ = writeln!(io::stderr(), "{}", lines.join("\n"));
}

/// Prints notes about the input to standard error: what was skipped, assumed or mended, and what looks wrong.
pub(crate) fn notes<T: Display>(notes: impl IntoIterator<Item = T>) {
    for note in notes {
        tell(format_args!("note: {note}"));
    }
}

/// The longest line is a list of all that is allowed, of keys or scenes (characters).
const LONGEST_LINE: usize = 2000;

/// Shortens a line for a terminal: keeps its beginning and its end, which has the allowed values.
fn plain(line: &str) -> String {
    let shown = |c: char| match c.is_control() && c != '\t' {
        true => '\u{fffd}',
        false => c,
    };
    let count = line.chars().count();
    if count <= LONGEST_LINE {
        return line.chars().map(shown).collect();
    }
    let part = LONGEST_LINE / 2;
    let begin = line.chars().take(part).map(shown);
    let end = line.chars().skip(count - part).map(shown);
    begin.chain(" ... ".chars()).chain(end).collect()
}
