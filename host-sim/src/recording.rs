//! A recording: a scene, how it is run, every sample of the hand and every answer, so that a run can be repeated bit for bit
//! and told from one that differs. A text file of JSON Lines, numbers printed so that they read back to the same value:
//!
//! ```text
//! {"recording":2,"build":"...","number":"f32","evolution":"path",
//!  "friction":true,"weight":true,"name":"box.toml","scene":"[body]\n..."}
//! {"sample":{"t":0.0,"position":[x,y],"turns":0,"rest":0.1,"depth":0.0,"held":true},"answer":{record of the trace}}
//! {"samples":1}
//! ```
//!
//! A number that is not finite is null in a sample. An answer that did not come is null. `friction` and `weight` say which
//! parts the solver has. A `budget` stands behind the evolution, where a frame had one (units of work). The first sample starts the scene. The last line counts the samples; a recording without it was cut.
//!
//! Between two samples there may be a change: from there on the body goes on where it is, under another setting.
//!
//! ```text
//! {"change":{"number":"f64","evolution":"path","scene":"[body]\n..."}}
//! ```

mod line;

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, LineWriter, Read, Write};
use std::path::{Path, PathBuf};

use fs4::{FileExt, TryLockError};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use stiction_core::Evolution;
use stiction_scene::{Sample, SceneFile};
use stiction_tools::files::part;
use tempfile::NamedTempFile;

use crate::number::Number;
use crate::record::{Frame, Run, Scenery};
use crate::settings::Settings;
use crate::trace::Record;
use line::{ChangeLine, End, LineIn, LineOut, Written};

/// The version of the format.
const VERSION: u32 = 2;
/// The longest line that is read (bytes): a head has the text of its scene, a sample with its answer has some hundred bytes.
const LONGEST_LINE: u64 = 16 << 20;
/// Room for a line that is being written (bytes); a longer one is written in pieces.
const LINE: usize = 64 << 10;

/// What was run, and what made the recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Head {
    pub(crate) recording: u32,
    /// The program, or the board, its version and the machine.
    pub(crate) build: String,
    /// As on the command line.
    pub(crate) number: String,
    pub(crate) evolution: String,
    /// The units of work that a frame may take; absent: as many as it needs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) budget: Option<u32>,
    /// The solver has friction.
    pub(crate) friction: bool,
    /// The solver has weight.
    pub(crate) weight: bool,
    /// The name of the scene file.
    pub(crate) name: String,
    /// Its text.
    pub(crate) scene: String,
}

/// What every version of the format has in its head, and what some had.
#[derive(Clone, Debug, Deserialize)]
struct Made {
    recording: u32,
    build: String,
    tolerance: Option<IgnoredAny>,
}

impl Made {
    /// It is of the version that this program reads, or else what it is.
    fn check(&self) -> Result<(), String> {
        let (found, program) = (self.recording, &self.build);
        if found == VERSION {
            return Ok(());
        }
        let gone = match self.tolerance {
            Some(_) => " and with a `tolerance`, which the solver does not have any more",
            None => "",
        };
        Err(format!(
            "`recording` is {found} (made by {program}{gone}), allowed: {VERSION}, the version of the format that this program reads"
        ))
    }
}

/// The program that runs, and the machine.
pub(crate) fn this_build() -> String {
    let version = env!("CARGO_PKG_VERSION");
    let (arch, os) = (std::env::consts::ARCH, std::env::consts::OS);
    format!("stiction {version}, {arch}, {os}")
}

/// What makes a recording: a program or a board, with the solver that it has.
#[derive(Clone, Debug)]
pub(crate) struct Maker {
    pub(crate) build: String,
    pub(crate) friction: bool,
    pub(crate) weight: bool,
    /// The units of work that a frame may take, where they are bounded.
    pub(crate) budget: Option<u32>,
}

impl Maker {
    /// This program, whose solver has all parts.
    pub(crate) fn this_program() -> Self {
        Self {
            build: this_build(),
            friction: true,
            weight: true,
            budget: None,
        }
    }
}

impl Head {
    /// Of a run of this program.
    pub(crate) fn new(scene: &SceneFile, settings: &Settings) -> Self {
        let maker = Maker {
            budget: settings.budget,
            ..Maker::this_program()
        };
        Self::of(scene, (settings.number, settings.evolution), &maker)
    }

    /// Of what `maker` makes of a scene.
    pub(crate) fn of(
        scene: &SceneFile,
        (number, evolution): (Number, Evolution),
        maker: &Maker,
    ) -> Self {
        let (file, text) = (scene.source().file(), scene.source().text());
        Self {
            recording: VERSION,
            build: maker.build.clone(),
            number: number.name().to_owned(),
            evolution: evolution.name().to_owned(),
            budget: maker.budget,
            friction: maker.friction,
            weight: maker.weight,
            name: file
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned(),
            scene: text.to_owned(),
        }
    }
}

/// A setting under which the body goes on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Change {
    pub(crate) number: String,
    pub(crate) evolution: String,
    /// The text of the scene file.
    pub(crate) scene: String,
}

/// A recording that is being written. One in a part of a file appears in its place with [`RecordingWriter::finish`], or not at all.
#[derive(Debug)]
pub(crate) struct RecordingWriter<W: Write = BufWriter<NamedTempFile>> {
    place: PathBuf,
    scenery: Scenery,
    single: bool,
    samples: u64,
    writer: W,
}

/// A recording of something that happens once: it is in its place from the beginning, and every line as soon as it is whole.
pub(crate) type LiveWriter = RecordingWriter<LineWriter<File>>;

impl<W: Write> RecordingWriter<W> {
    fn begin(place: &Path, mut writer: W, head: &Head, run: &Run) -> io::Result<Self> {
        serde_json::to_writer(&mut writer, head)?;
        writer.write_all(b"\n")?;
        Ok(Self {
            place: place.to_owned(),
            scenery: run.scenery(),
            single: run.number.is_single(),
            samples: 0,
            writer,
        })
    }

    /// Adds a sample and its answer.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(crate) fn write(&mut self, sample: &Sample, answer: Option<&Frame>) -> io::Result<()> {
        let line = LineOut {
            sample: Written::new(sample),
            answer: answer.map(|frame| Record::new(frame, &self.scenery, self.single)),
        };
        serde_json::to_writer(&mut self.writer, &line)?;
        self.samples += 1;
        self.writer.write_all(b"\n")
    }

    /// From the next sample on the body is under another setting, that of `run`.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(crate) fn change(&mut self, change: &Change, run: &Run) -> io::Result<()> {
        (self.scenery, self.single) = (run.scenery(), run.number.is_single());
        serde_json::to_writer(&mut self.writer, &ChangeLine { change })?;
        self.writer.write_all(b"\n")
    }

    fn end(&mut self) -> io::Result<()> {
        let samples = self.samples;
        serde_json::to_writer(&mut self.writer, &End { samples })?;
        self.writer.write_all(b"\n")
    }
}

impl RecordingWriter {
    /// Begins the recording of `run` that is to stand at `place`.
    ///
    /// # Errors
    /// The folder of `place` cannot be written to.
    pub(crate) fn create(place: &Path, head: &Head, run: &Run) -> io::Result<Self> {
        Self::begin(place, BufWriter::new(part(place)?), head, run)
    }

    /// Ends the recording with the count of its samples and puts it in its place.
    ///
    /// # Errors
    /// The file cannot be written or moved.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        self.end()?;
        let file = self
            .writer
            .into_inner()
            .map_err(io::IntoInnerError::into_error)?;
        file.persist(&self.place)?;
        Ok(())
    }
}

impl LiveWriter {
    /// Begins a recording at `place`, where nothing may be yet.
    ///
    /// # Errors
    /// Something is there, or the folder cannot be written to.
    pub(crate) fn live(place: &Path, head: &Head, run: &Run) -> io::Result<Self> {
        let file = File::options().write(true).create_new(true).open(place)?;
        // Where the system has no locks, another program may take it for one that was cut.
        let _ = FileExt::try_lock(&file);
        Self::begin(place, LineWriter::with_capacity(LINE, file), head, run)
    }

    /// Where it is.
    pub(crate) fn place(&self) -> &Path {
        &self.place
    }

    /// Ends the recording with the count of its samples.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(crate) fn finish_live(mut self) -> io::Result<()> {
        self.end()
    }
}

/// Whether a program is still writing a recording.
pub(crate) fn is_being_written(place: &Path) -> bool {
    let locked = |file: File| {
        matches!(
            FileExt::try_lock_shared(&file),
            Err(TryLockError::WouldBlock)
        )
    };
    File::open(place).is_ok_and(locked)
}

/// Why a recording cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// The system does not give it.
    #[error("{}: cannot be read: {error}", file.display())]
    Read {
        /// The recording.
        file: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// A line is not as it must be.
    #[error("{}, line {line}: {problem}", file.display())]
    Line {
        /// The recording.
        file: PathBuf,
        /// Counted from 1.
        line: usize,
        /// What is wrong, and what is allowed.
        problem: String,
    },
}

/// A line below the head of a recording.
#[derive(Clone, Debug)]
pub(crate) enum Line {
    /// A sample with the text of its answer.
    Sample(Sample, Option<String>),
    /// From here on the body is under another setting.
    Change(Change),
}

/// A recording that is read line by line.
#[derive(Debug)]
pub(crate) struct Recording {
    file: PathBuf,
    line: usize,
    samples: u64,
    end: Ending,
    reader: BufReader<File>,
    pub(crate) head: Head,
}

/// How a recording ended, as far as it is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ending {
    /// Without the count of its samples, or not yet.
    None,
    /// In the middle of a line, which is left out.
    Torn,
    /// With the count of its samples.
    Counted,
}

impl Recording {
    /// Opens a recording and reads its head.
    ///
    /// # Errors
    /// It cannot be read, or is none.
    pub(crate) fn open(file: &Path) -> Result<Self, RecordingError> {
        let cannot_read = |error| RecordingError::Read {
            file: file.to_owned(),
            error,
        };
        let mut reader = BufReader::new(File::open(file).map_err(cannot_read)?);
        let text = line_of(&mut reader).map_err(cannot_read)?;
        let error = |problem: String| RecordingError::Line {
            file: file.to_owned(),
            line: 1,
            problem,
        };
        let unread = |e: serde_json::Error| match is_trace(&text) {
            true => error("this is a trace; use `stiction check`".to_owned()),
            false => error(format!("{}, allowed: the head of a recording", plain(&e))),
        };
        let made: Made = serde_json::from_slice(&text).map_err(unread)?;
        made.check().map_err(error)?;
        let head: Head = serde_json::from_slice(&text).map_err(unread)?;
        Ok(Self {
            file: file.to_owned(),
            line: 1,
            samples: 0,
            end: Ending::None,
            reader,
            head,
        })
    }

    /// The next line; nothing at the end.
    ///
    /// # Errors
    /// The file cannot be read, the line is neither a sample nor a change, or the last line counts others than there are.
    pub(crate) fn next(&mut self) -> Result<Option<Line>, RecordingError> {
        let Some(text) = self.next_line()? else {
            return Ok(None);
        };
        if let Ok(end) = serde_json::from_slice::<End>(&text) {
            self.end(&end)?;
            return Ok(None);
        }
        if let Ok(ChangeLine { change }) = serde_json::from_slice(&text) {
            return Ok(Some(Line::Change(change)));
        }
        let line: LineIn = match serde_json::from_slice(&text) {
            Ok(line) => line,
            Err(_) if text.last() != Some(&b'\n') => {
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
        Ok(Some(Line::Sample(line.sample.sample(), answer)))
    }

    /// The text of the next line; nothing at the end of the file.
    fn next_line(&mut self) -> Result<Option<Vec<u8>>, RecordingError> {
        let text = line_of(&mut self.reader).map_err(|error| RecordingError::Read {
            file: self.file.clone(),
            error,
        })?;
        self.line += usize::from(!text.is_empty());
        Ok((!text.is_empty()).then_some(text))
    }

    /// Takes the last line.
    fn end(&mut self, end: &End) -> Result<(), RecordingError> {
        let (counted, there) = (end.samples, self.samples);
        if counted != there {
            let problem = format!(
                "`samples` is {counted}, but {there} are there, allowed: all that were recorded"
            );
            return Err(self.error(problem));
        }
        self.end = Ending::Counted;
        match self.next_line()? {
            Some(_) => {
                Err(self.error("follows the count of the samples, allowed: nothing".to_owned()))
            }
            None => Ok(()),
        }
    }

    /// What is missing where the recording ended without the count of its samples.
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

    /// A problem in the line that was read last.
    pub(crate) fn error(&self, problem: String) -> RecordingError {
        RecordingError::Line {
            file: self.file.clone(),
            line: self.line,
            problem,
        }
    }

    /// The line that was read last.
    pub(crate) fn line(&self) -> usize {
        self.line
    }

    /// The names of the file and of the scene in it.
    pub(crate) fn scene_name(&self) -> PathBuf {
        PathBuf::from(format!("{}, scene {}", self.file.display(), self.head.name))
    }
}

/// The next line with its end, where it has one; empty at the end of the file.
fn line_of(reader: &mut impl BufRead) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    reader.take(LONGEST_LINE).read_until(b'\n', &mut text)?;
    match text.last() {
        Some(last) if *last != b'\n' && text.len() as u64 == LONGEST_LINE => Err(io::Error::other(
            format!("a line of more than {LONGEST_LINE} bytes, allowed: the lines of a recording"),
        )),
        _ => Ok(text),
    }
}

/// Whether a first line is that of a trace: a record, or the names of the columns.
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

/// What serde_json says, without its place in a text of a single line.
fn plain(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    match text.strip_suffix(&place) {
        Some(problem) => format!("{problem}, column {}", error.column()),
        None => text,
    }
}
