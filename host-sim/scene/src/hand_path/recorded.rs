//! Recorded paths as files: CSV with a header, or the TUM trajectory format. Read line by line to rows of numbers, of which the
//! number, the times and the switch are checked; a pose that is lost, with empty values or such that are not finite, is accepted.

use std::io::BufRead;
use std::path::Path;

use stiction_core::TrackerSample;

use super::header::{Columns, HELD, NAMES, PHI, QX, T, X};
use super::placement::AngleUnit;
use crate::source::{InputError, excerpt, not_text};
use crate::text::Lines;

/// The longest allowed line (bytes). The longest f64 without an exponent takes 345 characters: nine of them with their commas take
/// 3.1 KB. A comment may follow.
const LONGEST_LINE: usize = 4096;

/// What programs write for a number that they do not have.
const LOST: [&str; 7] = ["", "null", "none", "na", "n/a", "-", "nil"];

/// From this time on (s), which is in the year 5138, a first time without a unit is no time in seconds: a clock in finer units that began in
/// 1970 has shown larger numbers since 1973. Each unit is 1000 of the next one.
const NO_SECONDS: f64 = 1e11;
const FINER: [(&str, f64); 3] = [("ns", 1e9), ("us", 1e6), ("ms", 1e3)];

#[derive(Clone, Copy, Debug)]
pub(crate) enum RowPose {
    /// x, y (m), phi in its unit.
    Planar([f64; 3]),
    /// Six degrees of freedom.
    Spatial(TrackerSample<f64>),
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub(crate) line: usize,
    pub(crate) t: f64,
    pub(crate) pose: RowPose,
    /// The unit of a planar pose's phi, if the file states it.
    pub(crate) unit: Option<AngleUnit>,
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

    /// One separator is between two values; otherwise any number of spaces and commas.
    fn is_separated(self, separator: char) -> bool {
        matches!(self, Self::Csv) && separator != ' '
    }

    /// The values in a line.
    fn fields(self, line: &str, separator: char) -> Vec<&str> {
        if self.is_separated(separator) {
            let fields = line.split(separator);
            return fields.map(|field| field.trim().trim_matches('"')).collect();
        }
        line.split(|c: char| c.is_whitespace() || c == ',')
            .filter(|field| !field.is_empty())
            .collect()
    }

    /// The names in a header, and the separator of a CSV file that has it.
    fn header(self, line: &str) -> (Vec<String>, char) {
        let separator = [',', ';', '\t'].into_iter().find(|&c| line.contains(c));
        let separator = separator.unwrap_or(' ');
        let line = if self.is_separated(separator) {
            line.to_owned()
        } else {
            // A unit belongs to the name before it.
            line.replace(" [", "[").replace(" (", "(")
        };
        let names = self.fields(line.trim(), separator).into_iter();
        let mut names: Vec<String> = names.map(str::to_owned).collect();
        if names.last().is_some_and(String::is_empty) {
            names.pop();
        }
        (names, separator)
    }
}

/// The number of a value; NaN for one that is lost.
fn number(text: &str) -> Option<f64> {
    let is_lost = LOST.iter().any(|lost| lost.eq_ignore_ascii_case(text));
    if is_lost {
        return Some(f64::NAN);
    }
    text.parse().ok()
}

impl Columns {
    /// The record of a row's values.
    fn row(&self, line: usize, fields: &[&str]) -> Result<Row, String> {
        let (expected, mut count) = (self.names.len(), fields.len());
        if count == expected + 1 && fields.last().is_some_and(|field| field.is_empty()) {
            count = expected;
        }
        if count != expected {
            let names = excerpt(&self.names.join(", "));
            return Err(format!("{count} values, allowed: {expected} ({names})"));
        }
        let t = self.in_si(T, self.value(T, fields)?);
        if !t.is_finite() {
            return Err(format!("`t` is {t:?}, allowed: a finite time"));
        }
        let held = self.held(fields)?;
        let value = |number| Ok::<_, String>(self.in_si(number, self.value(number, fields)?));
        let pose = if self.is_spatial() {
            let (mut position, mut orientation) = ([0.0; 3], [0.0; 4]);
            for (place, number) in position.iter_mut().zip(X..) {
                *place = value(number)?;
            }
            for (place, number) in orientation.iter_mut().zip(QX..) {
                *place = value(number)?;
            }
            RowPose::Spatial(TrackerSample {
                position,
                orientation,
                held,
            })
        } else {
            RowPose::Planar([value(X)?, value(X + 1)?, value(PHI)?])
        };
        Ok(Row {
            line,
            t,
            pose,
            unit: self.angle,
            held,
        })
    }

    fn value(&self, number_of: usize, fields: &[&str]) -> Result<f64, String> {
        let text = self.field(number_of, fields).unwrap_or_default();
        let value = number(text)
            .filter(|value| number_of != T || !value.is_nan() || text.parse::<f64>().is_ok());
        value.ok_or_else(|| {
            let decimal = match text.contains(',') {
                true => " with a decimal point",
                false => "",
            };
            format!(
                "`{}` is {:?}, allowed: a number{decimal}",
                NAMES[number_of],
                excerpt(text)
            )
        })
    }

    fn held(&self, fields: &[&str]) -> Result<bool, String> {
        let Some(text) = self.field(HELD, fields) else {
            return Ok(true);
        };
        match text.parse() {
            Ok(0.0) => Ok(false),
            Ok(1.0) => Ok(true),
            Ok(held) => Err(format!("`held` is {held:?}, allowed: 0 or 1")),
            Err(_) => Err(format!("`held` is {:?}, allowed: 0 or 1", excerpt(text))),
        }
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
    /// Between the values of a CSV file.
    separator: char,
    /// Known once the header is read, and without one in the TUM format.
    columns: Option<Columns>,
    /// The line with the header, if it has been read.
    header: Option<usize>,
    /// The first line that was skipped as a comment.
    comment: Option<usize>,
    /// How many of the file's units of time make a second, if its header does not say it; known from the first time.
    per_second: f64,
    /// The time of the previous record (s).
    before: Option<f64>,
    /// What was skipped or assumed.
    pub(super) notes: Vec<String>,
}

impl<'a, R: BufRead> Records<'a, R> {
    /// The records from a reader; `file` is its name in messages.
    pub(super) fn new(file: &'a Path, reader: R, format: Format) -> Self {
        Self {
            file,
            lines: Lines::new(reader, LONGEST_LINE),
            format,
            separator: ',',
            columns: matches!(format, Format::Tum).then(Columns::tum),
            header: None,
            comment: None,
            per_second: 1.0,
            before: None,
            notes: Vec::new(),
        }
    }

    /// Whether the records have six degrees of freedom.
    pub(super) fn is_spatial(&self) -> bool {
        self.columns.as_ref().is_some_and(Columns::is_spatial)
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
        if self.before.is_none() && self.header.is_none() {
            let line = line.to_owned();
            if self.take_header(number, &line)? {
                return Ok(None);
            }
        }
        let error =
            |problem: String| InputError::in_line(self.file, (number, self.text()), problem);
        let content = content(self.text());
        let Some(columns) = self.columns.as_ref().filter(|_| !content.is_empty()) else {
            return Ok(None);
        };
        let fields = self.format.fields(content, self.separator);
        let mut row = columns.row(number, &fields).map_err(error)?;
        let guesses = self.before.is_none() && !columns.states_unit(T);
        if guesses {
            self.guess_unit(row.t);
        }
        row.t /= self.per_second;
        if let Some(before) = self.before.filter(|before| row.t <= *before) {
            let problem = format!(
                "`t` is {:?} after {before:?}, allowed: times that increase",
                row.t
            );
            return Err(InputError::in_line(
                self.file,
                (number, self.text()),
                problem,
            ));
        }
        self.before = Some(row.t);
        Ok(Some(row))
    }

    /// Takes a line before the first record as the header, if it is one: also behind a `#`, if it has all names. Returns false for a record.
    fn take_header(&mut self, number: usize, line: &str) -> Result<bool, InputError> {
        if let Some(commented) = line.trim_start().strip_prefix('#') {
            let (names, separator) = self.format.header(commented);
            match Columns::of(&names) {
                Ok(columns) => self.set_columns((number, separator), columns),
                Err(_) => self.comment = self.comment.or(Some(number)),
            }
            return Ok(true);
        }
        let content = content(line);
        let (names, separator) = self.format.header(content);
        let is_name =
            |text: &String| text.starts_with(|c: char| c.is_alphabetic() || c == '_' || c == '%');
        let is_record = self.columns.is_some() && !names.first().is_some_and(is_name);
        if content.is_empty() || is_record {
            return Ok(content.is_empty());
        }
        let columns = Columns::of(&names).map_err(|problem| {
            let comment = self.comment.map_or_else(String::new, |line| {
                format!("; line {line} begins with # and was skipped as a comment")
            });
            InputError::in_line(self.file, (number, line), problem + &comment)
        })?;
        self.set_columns((number, separator), columns);
        Ok(true)
    }

    fn set_columns(&mut self, (line, separator): (usize, char), columns: Columns) {
        if !columns.skipped.is_empty() {
            let names = excerpt(&columns.skipped.join(", "));
            self.notes
                .push(format!("columns that are skipped: {names}"));
        }
        (self.columns, self.header, self.separator) = (Some(columns), Some(line), separator);
    }

    /// Takes the unit of time from the first time of a file that does not state it.
    fn guess_unit(&mut self, first: f64) {
        let fits = |(_, per): &&(&str, f64)| first.abs() >= NO_SECONDS * (per / 1e3);
        if let Some((name, per)) = FINER.iter().find(fits) {
            self.per_second = *per;
            self.notes.push(format!(
                "the times are read as {name}, for {first:.3e} s is no time; to say so, name the column `t [{name}]`"
            ));
        }
    }

    fn end<T>(&self) -> Result<Option<T>, InputError> {
        let problem = match (self.before, &self.columns) {
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
