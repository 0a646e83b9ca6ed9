//! A recording as it is written: line by line, into a part of a file that appears in its place when it is whole, or, of what happens
//! once, in its place from the beginning.

use std::fs::{self, File};
use std::io::{self, BufWriter, LineWriter, Write};
use std::path::{Path, PathBuf};

use fs4::{FileExt, TryLockError};
use stiction_scene::Sample;
use stiction_tools::files::part;
use tempfile::NamedTempFile;

use super::line::{ChangeLine, End, LineOut, Written};
use super::{Change, Head, PIECE};
use crate::record::{Frame, Run, Scenery};
use crate::trace::Record;

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
        let begun = Self::begin(place, LineWriter::with_capacity(PIECE, file), head, run);
        if begun.is_err() {
            // There is no room for it. What is without a head is no recording.
            let _ = fs::remove_file(place);
        }
        begun
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
    stiction_text::open(place, u64::MAX).is_ok_and(locked)
}
