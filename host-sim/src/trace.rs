//! The trace: one record per hand frame, as JSON Lines or CSV, every number with the fewest digits that read back to the
//! same value of the number type. It is written beside its place and moved there when it is whole.

mod table;

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::{Serialize, Serializer};
use stiction_core::Touch;
use stiction_insertion::Insertion;
use stiction_tools::files::part;
use tempfile::NamedTempFile;

use crate::meter;
use crate::record::{ContactRecord, Frame, Run, Scenery};

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
    /// While a peg is in its hole.
    #[serde(skip_serializing_if = "Option::is_none")]
    insertion: Option<InsertionEntry>,
}

/// A reading of Whitney's meter; `lambda` and `margin` are null where there is none.
#[derive(Serialize)]
struct InsertionEntry {
    depth: Value,
    fx: Value,
    fz: Value,
    m: Value,
    lambda: Option<Value>,
    margin: Option<Value>,
    verdict: &'static str,
}

impl InsertionEntry {
    fn new(insertion: &Insertion, single: bool) -> Self {
        let value = |value| Value { value, single };
        Self {
            depth: value(insertion.depth),
            fx: value(insertion.fx),
            fz: value(insertion.fz),
            m: value(insertion.m),
            lambda: insertion.lambda.map(value),
            margin: insertion.margin.map(value),
            verdict: insertion.verdict.name(),
        }
    }
}

/// A vertex on a surface, a vertex on a side of an obstacle, or a corner of one on a side of the body.
#[derive(Serialize)]
struct ContactEntry<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    vertex: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    corner: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    surface: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    obstacle: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    body_side: Option<usize>,
    point: [Value; 2],
    normal: Value,
    friction: Value,
    sliding: i8,
    /// In a scene with obstacles.
    #[serde(skip_serializing_if = "Option::is_none")]
    direction: Option<[Value; 2]>,
}

impl<'a> ContactEntry<'a> {
    fn new(contact: &ContactRecord, scenery: &'a Scenery, single: bool) -> Self {
        let value = |value| Value { value, single };
        let (side, corner, body_side) = match contact.touch {
            Touch::Surface { .. } => (None, None, None),
            Touch::Side { side, .. } => (Some(side), None, None),
            Touch::Corner {
                corner, body_side, ..
            } => (None, Some(corner), Some(body_side)),
        };
        Self {
            vertex: contact.vertex(),
            corner,
            surface: contact.surface().map(|k| name(&scenery.names.surfaces, k)),
            obstacle: contact
                .obstacle()
                .map(|k| name(&scenery.names.obstacles, k)),
            side,
            body_side,
            point: contact.point.map(value),
            normal: value(contact.normal),
            friction: value(contact.friction),
            sliding: contact.sliding,
            direction: contact.direction.map(|direction| direction.map(value)),
        }
    }
}

fn name(names: &[String], index: usize) -> &str {
    names.get(index).map_or("", String::as_str)
}

impl<'a> Record<'a> {
    /// Of a frame; `single`: the numbers have the digits of f32.
    pub(crate) fn new(frame: &Frame, scenery: &'a Scenery, single: bool) -> Self {
        let value = |value| Value { value, single };
        let contacts = frame.contacts.iter();
        let contacts = contacts.map(|contact| ContactEntry::new(contact, scenery, single));
        let insertion = scenery
            .meter
            .as_ref()
            .and_then(|meter| meter::read(meter, frame));
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
            insertion: insertion.map(|found| InsertionEntry::new(&found, single)),
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
    scenery: Scenery,
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
            Format::Csv => Writer::Csv(Box::new(table::Writer::new(
                file,
                table::Has {
                    obstacles: !run.obstacles.is_empty(),
                    meter: run.meter.is_some(),
                },
            ))),
        };
        Ok(Self {
            place: place.to_owned(),
            scenery: run.scenery(),
            single: run.number.is_single(),
            writer,
        })
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&mut self, frame: &Frame) -> io::Result<()> {
        let record = Record::new(frame, &self.scenery, self.single);
        match &mut self.writer {
            Writer::JsonLines(writer) => {
                serde_json::to_writer(&mut *writer, &record)?;
                writer.write_all(b"\n")
            }
            Writer::Csv(writer) => writer.write(&record),
        }
    }

    /// From here on the frames are of another run of the same body.
    pub(crate) fn change(&mut self, run: &Run) {
        (self.scenery, self.single) = (run.scenery(), run.number.is_single());
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
