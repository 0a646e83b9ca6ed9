//! A trace as a table: a record is one CSV row, arrays flattened, events separated by spaces, the first four contacts.

use std::io;

use tempfile::NamedTempFile;

use super::{ContactEntry, InsertionEntry, Record, Value};

/// Maximum number of contacts in a row; columns of absent ones are empty.
const CONTACTS: usize = 4;
/// The columns of a contact; the others are present only if the scene has obstacles.
const CONTACT_COLUMNS: [(&str, Shown); 13] = [
    ("vertex", Shown::Always),
    ("surface", Shown::Always),
    ("obstacle", Shown::AmongObstacles),
    ("side", Shown::AmongObstacles),
    ("corner", Shown::AmongObstacles),
    ("body_side", Shown::AmongObstacles),
    ("x", Shown::Always),
    ("y", Shown::Always),
    ("normal", Shown::Always),
    ("friction", Shown::Always),
    ("sliding", Shown::Always),
    ("direction_x", Shown::AmongObstacles),
    ("direction_y", Shown::AmongObstacles),
];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shown {
    Always,
    AmongObstacles,
}

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

/// The column for frames with a budget; the last one.
const BEHIND: &str = "behind";

/// The columns of a scene that has a peg and a hole; empty while the peg is not in it.
const INSERTION: [&str; 7] = ["depth", "fx", "fz", "m", "lambda", "margin", "verdict"];

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
    let mut names: Vec<String> = COLUMNS.map(String::from).to_vec();
    for contact in 0..CONTACTS {
        let columns = shown(has.obstacles).map(|k| CONTACT_COLUMNS[k].0);
        names.extend(columns.map(|column| format!("c{contact}_{column}")));
    }
    if has.meter {
        names.extend(INSERTION.map(|column| format!("insertion_{column}")));
    }
    names.extend(has_budget.then(|| BEHIND.to_owned()));
    names
}

/// The columns of a contact that are present.
fn shown(has_obstacles: bool) -> impl Iterator<Item = usize> {
    let is_shown = move |k: &usize| has_obstacles || CONTACT_COLUMNS[*k].1 == Shown::Always;
    (0..CONTACT_COLUMNS.len()).filter(is_shown)
}

fn row(record: &Record<'_>, has: Has) -> Vec<String> {
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
        let columns = contact_columns(contact);
        row.extend(shown(has.obstacles).map(|k| columns[k].clone()));
    }
    let width = shown(has.obstacles).count();
    row.resize(COLUMNS.len() + CONTACTS * width, String::new());
    if has.meter {
        row.extend(insertion_columns(record.insertion.as_ref()));
    }
    row.extend(record.behind.map(digits));
    row
}

fn insertion_columns(insertion: Option<&InsertionEntry>) -> [String; INSERTION.len()] {
    let Some(insertion) = insertion else {
        return [const { String::new() }; INSERTION.len()];
    };
    let optional = |value: Option<Value>| value.map_or_else(String::new, digits);
    [
        digits(insertion.depth),
        digits(insertion.fx),
        digits(insertion.fz),
        digits(insertion.m),
        optional(insertion.lambda),
        optional(insertion.margin),
        insertion.verdict.to_owned(),
    ]
}

fn contact_columns(contact: &ContactEntry<'_>) -> [String; CONTACT_COLUMNS.len()] {
    let [x, y] = contact.point;
    let index = |index: Option<usize>| index.map_or_else(String::new, |k| k.to_string());
    let [direction_x, direction_y] = match contact.direction {
        Some(direction) => direction.map(digits),
        None => [const { String::new() }; 2],
    };
    [
        index(contact.vertex),
        contact.surface.unwrap_or_default().to_owned(),
        contact.obstacle.unwrap_or_default().to_owned(),
        index(contact.side),
        index(contact.corner),
        index(contact.body_side),
        digits(x),
        digits(y),
        digits(contact.normal),
        digits(contact.friction),
        contact.sliding.to_string(),
        direction_x,
        direction_y,
    ]
}

fn digits(Value { value, single }: Value) -> String {
    if single {
        format!("{:?}", value as f32)
    } else {
        format!("{value:?}")
    }
}
