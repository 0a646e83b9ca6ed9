//! The table on disk: rows are added in order, each with one write, so that a killed run leaves complete rows and at most one
//! that is cut. The next run finds the inputs of the rows, and their digests, in a file next to the table, and continues after
//! the last row.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};

use fs4::TryLockError;

use super::beside::Beside;
use crate::files::WriteError;

/// The maximum length of a line in a table that is read (bytes): its names and values come from a sweep file or from a summary,
/// and these are shorter.
const LONGEST_ROW: u64 = 2 * stiction_scene::text::LONGEST_WHOLE;

/// The reason why rows cannot be added.
#[derive(Debug, thiserror::Error)]
pub(super) enum OutputError {
    #[error(transparent)]
    Write(#[from] WriteError),
    /// Another process writes to it.
    #[error("{}: another sweep is writing to it, allowed: one at a time, or another --out", .0.display())]
    Busy(PathBuf),
    /// It was not written by a sweep.
    #[error(
        "{}: is there already and {} is not, so no sweep wrote it, allowed: another --out, or a file that is not there",
        place.display(), beside.display()
    )]
    Stranger { place: PathBuf, beside: PathBuf },
    /// The rows belong to another sweep.
    #[error(
        "{}: its rows were made from other input ({changed}), allowed: the input of before, another --out, or to delete {}",
        place.display(), place.display()
    )]
    Changed { place: PathBuf, changed: String },
    /// A row is not the expected one.
    #[error(
        "{}, line {line}: is not {expected}, allowed: the file as the sweep left it, another --out, or to delete it",
        place.display()
    )]
    Edited {
        place: PathBuf,
        line: u64,
        expected: String,
    },
}

#[derive(Clone, Debug)]
pub(super) struct Rows {
    /// The first line; the tables of all shards but the first have none.
    pub(super) header: Option<Vec<u8>>,
    pub(super) first: u64,
    /// The step between indices.
    pub(super) step: u64,
    pub(super) count: u64,
}

impl Rows {
    pub(super) fn index(&self, k: u64) -> u64 {
        self.first + k * self.step
    }
}

/// A table to which rows are added. As long as it exists, nobody else adds any.
#[derive(Debug)]
pub(super) struct Output {
    file: File,
    place: PathBuf,
    beside: Beside,
    rows: u64,
}

impl Output {
    /// Opens the table at `place`, or creates it; `inputs`: the inputs of the rows, line by line.
    pub(super) fn open(place: &Path, inputs: &str, rows: &Rows) -> Result<Self, OutputError> {
        let file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(place)
            .map_err(WriteError::of(place))?;
        match fs4::FileExt::try_lock(&file) {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(OutputError::Busy(place.to_owned())),
            // Some file systems of clusters do not support locks.
            Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {}
            Err(TryLockError::Error(error)) => return Err(WriteError::of(place)(error).into()),
        }
        let beside = match length_of(&file).map_err(WriteError::of(place))? {
            0 => Beside::begin(place, inputs)?,
            _ => Beside::open(place, inputs)?,
        };
        let mut output = Self {
            file,
            place: place.to_owned(),
            beside,
            rows: 0,
        };
        let whole = output.take_stock(rows)?;
        output.file.set_len(whole).map_err(WriteError::of(place))?;
        output.beside.cut(output.rows)?;
        (output.file.seek(io::SeekFrom::Start(whole))).map_err(WriteError::of(place))?;
        if let (0, Some(header)) = (whole, &rows.header) {
            output.write(header)?;
        }
        Ok(output)
    }

    pub(super) fn rows(&self) -> u64 {
        self.rows
    }

    /// Adds a row; on return, the system has accepted it.
    pub(super) fn append(&mut self, row: &[u8]) -> Result<(), OutputError> {
        self.write(row)?;
        self.beside.append(row)?;
        self.rows += 1;
        Ok(())
    }

    fn write(&mut self, line: &[u8]) -> Result<(), OutputError> {
        Ok(self
            .file
            .write_all(line)
            .map_err(WriteError::of(&self.place))?)
    }

    /// Counts the rows, each of which must be the one that was written there; returns their length in bytes. If the last row has
    /// no digest, it is computed again.
    fn take_stock(&mut self, rows: &Rows) -> Result<u64, OutputError> {
        let place = self.place.clone();
        let mut reader = BufReader::new(&self.file);
        let (mut line, mut whole, mut text) = (0, 0, Vec::new());
        loop {
            text.clear();
            let length = (&mut reader).take(LONGEST_ROW).read_until(b'\n', &mut text);
            let length = length.map_err(WriteError::of(&place))? as u64;
            if !text.ends_with(b"\n") && length < LONGEST_ROW {
                return Ok(whole);
            }
            line += 1;
            let is_header = line == 1 && rows.header.is_some();
            let (fits, expected) = if is_header {
                (rows.header.as_ref() == Some(&text), "the header".to_owned())
            } else {
                let index = rows.index(self.rows);
                let is_next =
                    self.rows < rows.count && text.starts_with(format!("{index},").as_bytes());
                let fits = match is_next {
                    true => match self.beside.is_next(&text)? {
                        Some(fits) => fits,
                        None => return Ok(whole),
                    },
                    false => false,
                };
                let expected = format!("the row of index {index} that the sweep wrote");
                (fits, expected)
            };
            if !fits {
                return Err(OutputError::Edited {
                    place,
                    line,
                    expected,
                });
            }
            whole += length;
            self.rows += u64::from(!is_header);
        }
    }
}

/// The length of a file on a disk (bytes).
pub(super) fn length_of(file: &File) -> io::Result<u64> {
    let there = file.metadata()?;
    match there.is_file() {
        true => Ok(there.len()),
        false => Err(io::Error::new(
            ErrorKind::InvalidInput,
            "it is not a file on a disk",
        )),
    }
}
