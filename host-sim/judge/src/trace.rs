//! Reads a trace record by record, JSON Lines or CSV; errors name the file, the line and the key.

mod json;
mod record;
mod table;

use std::io::BufReader;
use std::path::{Path, PathBuf};

use stiction_scene::{InputError, text};

use crate::frame::Frame;
use crate::scene::Scene;
use record::Names;

/// The longest allowed record (bytes): 192 contacts, one for each vertex and corner of the largest scene, of a kilobyte each take
/// less than a quarter of it.
const LONGEST_RECORD: usize = 1 << 20;

/// A trace that is being read: an iterator over its frames, each with its line, counted from 1.
pub struct Trace {
    file: PathBuf,
    names: Names,
    records: Records,
    failed: bool,
}

enum Records {
    Json(json::Lines),
    Table(Box<table::Rows>),
}

/// A line, counted from 1, and its frame or the problem.
type Numbered = (u64, Result<Frame, String>);

impl Trace {
    /// Opens a trace of a scene; its extension, `jsonl` or `csv`, determines the format.
    ///
    /// # Errors
    /// The file cannot be read, has neither extension, or its header lacks a column.
    pub fn open(file: &Path, scene: &Scene) -> Result<Self, InputError> {
        let open = || {
            // The file may have any length: it is read record by record.
            let opened = text::open(file, u64::MAX);
            opened
                .map(|opened| BufReader::with_capacity(1 << 16, opened))
                .map_err(|problem| InputError::of_file(file, problem))
        };
        let records = match file.extension().and_then(|extension| extension.to_str()) {
            Some("jsonl") => Records::Json(json::Lines::new(open()?)),
            Some("csv") => {
                let rows = table::Rows::new(open()?);
                let in_header = |problem| InputError::at_line(file, 1, problem);
                Records::Table(Box::new(rows.map_err(in_header)?))
            }
            _ => {
                let problem = "allowed: a trace whose name ends in .jsonl or .csv";
                return Err(InputError::of_file(file, problem));
            }
        };
        Ok(Self {
            file: file.to_owned(),
            names: Names::of(scene),
            records,
            failed: false,
        })
    }
}

impl Iterator for Trace {
    type Item = Result<(u64, Frame), InputError>;

    /// The next frame; none after an error.
    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let (line, result) = match &mut self.records {
            Records::Json(lines) => lines.next(&self.names)?,
            Records::Table(rows) => rows.next(&self.names)?,
        };
        self.failed = result.is_err();
        let frame = result.map(|frame| (line, frame));
        Some(frame.map_err(|problem| InputError::at_line(&self.file, line, problem)))
    }
}
