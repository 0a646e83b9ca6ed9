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

mod line;

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use stiction_scene::{Sample, SceneFile};
use stiction_tools::files::part;
use tempfile::NamedTempFile;

use crate::record::{Frame, Run, Scenery};
use crate::settings::Settings;
use crate::trace::Record;
use line::{End, LineIn, LineOut, Written};

/// The version of the format.
const VERSION: u32 = 2;

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

impl Head {
    /// Of a run of this program.
    pub(crate) fn new(scene: &SceneFile, settings: &Settings) -> Self {
        let (file, text) = (scene.source().file(), scene.source().text());
        Self {
            recording: VERSION,
            build: this_build(),
            number: settings.number.name().to_owned(),
            evolution: settings.evolution.name().to_owned(),
            budget: settings.budget,
            friction: true,
            weight: true,
            name: file
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned(),
            scene: text.to_owned(),
        }
    }
}

/// A recording that is being written; it appears in its place with [`RecordingWriter::finish`], or not at all.
#[derive(Debug)]
pub(crate) struct RecordingWriter {
    place: PathBuf,
    scenery: Scenery,
    single: bool,
    samples: u64,
    writer: BufWriter<NamedTempFile>,
}

impl RecordingWriter {
    /// Begins the recording of `run` that is to stand at `place`.
    ///
    /// # Errors
    /// The folder of `place` cannot be written to.
    pub(crate) fn create(place: &Path, head: &Head, run: &Run) -> io::Result<Self> {
        let mut writer = BufWriter::new(part(place)?);
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

    /// Ends the recording with the count of its samples and puts it in its place.
    ///
    /// # Errors
    /// The file cannot be written or moved.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        let samples = self.samples;
        serde_json::to_writer(&mut self.writer, &End { samples })?;
        self.writer.write_all(b"\n")?;
        let file = self
            .writer
            .into_inner()
            .map_err(io::IntoInnerError::into_error)?;
        file.persist(&self.place)?;
        Ok(())
    }
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

/// A recording that is read sample by sample.
#[derive(Debug)]
pub(crate) struct Recording {
    file: PathBuf,
    line: usize,
    samples: u64,
    ended: bool,
    reader: BufReader<File>,
    pub(crate) head: Head,
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
        let mut text = String::new();
        reader.read_line(&mut text).map_err(cannot_read)?;
        let error = |problem: String| RecordingError::Line {
            file: file.to_owned(),
            line: 1,
            problem,
        };
        let unread = |e: serde_json::Error| {
            error(format!("{}, allowed: the head of a recording", plain(&e)))
        };
        let made: Made = serde_json::from_str(&text).map_err(unread)?;
        made.check().map_err(error)?;
        let head: Head = serde_json::from_str(&text).map_err(unread)?;
        Ok(Self {
            file: file.to_owned(),
            line: 1,
            samples: 0,
            ended: false,
            reader,
            head,
        })
    }

    /// The next sample with the text of its answer; nothing at the end.
    ///
    /// # Errors
    /// The file cannot be read, the line is no sample, or the last line counts others than there are.
    pub(crate) fn next(&mut self) -> Result<Option<(Sample, Option<String>)>, RecordingError> {
        let Some(text) = self.next_line()? else {
            return Ok(None);
        };
        if let Ok(end) = serde_json::from_str::<End>(&text) {
            self.end(&end)?;
            return Ok(None);
        }
        let line: LineIn = serde_json::from_str(&text).map_err(|error| {
            let allowed = "a sample and its answer, or the count of the samples";
            self.error(format!("{}, allowed: {allowed}", plain(&error)))
        })?;
        self.samples += 1;
        let answer = line.answer.map(|answer| answer.get().to_owned());
        Ok(Some((line.sample.sample(), answer)))
    }

    /// The text of the next line; nothing at the end of the file.
    fn next_line(&mut self) -> Result<Option<String>, RecordingError> {
        let mut text = String::new();
        let count = self
            .reader
            .read_line(&mut text)
            .map_err(|error| RecordingError::Read {
                file: self.file.clone(),
                error,
            })?;
        self.line += usize::from(count > 0);
        Ok((count > 0).then_some(text))
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
        self.ended = true;
        match self.next_line()? {
            Some(_) => {
                Err(self.error("follows the count of the samples, allowed: nothing".to_owned()))
            }
            None => Ok(()),
        }
    }

    /// What is missing where the recording ended without the count of its samples.
    pub(crate) fn cut(&self) -> Option<String> {
        (!self.ended).then(|| {
            format!(
                "{}: ends after line {} without the count of its samples: it was cut, or what wrote it was ended; allowed: a last line {{\"samples\":N}}",
                self.file.display(),
                self.line
            )
        })
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

/// What serde_json says, without its place in a text of a single line.
fn plain(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    match text.strip_suffix(&place) {
        Some(problem) => format!("{problem}, column {}", error.column()),
        None => text,
    }
}
