//! Recorded paths as files: CSV with a header, or the TUM trajectory format. Gives rows of numbers, checked for their
//! number, their times and the switch; a pose that is not finite passes.

use std::path::Path;

use stiction_core::TrackerSample;

use crate::source::{InputError, Source, excerpt};

const PLANAR: [&str; 4] = ["t", "x", "y", "phi"];
const SPATIAL: [&str; 8] = ["t", "x", "y", "z", "qx", "qy", "qz", "qw"];
const HELD: &str = "held";

/// The pose of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) enum RowPose {
    /// x, y (m), phi (rad)
    Planar([f64; 3]),
    /// Six degrees of freedom.
    Spatial(TrackerSample<f64>),
}

/// One record with its line, counted from 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub(crate) line: usize,
    pub(crate) t: f64,
    pub(crate) pose: RowPose,
    pub(crate) held: bool,
}

/// The format of a file.
#[derive(Clone, Copy, Debug)]
pub(super) enum Format {
    Csv,
    Tum,
}

impl Format {
    /// By the file's extension.
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

/// What the columns of a file mean.
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

    /// From the header of a CSV file.
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

    fn row(self, source: &Source, line: usize, fields: &[&str]) -> Result<Row, InputError> {
        let error = |problem: String| source.error_in_line(line, problem);
        let (expected, count) = (self.pose.len() + usize::from(self.held), fields.len());
        if count != expected {
            let names = self.pose.join(", ") + if self.held { ", held" } else { "" };
            return Err(error(format!(
                "{count} values, allowed: {expected} ({names})"
            )));
        }
        let values = self.values(fields).map_err(error)?;
        let held = match values[self.pose.len()..] {
            [held] if held != 0.0 && held != 1.0 => {
                return Err(error(format!("`{HELD}` is {held:?}, allowed: 0 or 1")));
            }
            [held] => held == 1.0,
            _ => true,
        };
        let t = values[0];
        if !t.is_finite() {
            return Err(error(format!("`t` is {t:?}, allowed: a finite time")));
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

/// The lines that hold something, counted from 1. A `#` starts a comment.
fn lines(source: &Source) -> impl Iterator<Item = (usize, &str)> {
    (1..)
        .zip(source.text().lines())
        .map(|(line, text)| (line, text.split('#').next().unwrap_or("").trim()))
        .filter(|(_, text)| !text.is_empty())
}

/// The line of the last record.
pub(super) fn last_line(source: &Source) -> usize {
    lines(source).last().map_or(1, |(line, _)| line)
}

/// The rows of a file: at least one, their times increasing.
pub(super) fn rows(source: &Source, format: Format) -> Result<Vec<Row>, InputError> {
    let mut lines = lines(source).map(|(line, text)| (line, format.fields(text)));
    let columns = match format {
        Format::Tum => Columns::TUM,
        Format::Csv => {
            let Some((line, header)) = lines.next() else {
                return Err(source.error("is empty, allowed: a header and at least one record"));
            };
            Columns::of(&header).ok_or_else(|| {
                let (planar, spatial) = (PLANAR.join(","), SPATIAL.join(","));
                let problem = format!(
                    "the header is not known, allowed: {planar}[,held] or {spatial}[,held]"
                );
                source.error_in_line(line, problem)
            })?
        }
    };
    let rows: Vec<Row> = lines
        .map(|(line, fields)| columns.row(source, line, &fields))
        .collect::<Result<_, _>>()?;
    if rows.is_empty() {
        return Err(source.error("holds no record, allowed: at least one"));
    }
    for pair in rows.windows(2) {
        let (before, row) = (pair[0].t, &pair[1]);
        if row.t <= before {
            let problem = format!(
                "`t` is {:?} after {before:?}, allowed: times that increase",
                row.t
            );
            return Err(source.error_in_line(row.line, problem));
        }
    }
    Ok(rows)
}
