//! JSON Lines: one object per line.

use std::fs::File;
use std::io::BufReader;

use stiction_scene::text;

use super::record::{Names, Record};
use super::{LONGEST_RECORD, Numbered};
use crate::frame::Frame;

pub(super) struct Lines(text::Lines<BufReader<File>>);

impl Lines {
    pub(super) fn new(file: BufReader<File>) -> Self {
        Self(text::Lines::new(file, LONGEST_RECORD))
    }

    /// The next line that is not blank, with its number.
    pub(super) fn next(&mut self, names: &Names) -> Option<Numbered> {
        loop {
            let line = self.0.number() as u64 + 1;
            match self.0.advance() {
                Ok(None) => return None,
                Ok(Some(text)) if text.trim_ascii().is_empty() => {}
                Ok(Some(text)) => return Some((line, frame(text, names))),
                Err(problem) => return Some((line, Err(problem))),
            }
        }
    }
}

fn frame(text: &[u8], names: &Names) -> Result<Frame, String> {
    let record: Record<'_> = serde_json::from_slice(text).map_err(|error| problem(text, &error))?;
    record.frame(names)
}

/// The problem in a line, and the key after which it occurs.
fn problem(text: &[u8], error: &serde_json::Error) -> String {
    let message = error.to_string();
    let message = message.split(" at line ").next().unwrap_or_default();
    let column = error.column();
    let before = String::from_utf8_lossy(text.get(..column).unwrap_or(text));
    let key = before.rfind("\":").and_then(|end| {
        let start = before[..end].rfind('"')?;
        Some(format!(", near `{}`", &before[start + 1..end]))
    });
    format!(
        "{message}, at column {column}{}; allowed: a JSON object with the keys of a trace",
        key.unwrap_or_default()
    )
}
