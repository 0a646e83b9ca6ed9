//! Text for standard output.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Which plots were written, and where.
pub(crate) fn plots(folder: &Path, files: &[PathBuf]) -> String {
    let mut text = format!("  {:<18}{}\n", "plots", folder.display());
    for file in files {
        // Writing to a string does not fail.
        let _ = writeln!(text, "  {:<18}{}", "", file.display());
    }
    text
}

/// Prints; a reader that has gone is no error.
pub(crate) fn print(text: &str) {
    let _ = io::stdout().write_all(text.as_bytes());
}
