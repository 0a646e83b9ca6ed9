//! The file next to a table: the inputs of its rows, line by line, and a digest of every row, which reveals rows that somebody
//! has changed.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::files::whole as files;
use sha2::{Digest, Sha256};

use super::output::{OutputError, length_of};
use crate::files::WriteError;

/// The line after the inputs of the rows.
const ROWS: &str = "rows:\n";

/// A line with 64 bits of SHA-256 in hexadecimal digits: chance alters a row unseen once in 2^64 times.
const DIGEST: usize = 17;

fn digest(row: &[u8]) -> [u8; DIGEST] {
    let digits = format!("{:x}", Sha256::digest(row));
    let mut line = [b'\n'; DIGEST];
    line[..DIGEST - 1].copy_from_slice(&digits.as_bytes()[..DIGEST - 1]);
    line
}

pub(super) fn beside(table: &Path) -> PathBuf {
    let mut name = table.as_os_str().to_owned();
    name.push(".sweep");
    name.into()
}

/// The file; its digests are read from the first one on, then new ones are added.
#[derive(Debug)]
pub(super) struct Beside {
    file: BufReader<File>,
    place: PathBuf,
    /// The position of the first digest (bytes).
    begin: u64,
}

impl Beside {
    /// Creates the file for a table without rows, made from `inputs`.
    pub(super) fn begin(table: &Path, inputs: &str) -> Result<Self, OutputError> {
        let place = beside(table);
        let text = format!("{inputs}{ROWS}");
        files::write(&place, text.as_bytes()).map_err(WriteError::of(&place))?;
        Self::open(table, inputs)
    }

    /// Opens the file of an existing table.
    pub(super) fn open(table: &Path, inputs: &str) -> Result<Self, OutputError> {
        let place = beside(table);
        let file = match OpenOptions::new().read(true).write(true).open(&place) {
            Ok(file) => file,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let (place, beside) = (table.to_owned(), place);
                return Err(OutputError::Stranger { place, beside });
            }
            Err(error) => return Err(WriteError::of(&place)(error).into()),
        };
        length_of(&file).map_err(WriteError::of(&place))?;
        let mut file = BufReader::new(file);
        let expected = format!("{inputs}{ROWS}");
        let begin = expected.len() as u64;
        let before = head(
            file.by_ref()
                .take(begin + stiction_scene::text::LONGEST_WHOLE),
        );
        let before = before.map_err(WriteError::of(&place))?;
        if before == expected.as_bytes() {
            return Ok(Self { file, place, begin });
        }
        // Written by a program without digests: changes of its rows cannot be detected.
        if before == inputs.as_bytes() {
            return Self::begin(table, inputs);
        }
        Err(OutputError::Changed {
            place: table.to_owned(),
            changed: changed(&String::from_utf8_lossy(&before), &expected),
        })
    }

    /// Returns whether a row is the one that was written next; nothing if none was.
    pub(super) fn is_next(&mut self, row: &[u8]) -> Result<Option<bool>, OutputError> {
        let mut line = [0; DIGEST];
        match self.file.read_exact(&mut line) {
            Ok(()) => Ok(Some(line == digest(row))),
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => Ok(None),
            Err(error) => Err(WriteError::of(&self.place)(error).into()),
        }
    }

    /// Keeps the digests of `rows` rows; the next one follows.
    pub(super) fn cut(&mut self, rows: u64) -> Result<(), OutputError> {
        let length = self.begin + rows * DIGEST as u64;
        let cut = self.file.get_ref().set_len(length);
        let cut = cut.and_then(|()| self.file.seek(SeekFrom::Start(length)));
        cut.map(drop).map_err(WriteError::of(&self.place))?;
        Ok(())
    }

    /// Adds the digest of a row.
    pub(super) fn append(&mut self, row: &[u8]) -> Result<(), OutputError> {
        let written = self.file.get_mut().write_all(&digest(row));
        Ok(written.map_err(WriteError::of(&self.place))?)
    }
}

/// The lines up to and including the one before the digests.
fn head(mut file: impl BufRead) -> io::Result<Vec<u8>> {
    let mut head = Vec::new();
    loop {
        let line = head.len();
        let count = file.read_until(b'\n', &mut head)?;
        if count == 0 || &head[line..] == ROWS.as_bytes() {
            return Ok(head);
        }
    }
}

/// The difference between two lists of inputs, whose lines are "what: which".
fn changed(before: &str, inputs: &str) -> String {
    let names = |text: &str, other: &str| -> Vec<String> {
        let lines = text
            .lines()
            .filter(|line| !other.lines().any(|known| known == *line));
        let name = |line: &str| line.split(':').next().unwrap_or_default().to_owned();
        lines.map(name).collect()
    };
    let mut changed = names(inputs, before);
    changed.extend(names(before, inputs));
    changed.sort();
    changed.dedup();
    changed.join(", ")
}
