//! A trace as a table: a record is one CSV row, arrays flattened, events separated by spaces, the first four contacts.

use std::io;

use tempfile::NamedTempFile;

use super::{ContactEntry, Record, Value};

/// Contacts in a row; columns of absent ones are empty.
const CONTACTS: usize = 4;
const CONTACT_COLUMNS: [&str; 7] = [
    "vertex", "surface", "x", "y", "normal", "friction", "sliding",
];
const COLUMNS: [&str; 17] = [
    "t",
    "hand_x",
    "hand_y",
    "hand_phi",
    "held",
    "pose_x",
    "pose_y",
    "pose_theta",
    "depth",
    "state",
    "wrench_x",
    "wrench_y",
    "wrench_moment",
    "slips",
    "events",
    "status",
    "contacts",
];

/// The column of what only a frame with a budget has; the last one.
const BEHIND: &str = "behind";

/// A table that is being written. Its first record says whether frames have a budget.
#[derive(Debug)]
pub(super) struct Writer {
    rows: csv::Writer<NamedTempFile>,
    has_header: bool,
}

impl Writer {
    pub(super) fn new(file: NamedTempFile) -> Self {
        Self {
            rows: csv::Writer::from_writer(file),
            has_header: false,
        }
    }

    pub(super) fn write(&mut self, record: &Record<'_>) -> io::Result<()> {
        self.begin(record.behind.is_some())?;
        Ok(self.rows.write_record(row(record))?)
    }

    /// The whole table; a header is there without a row, too.
    pub(super) fn finish(mut self) -> io::Result<NamedTempFile> {
        self.begin(false)?;
        self.rows.into_inner().map_err(|error| error.into_error())
    }

    fn begin(&mut self, has_budget: bool) -> io::Result<()> {
        if self.has_header {
            return Ok(());
        }
        self.has_header = true;
        Ok(self.rows.write_record(header(has_budget))?)
    }
}

/// The names of the columns.
fn header(has_budget: bool) -> Vec<String> {
    let mut names: Vec<String> = COLUMNS.map(String::from).to_vec();
    for contact in 0..CONTACTS {
        names.extend(CONTACT_COLUMNS.map(|column| format!("c{contact}_{column}")));
    }
    names.extend(has_budget.then(|| BEHIND.to_owned()));
    names
}

/// The columns of a record.
fn row(record: &Record<'_>) -> Vec<String> {
    let mut row = vec![format!("{:?}", record.t)];
    row.extend(record.hand.map(digits));
    row.push(record.held.to_string());
    row.extend(record.pose.map(digits));
    row.push(digits(record.depth));
    row.push(record.state.to_owned());
    row.extend(record.wrench.map(digits));
    row.push(record.slips.to_string());
    row.push(record.events.join(" "));
    row.push(record.status.to_owned());
    row.push(record.contacts.len().to_string());
    for contact in record.contacts.iter().take(CONTACTS) {
        row.extend(contact_columns(contact));
    }
    row.resize(
        COLUMNS.len() + CONTACTS * CONTACT_COLUMNS.len(),
        String::new(),
    );
    row.extend(record.behind.map(digits));
    row
}

fn contact_columns(contact: &ContactEntry<'_>) -> [String; CONTACT_COLUMNS.len()] {
    let [x, y] = contact.point;
    [
        contact.vertex.to_string(),
        contact.surface.to_owned(),
        digits(x),
        digits(y),
        digits(contact.normal),
        digits(contact.friction),
        contact.sliding.to_string(),
    ]
}

fn digits(Value { value, single }: Value) -> String {
    if single {
        format!("{:?}", value as f32)
    } else {
        format!("{value:?}")
    }
}
