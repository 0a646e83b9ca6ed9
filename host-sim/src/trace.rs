//! The trace: one record per hand frame, as JSON Lines or CSV, every number with the fewest digits that read back to the same
//! value of the number type. It is written to a temporary file next to its destination and moved there when it is complete.

mod table;

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::files::whole::part;
pub(crate) use stiction_live::trace::Record;
use stiction_live::trace::{ContactEntry, InsertionEntry, Value};
use tempfile::NamedTempFile;

use stiction_live::record::{Frame, Run};

/// The format of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// One JSON object per line.
    JsonLines,
    /// A header and one row per frame.
    Csv,
}

impl Format {
    /// By the file's extension, `jsonl` or `csv`.
    pub fn of(file: &Path) -> Option<Self> {
        let extension = file.extension()?;
        let all = [("jsonl", Self::JsonLines), ("csv", Self::Csv)];
        let known = all.into_iter().find(|(name, _)| extension == *name);
        known.map(|(_, format)| format)
    }
}

#[derive(Debug)]
enum Target {
    JsonLines(BufWriter<NamedTempFile>),
    Csv(Box<table::CsvTable>),
}

/// A trace that is being written; it appears in its place with [`TraceWriter::finish`], or not at all.
#[derive(Debug)]
pub struct TraceWriter {
    place: PathBuf,
    run: Run,
    writer: Target,
}

impl TraceWriter {
    /// Begins the trace of `run` with the destination `place`.
    ///
    /// # Errors
    /// Fails if the folder of `place` cannot be written to.
    pub fn create(place: &Path, format: Format, run: &Run) -> io::Result<Self> {
        let file = part(place)?;
        let writer = match format {
            Format::JsonLines => Target::JsonLines(BufWriter::new(file)),
            Format::Csv => Target::Csv(Box::new(table::CsvTable::new(
                file,
                table::Has {
                    obstacles: !run.scene.obstacles.is_empty(),
                    meter: run.meter.is_some(),
                },
            ))),
        };
        Ok(Self {
            place: place.to_owned(),
            run: run.clone(),
            writer,
        })
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// Fails if the file cannot be written.
    pub fn write(&mut self, frame: &Frame) -> io::Result<()> {
        let record = self.run.record(frame);
        match &mut self.writer {
            Target::JsonLines(writer) => {
                serde_json::to_writer(&mut *writer, &record)?;
                writer.write_all(b"\n")
            }
            Target::Csv(writer) => writer.write(&record),
        }
    }

    /// From here on, the frames belong to another run of the same body.
    pub(crate) fn change(&mut self, run: &Run) {
        self.run = run.clone();
    }

    /// Moves the complete trace to its destination.
    ///
    /// # Errors
    /// Fails if the file cannot be written or moved.
    pub fn finish(self) -> io::Result<()> {
        let file = match self.writer {
            Target::JsonLines(writer) => {
                writer.into_inner().map_err(io::IntoInnerError::into_error)
            }
            Target::Csv(writer) => writer.finish(),
        }?;
        file.persist(&self.place)?;
        Ok(())
    }
}
