//! Reads a recording: its head, then line by line; errors name the line. If it was cut, the complete part is read.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::IgnoredAny;
use stiction_scene::Sample;
use stiction_scene::text::{LONGEST_WHOLE, Lines};

use super::line::{ChangeLine, End, LineIn};
use super::{Change, EARLIEST, Head, PIECE, VERSION};

/// The maximum length of a line (bytes): a head and a change contain the text of a scene file, for each byte of which JSON needs
/// at most six; the rest of them is shorter than a piece. A sample with its answer has some hundred bytes.
const LONGEST_LINE: usize = 6 * LONGEST_WHOLE as usize + PIECE;

/// The reason why a recording cannot be used.
#[derive(Debug, thiserror::Error)]
pub(crate) enum RecordingError {
    /// It is no file on a disk, or the system cannot read it.
    #[error("{}: {problem}", file.display())]
    File { file: PathBuf, problem: String },
    /// A line is invalid.
    #[error("{}, line {line}: {problem}", file.display())]
    Line {
        file: PathBuf,
        line: usize,
        problem: String,
    },
}

/// The fields that every version of the format has in its head, and those that some had.
#[derive(Clone, Debug, Deserialize)]
struct Made {
    recording: u32,
    build: String,
    tolerance: Option<IgnoredAny>,
}

impl Made {
    /// Checks that it is of the version that this program reads; otherwise returns what it is.
    fn check(&self) -> Result<(), String> {
        let (found, program) = (self.recording, &self.build);
        if (EARLIEST..=VERSION).contains(&found) {
            return Ok(());
        }
        let gone = match self.tolerance {
            Some(_) => " and with a `tolerance`, which the solver does not have any more",
            None => "",
        };
        Err(format!(
            "`recording` is {found} (made by {program}{gone}), allowed: {EARLIEST} to {VERSION}, the versions of the format that this program reads"
        ))
    }
}

/// A line below the head of a recording.
#[derive(Clone, Debug)]
pub(crate) enum RecordingLine {
    /// A sample with the text of its answer.
    Sample(Sample, Option<String>),
    /// From here on, the body is under another setting.
    Change(Change),
}

#[derive(Debug)]
pub(crate) struct Recording {
    file: PathBuf,
    line: usize,
    samples: u64,
    end: Ending,
    lines: Lines<BufReader<File>>,
    pub(crate) head: Head,
}

/// The end of a recording, as far as it has been read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ending {
    /// Without the count of its samples, or not reached yet.
    None,
    /// In the middle of a line, which is omitted.
    Torn,
    /// With the count of its samples.
    Counted,
}

impl Recording {
    /// Opens a recording and reads its head.
    pub(crate) fn open(file: &Path) -> Result<Self, RecordingError> {
        // Of any length: it is read line by line.
        let opened = stiction_scene::text::open(file, u64::MAX);
        let opened = opened.map_err(|problem| RecordingError::File {
            file: file.to_owned(),
            problem,
        })?;
        let error = |problem: String| RecordingError::Line {
            file: file.to_owned(),
            line: 1,
            problem,
        };
        let mut lines = Lines::new(BufReader::new(opened), LONGEST_LINE);
        let text = lines.advance().map_err(error)?.unwrap_or_default();
        let unread = |e: serde_json::Error| match is_trace(text) {
            true => error("this is a trace; use `stiction check`".to_owned()),
            false => error(format!("{}, allowed: the head of a recording", plain(&e))),
        };
        let made: Made = serde_json::from_slice(text).map_err(unread)?;
        made.check().map_err(error)?;
        let head: Head = serde_json::from_slice(text).map_err(unread)?;
        Ok(Self {
            file: file.to_owned(),
            line: 1,
            samples: 0,
            end: Ending::None,
            lines,
            head,
        })
    }

    /// Returns the next line; nothing at the end.
    pub(crate) fn next(&mut self) -> Result<Option<RecordingLine>, RecordingError> {
        if !self.advance()? {
            return Ok(None);
        }
        let text = self.lines.text();
        if let Ok(end) = serde_json::from_slice::<End>(text) {
            self.end(&end)?;
            return Ok(None);
        }
        if let Ok(ChangeLine { change }) = serde_json::from_slice(text) {
            return Ok(Some(RecordingLine::Change(change)));
        }
        let line: LineIn = match serde_json::from_slice(text) {
            Ok(line) => line,
            Err(_) if !self.lines.is_whole() => {
                self.end = Ending::Torn;
                return Ok(None);
            }
            Err(error) => {
                let allowed = "a sample and its answer, or the count of the samples";
                return Err(self.error(format!("{}, allowed: {allowed}", plain(&error))));
            }
        };
        self.samples += 1;
        let answer = line.answer.map(|answer| answer.get().to_owned());
        Ok(Some(RecordingLine::Sample(line.sample.sample(), answer)))
    }

    /// Advances to the next line; false at the end of the file.
    fn advance(&mut self) -> Result<bool, RecordingError> {
        let advanced = self.lines.advance().map(|line| line.is_some());
        if advanced != Ok(false) {
            self.line = self.lines.number();
        }
        advanced.map_err(|problem| self.error(problem))
    }

    fn end(&mut self, end: &End) -> Result<(), RecordingError> {
        let (counted, there) = (end.samples, self.samples);
        if counted != there {
            let problem = format!(
                "`samples` is {counted}, but {there} are there, allowed: all that were recorded"
            );
            return Err(self.error(problem));
        }
        self.end = Ending::Counted;
        match self.advance()? {
            true => {
                Err(self.error("follows the count of the samples, allowed: nothing".to_owned()))
            }
            false => Ok(()),
        }
    }

    /// Describes what is missing if the recording ended without the count of its samples.
    pub(crate) fn cut(&self) -> Option<String> {
        let (file, line) = (self.file.display(), self.line);
        let what = match self.end {
            Ending::Counted => return None,
            Ending::Torn => format!("ends in the middle of line {line}, which is left out"),
            Ending::None => format!("ends after line {line} without the count of its samples"),
        };
        Some(format!(
            "{file}: {what}: it was cut, or what wrote it was ended; allowed: a last line {{\"samples\":N}}"
        ))
    }

    /// A problem in the line that was last read.
    pub(crate) fn error(&self, problem: String) -> RecordingError {
        RecordingError::Line {
            file: self.file.clone(),
            line: self.line,
            problem,
        }
    }

    /// The line that was last read.
    pub(crate) fn line(&self) -> usize {
        self.line
    }

    /// The names of the file and of the scene in it.
    pub(crate) fn scene_name(&self) -> PathBuf {
        PathBuf::from(format!("{}, scene {}", self.file.display(), self.head.name))
    }
}

/// Returns whether a first line is that of a trace: a record, or the names of the columns.
fn is_trace(text: &[u8]) -> bool {
    #[derive(Deserialize)]
    #[expect(dead_code, reason = "that they are there is what counts")]
    struct Keys {
        t: IgnoredAny,
        hand: IgnoredAny,
        pose: IgnoredAny,
    }
    text.starts_with(b"t,hand_x,") || serde_json::from_slice::<Keys>(text).is_ok()
}

/// The message of serde_json, without its position in a text of a single line.
fn plain(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    match text.strip_suffix(&place) {
        Some(problem) => format!("{problem}, column {}", error.column()),
        None => text,
    }
}
