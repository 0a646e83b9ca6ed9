//! A trace as a table: a record is one CSV row, arrays flattened, events separated by spaces, the first four contacts.

use std::io;

use tempfile::NamedTempFile;

use super::{ContactEntry, InsertionEntry, Record, Value};

/// Maximum number of contacts in a row; columns of absent ones are empty.
const CONTACTS: usize = 4;

type OfRecord = fn(&Record<'_>) -> String;
type OfContact = fn(&ContactEntry<'_>) -> String;
type OfInsertion = fn(&InsertionEntry) -> String;

/// The columns of every trace, each with its value.
const COLUMNS: [(&str, OfRecord); 17] = [
    ("t", |record| format!("{:?}", record.t)),
    ("hand_x", |record| digits(record.hand[0])),
    ("hand_y", |record| digits(record.hand[1])),
    ("hand_phi", |record| digits(record.hand[2])),
    ("held", |record| record.held.to_string()),
    ("pose_x", |record| digits(record.pose[0])),
    ("pose_y", |record| digits(record.pose[1])),
    ("pose_theta", |record| digits(record.pose[2])),
    ("depth", |record| digits(record.depth)),
    ("state", |record| record.state.to_owned()),
    ("wrench_x", |record| digits(record.wrench[0])),
    ("wrench_y", |record| digits(record.wrench[1])),
    ("wrench_moment", |record| digits(record.wrench[2])),
    ("slips", |record| record.slips.to_string()),
    ("events", |record| record.events.join(" ")),
    ("status", |record| record.status.to_owned()),
    ("contacts", |record| record.contacts.len().to_string()),
];

/// The columns of a contact, each with its value.
const CONTACT: [(&str, OfContact); 13] = [
    ("vertex", |of| index(of.vertex)),
    ("surface", |of| of.surface.unwrap_or_default().to_owned()),
    ("obstacle", |of| of.obstacle.unwrap_or_default().to_owned()),
    ("side", |of| index(of.side)),
    ("corner", |of| index(of.corner)),
    ("body_side", |of| index(of.body_side)),
    ("x", |of| digits(of.point[0])),
    ("y", |of| digits(of.point[1])),
    ("normal", |of| digits(of.normal)),
    ("friction", |of| digits(of.friction)),
    ("sliding", |of| of.sliding.to_string()),
    ("direction_x", |of| optional(of.direction.map(|[x, _]| x))),
    ("direction_y", |of| optional(of.direction.map(|[_, y]| y))),
];

/// Those that are present only if the scene has obstacles.
const AMONG_OBSTACLES: [&str; 6] = [
    "obstacle",
    "side",
    "corner",
    "body_side",
    "direction_x",
    "direction_y",
];

/// The columns of a scene that has a peg and a hole, each with its value; empty while the peg is not in it.
const INSERTION: [(&str, OfInsertion); 7] = [
    ("depth", |insertion| digits(insertion.depth)),
    ("fx", |insertion| digits(insertion.fx)),
    ("fz", |insertion| digits(insertion.fz)),
    ("m", |insertion| digits(insertion.m)),
    ("lambda", |insertion| optional(insertion.lambda)),
    ("margin", |insertion| optional(insertion.margin)),
    ("verdict", |insertion| insertion.verdict.to_owned()),
];

/// The column for frames with a budget; the last one.
const BEHIND: &str = "behind";

/// The columns in addition to those of every trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Has {
    pub(super) obstacles: bool,
    pub(super) meter: bool,
}

/// A table that is being written. Its first record determines whether frames have a budget.
#[derive(Debug)]
pub(super) struct CsvTable {
    rows: csv::Writer<NamedTempFile>,
    has_header: bool,
    has: Has,
}

impl CsvTable {
    pub(super) fn new(file: NamedTempFile, has: Has) -> Self {
        Self {
            rows: csv::Writer::from_writer(file),
            has_header: false,
            has,
        }
    }

    pub(super) fn write(&mut self, record: &Record<'_>) -> io::Result<()> {
        self.begin(record.behind.is_some())?;
        Ok(self.rows.write_record(row(record, self.has))?)
    }

    /// Returns the whole table; the header is present even without rows.
    pub(super) fn finish(mut self) -> io::Result<NamedTempFile> {
        self.begin(false)?;
        self.rows.into_inner().map_err(|error| error.into_error())
    }

    fn begin(&mut self, has_budget: bool) -> io::Result<()> {
        if self.has_header {
            return Ok(());
        }
        self.has_header = true;
        let header = header(has_budget, self.has);
        Ok(self.rows.write_record(header)?)
    }
}

fn header(has_budget: bool, has: Has) -> Vec<String> {
    let mut names: Vec<String> = COLUMNS.map(|(name, _)| name.to_owned()).to_vec();
    for k in 0..CONTACTS {
        names.extend(shown(has.obstacles).map(|(name, _)| format!("c{k}_{name}")));
    }
    if has.meter {
        names.extend(INSERTION.map(|(name, _)| format!("insertion_{name}")));
    }
    names.extend(has_budget.then(|| BEHIND.to_owned()));
    names
}

/// The columns of a contact that are present.
fn shown(
    has_obstacles: bool,
) -> impl Iterator<Item = &'static (&'static str, fn(&ContactEntry<'_>) -> String)> {
    let columns = CONTACT.iter();
    columns.filter(move |(name, _)| has_obstacles || !AMONG_OBSTACLES.contains(name))
}

fn row(record: &Record<'_>, has: Has) -> Vec<String> {
    let mut row = COLUMNS.map(|(_, value)| value(record)).to_vec();
    for contact in record.contacts.iter().take(CONTACTS) {
        row.extend(shown(has.obstacles).map(|(_, value)| value(contact)));
    }
    let width = shown(has.obstacles).count();
    row.resize(COLUMNS.len() + CONTACTS * width, String::new());
    if has.meter {
        let insertion = record.insertion.as_ref();
        row.extend(INSERTION.map(|(_, value)| insertion.map_or_else(String::new, value)));
    }
    row.extend(record.behind.map(digits));
    row
}

fn index(index: Option<usize>) -> String {
    index.map_or_else(String::new, |k| k.to_string())
}

fn optional(value: Option<Value>) -> String {
    value.map_or_else(String::new, digits)
}

fn digits(Value { value, single }: Value) -> String {
    if single {
        format!("{:?}", value as f32)
    } else {
        format!("{value:?}")
    }
}
