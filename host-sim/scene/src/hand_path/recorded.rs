//! Recorded paths as files: CSV with a header, or the TUM trajectory format. Read line by line to rows of numbers, of which the
//! number, the times and the switch are checked; a pose that is not finite is accepted.

use std::io::BufRead;
use std::path::Path;

use stiction_core::TrackerSample;

use crate::source::{InputError, excerpt, not_text};
use crate::text::Lines;

const PLANAR: [&str; 4] = ["t", "x", "y", "phi"];
const SPATIAL: [&str; 8] = ["t", "x", "y", "z", "qx", "qy", "qz", "qw"];
const HELD: &str = "held";

/// The longest allowed line (bytes). The longest f64 without an exponent takes 345 characters: nine of them with their commas take
/// 3.1 KB. A comment may follow.
const LONGEST_LINE: usize = 4096;

#[derive(Clone, Copy, Debug)]
pub(crate) enum RowPose {
    /// x, y (m), phi (rad)
    Planar([f64; 3]),
    /// Six degrees of freedom.
    Spatial(TrackerSample<f64>),
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub(crate) line: usize,
    pub(crate) t: f64,
    pub(crate) pose: RowPose,
    pub(crate) held: bool,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Format {
    Csv,
    Tum,
}

impl Format {
    /// The format given by the file's extension.
    pub(super) fn of(file: &Path) -> Result<Self, InputError> {
        let extension = file.extension().unwrap_or_default().to_string_lossy();
        match extension.to_ascii_lowercase().as_str() {
            "csv" => Ok(Self::Csv),
            "tum" | "txt" => Ok(Self::Tum),
            _ => Err(InputError::of_file(
                file,
                format!(
                    "the extension of a recorded path is {extension:?}, allowed: csv, tum, txt"
                ),
            )),
        }
    }

    fn fields(self, line: &str) -> Vec<&str> {
        match self {
            Self::Csv => line
                .split(',')
                .map(|field| field.trim().trim_matches('"'))
                .collect(),
            Self::Tum => line.split_whitespace().collect(),
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Columns {
    pose: &'static [&'static str],
    held: bool,
}

impl Columns {
    const TUM: Self = Self {
        pose: &SPATIAL,
        held: false,
    };

    /// The columns named in the header of a CSV file.
    fn of(header: &[&str]) -> Option<Self> {
        let (pose, held) = match header {
            [pose @ .., HELD] => (pose, true),
            _ => (header, false),
        };
        let pose = [&PLANAR[..], &SPATIAL[..]]
            .into_iter()
            .find(|known| *known == pose)?;
        Some(Self { pose, held })
    }

    fn row(self, line: usize, fields: &[&str]) -> Result<Row, String> {
        let (expected, count) = (self.pose.len() + usize::from(self.held), fields.len());
        if count != expected {
            let names = self.pose.join(", ") + if self.held { ", held" } else { "" };
            return Err(format!("{count} values, allowed: {expected} ({names})"));
        }
        let values = self.values(fields)?;
        let held = match values[self.pose.len()..] {
            [held] if held != 0.0 && held != 1.0 => {
                return Err(format!("`{HELD}` is {held:?}, allowed: 0 or 1"));
            }
            [held] => held == 1.0,
            _ => true,
        };
        let t = values[0];
        if !t.is_finite() {
            return Err(format!("`t` is {t:?}, allowed: a finite time"));
        }
        let pose = match values[1..self.pose.len()] {
            [x, y, z, qx, qy, qz, qw] => RowPose::Spatial(TrackerSample {
                position: [x, y, z],
                orientation: [qx, qy, qz, qw],
                held,
            }),
            _ => RowPose::Planar([values[1], values[2], values[3]]),
        };
        Ok(Row {
            line,
            t,
            pose,
            held,
        })
    }

    fn values(self, fields: &[&str]) -> Result<Vec<f64>, String> {
        let names = self.pose.iter().chain([&HELD]);
        let value = |(field, name): (&&str, &&str)| {
            let number = field.parse();
            let allowed = if *name == HELD { "0 or 1" } else { "a number" };
            number.map_err(|_| format!("`{name}` is {:?}, allowed: {allowed}", excerpt(field)))
        };
        fields.iter().zip(names).map(value).collect()
    }
}

/// The content of a line; a `#` starts a comment.
fn content(line: &str) -> &str {
    line.split('#').next().unwrap_or("").trim()
}

/// The records of a file in order; their times increase.
pub(super) struct Records<'a, R> {
    file: &'a Path,
    lines: Lines<R>,
    format: Format,
    /// Known once the header is read.
    columns: Option<Columns>,
    /// The time of the previous record (s).
    before: Option<f64>,
}

impl<'a, R: BufRead> Records<'a, R> {
    /// The records from a reader; `file` is its name in messages.
    pub(super) fn new(file: &'a Path, reader: R, format: Format) -> Self {
        Self {
            file,
            lines: Lines::new(reader, LONGEST_LINE),
            format,
            columns: matches!(format, Format::Tum).then_some(Columns::TUM),
            before: None,
        }
    }

    /// The next record and its line; `None` after the last one. There is at least one.
    pub(super) fn next(&mut self) -> Result<Option<(Row, &str)>, InputError> {
        loop {
            let number = self.lines.number() + 1;
            match self.lines.advance() {
                Ok(Some(_)) => {}
                Ok(None) => return self.end(),
                Err(problem) => {
                    let begin = String::from_utf8_lossy(self.lines.text());
                    return Err(InputError::in_line(self.file, (number, &begin), problem));
                }
            }
            if let Some(row) = self.row(number)? {
                return Ok(Some((row, self.text())));
            }
        }
    }

    /// The last line read; it is text.
    fn text(&self) -> &str {
        str::from_utf8(self.lines.text()).unwrap_or_default()
    }

    /// The record in the last line read; `None` for a comment and for the header.
    fn row(&mut self, number: usize) -> Result<Option<Row>, InputError> {
        let Ok(line) = str::from_utf8(self.lines.text()) else {
            return Err(InputError::of_file(self.file, not_text(number)));
        };
        let error = |problem: String| InputError::in_line(self.file, (number, line), problem);
        let content = content(line);
        if content.is_empty() {
            return Ok(None);
        }
        let fields = self.format.fields(content);
        let Some(columns) = self.columns else {
            self.columns = Some(Columns::of(&fields).ok_or_else(|| {
                let (planar, spatial) = (PLANAR.join(","), SPATIAL.join(","));
                error(format!(
                    "the header is not known, allowed: {planar}[,held] or {spatial}[,held]"
                ))
            })?);
            return Ok(None);
        };
        let row = columns.row(number, &fields).map_err(error)?;
        if let Some(before) = self.before.filter(|before| row.t <= *before) {
            let allowed = "allowed: times that increase";
            return Err(error(format!(
                "`t` is {:?} after {before:?}, {allowed}",
                row.t
            )));
        }
        self.before = Some(row.t);
        Ok(Some(row))
    }

    fn end<T>(&self) -> Result<Option<T>, InputError> {
        let problem = match (self.before, self.columns) {
            (Some(_), _) => return Ok(None),
            (None, None) => "is empty, allowed: a header and at least one record",
            (None, Some(_)) => "holds no record, allowed: at least one",
        };
        Err(InputError::of_file(self.file, problem))
    }
}

/// The line of the last record and its number.
pub(super) fn last_line(reader: impl BufRead) -> (usize, String) {
    let (mut lines, mut last) = (Lines::new(reader, LONGEST_LINE), (1, String::new()));
    // Unreadable lines were refused before.
    while let Ok(Some(bytes)) = lines.advance() {
        let line = String::from_utf8_lossy(bytes).into_owned();
        if !content(&line).is_empty() {
            last = (lines.number(), line);
        }
    }
    last
}
