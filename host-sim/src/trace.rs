//! The trace: one record per hand frame, as JSON Lines or CSV, every number with the fewest digits that read back to the
//! same value of the number type. It is written beside its place and moved there when it is whole.

mod table;

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::{Serialize, Serializer};
use stiction_tools::files::part;
use tempfile::NamedTempFile;

use crate::record::{Frame, Run};

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
        match file.extension()?.to_str()? {
            "jsonl" => Some(Self::JsonLines),
            "csv" => Some(Self::Csv),
            _ => None,
        }
    }
}

/// A value of the run's number type, printed with the digits of that type.
#[derive(Clone, Copy, Debug)]
struct Value {
    value: f64,
    single: bool,
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.single {
            serializer.serialize_f32(self.value as f32)
        } else {
            serializer.serialize_f64(self.value)
        }
    }
}

/// A record of a trace.
#[derive(Serialize)]
pub(crate) struct Record<'a> {
    t: f64,
    hand: [Value; 3],
    held: bool,
    pose: [Value; 3],
    depth: Value,
    state: &'static str,
    contacts: Vec<ContactEntry<'a>>,
    wrench: [Value; 3],
    slips: u32,
    events: Vec<&'static str>,
    status: &'static str,
    /// Where a frame has a budget.
    #[serde(skip_serializing_if = "Option::is_none")]
    behind: Option<Value>,
}

#[derive(Serialize)]
struct ContactEntry<'a> {
    vertex: usize,
    surface: &'a str,
    point: [Value; 2],
    normal: Value,
    friction: Value,
    sliding: i8,
}

impl<'a> Record<'a> {
    /// Of a frame; `surfaces`: their names, `single`: the numbers have the digits of f32.
    pub(crate) fn new(frame: &Frame, surfaces: &'a [String], single: bool) -> Self {
        let value = |value| Value { value, single };
        let contacts = frame.contacts.iter().map(|contact| ContactEntry {
            vertex: contact.vertex,
            surface: surfaces.get(contact.surface).map_or("", String::as_str),
            point: contact.point.map(value),
            normal: value(contact.normal),
            friction: value(contact.friction),
            sliding: contact.sliding,
        });
        Self {
            t: frame.t,
            hand: frame.hand.map(value),
            held: frame.held,
            pose: frame.pose.map(value),
            depth: value(frame.depth),
            state: frame.state.name(),
            contacts: contacts.collect(),
            wrench: frame.wrench.map(value),
            slips: frame.slips,
            events: frame.events.iter().map(|event| event.name()).collect(),
            status: frame.status.name(),
            behind: frame.behind.map(value),
        }
    }
}

#[derive(Debug)]
enum Writer {
    JsonLines(BufWriter<NamedTempFile>),
    Csv(Box<table::Writer>),
}

/// A trace that is being written; it appears in its place with [`TraceWriter::finish`], or not at all.
#[derive(Debug)]
pub struct TraceWriter {
    place: PathBuf,
    surfaces: Vec<String>,
    single: bool,
    writer: Writer,
}

impl TraceWriter {
    /// Begins the trace of `run` that is to stand at `place`.
    ///
    /// # Errors
    /// The folder of `place` cannot be written to.
    pub fn create(place: &Path, format: Format, run: &Run) -> io::Result<Self> {
        let file = part(place)?;
        let writer = match format {
            Format::JsonLines => Writer::JsonLines(BufWriter::new(file)),
            Format::Csv => Writer::Csv(Box::new(table::Writer::new(file))),
        };
        Ok(Self {
            place: place.to_owned(),
            surfaces: run.surface_names(),
            single: run.number.is_single(),
            writer,
        })
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&mut self, frame: &Frame) -> io::Result<()> {
        let record = Record::new(frame, &self.surfaces, self.single);
        match &mut self.writer {
            Writer::JsonLines(writer) => {
                serde_json::to_writer(&mut *writer, &record)?;
                writer.write_all(b"\n")
            }
            Writer::Csv(writer) => writer.write(&record),
        }
    }

    /// Puts the whole trace in its place.
    ///
    /// # Errors
    /// The file cannot be written or moved.
    pub fn finish(self) -> io::Result<()> {
        let file = match self.writer {
            Writer::JsonLines(writer) => {
                writer.into_inner().map_err(io::IntoInnerError::into_error)
            }
            Writer::Csv(writer) => writer.finish(),
        }?;
        file.persist(&self.place)?;
        Ok(())
    }
}
