//! CSV: a header and one row per frame, with up to four contacts. If the column `contacts` of a row reports more, or a row
//! has four contacts and no such column, the frame is marked as incomplete.

use std::borrow::Cow;
use std::cell::Cell;
use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::rc::Rc;

use csv::{Reader, StringRecord};
use stiction_core::StateKind as State;

use super::record::{Entry, Names, Record};
use super::{LONGEST_RECORD, Numbered};

const CONTACTS: usize = 4;

/// The index of a column; `None` if an optional column is absent.
type Column = Option<usize>;

struct Columns {
    scalars: HashMap<&'static str, usize>,
    depth: Column,
    behind: Column,
    count: Column,
    contacts: [Option<Places>; CONTACTS],
}

/// The indices of a contact's columns.
struct Places {
    /// In the order of [`CONTACT`].
    all: [usize; CONTACT.len()],
    /// In the order of [`OF_OBSTACLES`]; traces without obstacles may have none.
    of_obstacles: [Column; OF_OBSTACLES.len()],
    /// Older traces have none of these.
    sliding: Column,
    direction: Option<[usize; 2]>,
}

const SCALARS: [&str; 15] = [
    "t",
    "hand_x",
    "hand_y",
    "hand_phi",
    "held",
    "pose_x",
    "pose_y",
    "pose_theta",
    "state",
    "wrench_x",
    "wrench_y",
    "wrench_moment",
    "slips",
    "events",
    "status",
];
const CONTACT: [&str; 6] = ["vertex", "surface", "x", "y", "normal", "friction"];
const OF_OBSTACLES: [&str; 4] = ["obstacle", "side", "corner", "body_side"];

/// A file of which no more is read for one row than a record may be long, even if the row does not end.
struct Bounded {
    file: BufReader<File>,
    /// How much may still be read for this row (bytes).
    left: Rc<Cell<usize>>,
}

impl Read for Bounded {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let left = self.left.get();
        if left == 0 {
            let problem = format!("is longer than {LONGEST_RECORD} bytes, allowed: at most that");
            return Err(io::Error::other(problem));
        }
        let part = into.len().min(left);
        let count = self.file.read(&mut into[..part])?;
        self.left.set(left - count);
        Ok(count)
    }
}

pub(super) struct Rows {
    reader: Reader<Bounded>,
    left: Rc<Cell<usize>>,
    columns: Columns,
    row: StringRecord,
}

impl Rows {
    pub(super) fn new(file: BufReader<File>) -> Result<Self, String> {
        let left = Rc::new(Cell::new(LONGEST_RECORD));
        let mut reader = Reader::from_reader(Bounded {
            file,
            left: Rc::clone(&left),
        });
        let header = reader.headers().map_err(|error| error.to_string())?;
        let find = |name: &str| header.iter().position(|column| column == name);
        let need = |name: &str| {
            find(name).ok_or_else(|| {
                let allowed = SCALARS.join(", ");
                format!(
                    "the header has no column `{name}`, allowed: {allowed}, and those of contacts"
                )
            })
        };
        let mut columns = Columns {
            scalars: HashMap::new(),
            depth: find("depth"),
            behind: find("behind"),
            count: find("contacts"),
            contacts: [const { None }; CONTACTS],
        };
        for name in SCALARS {
            columns.scalars.insert(name, need(name)?);
        }
        for (k, contact) in columns.contacts.iter_mut().enumerate() {
            if find(&format!("c{k}_vertex")).is_none() {
                break;
            }
            let mut all = [0; CONTACT.len()];
            for (place, name) in all.iter_mut().zip(CONTACT) {
                *place = need(&format!("c{k}_{name}"))?;
            }
            let column = |name: &str| find(&format!("c{k}_{name}"));
            *contact = Some(Places {
                all,
                of_obstacles: OF_OBSTACLES.map(column),
                sliding: column("sliding"),
                direction: column("direction_x")
                    .zip(column("direction_y"))
                    .map(|(x, y)| [x, y]),
            });
        }
        Ok(Self {
            reader,
            left,
            columns,
            row: StringRecord::new(),
        })
    }

    pub(super) fn next(&mut self, names: &Names) -> Option<Numbered> {
        self.left.set(LONGEST_RECORD);
        match self.reader.read_record(&mut self.row) {
            Ok(false) => None,
            Ok(true) => {
                let line = self.row.position().map_or(0, csv::Position::line);
                let record = self.columns.record(&self.row);
                Some((line, record.and_then(|record| record.frame(names))))
            }
            Err(error) => {
                let line = error.position().map_or(0, csv::Position::line);
                Some((
                    line,
                    Err(format!("not a row of a trace: {}", plain(&error))),
                ))
            }
        }
    }
}

/// The message without the line number, which is reported already.
fn plain(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths {
            expected_len, len, ..
        } => format!("{len} columns, allowed: {expected_len}, as in the header"),
        csv::ErrorKind::Io(error) => error.to_string(),
        _ => error.to_string(),
    }
}

impl Columns {
    fn record<'a>(&self, row: &'a StringRecord) -> Result<Record<'a>, String> {
        let text = |name: &str| {
            self.scalars
                .get(name)
                .and_then(|&i| row.get(i))
                .unwrap_or("")
        };
        let value = |name: &str| number(name, text(name));
        let three = |names: [&str; 3]| -> Result<[Option<f64>; 3], String> {
            let [a, b, c] = names.map(value);
            Ok([Some(a?), Some(b?), Some(c?)])
        };
        let mut contacts = Vec::new();
        for (k, places) in self.contacts.iter().flatten().enumerate() {
            let Some(contact) = places.contact(k, row)? else {
                break;
            };
            contacts.push(contact);
        }
        let in_all = match self.count.and_then(|i| row.get(i)) {
            Some(field) => count("contacts", field)?,
            None if contacts.len() == CONTACTS && text("state") == State::Locked.name() => {
                CONTACTS + 1
            }
            None => contacts.len(),
        };
        Ok(Record {
            t: value("t")?,
            hand: three(["hand_x", "hand_y", "hand_phi"])?,
            held: flag(text("held"))?,
            pose: three(["pose_x", "pose_y", "pose_theta"])?,
            depth: (self.depth.and_then(|i| row.get(i)))
                .map_or(Ok(0.0), |field| number("depth", field))?,
            state: Cow::Borrowed(text("state")),
            more_contacts: in_all > contacts.len(),
            contacts,
            wrench: three(["wrench_x", "wrench_y", "wrench_moment"])?,
            slips: u32::try_from(count("slips", text("slips"))?)
                .map_err(|error| format!("`slips`: {error}"))?,
            events: (text("events").split_whitespace())
                .map(Cow::Borrowed)
                .collect(),
            status: Cow::Borrowed(text("status")),
            behind: (self.behind.and_then(|i| row.get(i)))
                .filter(|field| !field.is_empty())
                .map(|field| number("behind", field))
                .transpose()?,
        })
    }
}

impl Places {
    /// Contact `k` of a row, if it has that many.
    fn contact<'a>(&self, k: usize, row: &'a StringRecord) -> Result<Option<Entry<'a>>, String> {
        let given = |i: usize| row.get(i).filter(|text| !text.is_empty());
        let of_obstacles = |i: usize| self.of_obstacles[i].and_then(given);
        let vertex = given(self.all[0]);
        if vertex.is_none() && of_obstacles(2).is_none() {
            return Ok(None);
        }
        let index = |name: &str, text: Option<&str>| text.map(|text| count(name, text)).transpose();
        let value =
            |name: &str, i: usize| number(&format!("c{k}_{name}"), row.get(i).unwrap_or(""));
        let direction = match self.direction {
            Some([x, y]) if given(x).is_some() => Some([
                Some(value("direction_x", x)?),
                Some(value("direction_y", y)?),
            ]),
            _ => None,
        };
        let sign = |field: &str| {
            let sign = field.parse();
            sign.map_err(|_| not_a_number(&format!("c{k}_sliding"), field))
        };
        let [_, surface, x, y, normal, friction] = self.all;
        Ok(Some(Entry {
            vertex: index("vertex", vertex)?,
            surface: given(surface).map(Cow::Borrowed),
            obstacle: of_obstacles(0).map(Cow::Borrowed),
            side: index("side", of_obstacles(1))?,
            corner: index("corner", of_obstacles(2))?,
            body_side: index("body_side", of_obstacles(3))?,
            point: [Some(value("x", x)?), Some(value("y", y)?)],
            direction,
            normal: value("normal", normal)?,
            friction: value("friction", friction)?,
            sliding: (self.sliding.and_then(|i| row.get(i)))
                .map(sign)
                .transpose()?,
        }))
    }
}

fn number(key: &str, text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| not_a_number(key, text))
}

fn not_a_number(key: &str, text: &str) -> String {
    format!("`{key}` is {text:?}, allowed: a number")
}

fn count(key: &str, text: &str) -> Result<usize, String> {
    text.parse()
        .map_err(|_| format!("`{key}` is {text:?}, allowed: a whole number of at least 0"))
}

fn flag(text: &str) -> Result<bool, String> {
    match text {
        "true" | "1" => Ok(true),
        "false" | "0" => Ok(false),
        _ => Err(format!("`held` is {text:?}, allowed: true, false")),
    }
}
