//! Writes a recording line by line: to a temporary file that is moved to its destination when it is complete, or, for a process
//! that happens only once, directly to the destination.

use std::fs::{self, File};
use std::io::{self, BufWriter, LineWriter, Write};
use std::path::{Path, PathBuf};

use crate::files::whole::part;
use fs4::{FileExt, TryLockError};
use stiction_scene::Sample;
use tempfile::NamedTempFile;

use super::line::{ChangeLine, End, LineOut, WrittenSample};
use super::{Change, Head, PIECE};
use stiction_live::record::{Frame, Run};

/// A recording that is being written. One in a temporary file appears at its destination with [`RecordingWriter::finish`], or not
/// at all.
#[derive(Debug)]
pub(crate) struct RecordingWriter<W: Write = BufWriter<NamedTempFile>> {
    place: PathBuf,
    run: Run,
    samples: u64,
    writer: W,
}

/// A recording of a process that happens only once: it is at its destination from the beginning, and every line as soon as it is
/// complete.
pub(crate) type LiveWriter = RecordingWriter<LineWriter<File>>;

impl<W: Write> RecordingWriter<W> {
    fn begin(place: &Path, mut writer: W, head: &Head, run: &Run) -> io::Result<Self> {
        serde_json::to_writer(&mut writer, head)?;
        writer.write_all(b"\n")?;
        Ok(Self {
            place: place.to_owned(),
            run: run.clone(),
            samples: 0,
            writer,
        })
    }

    /// Adds a sample and its answer.
    pub(crate) fn write(&mut self, sample: &Sample, answer: Option<&Frame>) -> io::Result<()> {
        let line = LineOut {
            sample: WrittenSample::new(sample),
            answer: answer.map(|frame| self.run.record(frame)),
        };
        serde_json::to_writer(&mut self.writer, &line)?;
        self.samples += 1;
        self.writer.write_all(b"\n")
    }

    /// From the next sample on, the body is under another setting, that of `run`.
    pub(crate) fn change(&mut self, change: &Change, run: &Run) -> io::Result<()> {
        self.run = run.clone();
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
    /// Begins the recording of `run` with the destination `place`.
    pub(crate) fn create(place: &Path, head: &Head, run: &Run) -> io::Result<Self> {
        Self::begin(place, BufWriter::new(part(place)?), head, run)
    }

    /// Ends the recording with the count of its samples and moves it to its destination.
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
    /// Begins a recording at `place`, which must not exist yet.
    pub(crate) fn live(place: &Path, head: &Head, run: &Run) -> io::Result<Self> {
        let file = File::options().write(true).create_new(true).open(place)?;
        // If the system has no locks, another program may mistake it for one that was cut.
        let _ = FileExt::try_lock(&file);
        let begun = Self::begin(place, LineWriter::with_capacity(PIECE, file), head, run);
        if begun.is_err() {
            // There is no room for it. A file without a head is no recording.
            let _ = fs::remove_file(place);
        }
        begun
    }

    pub(crate) fn place(&self) -> &Path {
        &self.place
    }

    /// Ends the recording with the count of its samples.
    pub(crate) fn finish_live(mut self) -> io::Result<()> {
        self.end()
    }
}

/// Returns whether a program is still writing a recording.
pub(crate) fn is_being_written(place: &Path) -> bool {
    let locked = |file: File| {
        matches!(
            FileExt::try_lock_shared(&file),
            Err(TryLockError::WouldBlock)
        )
    };
    stiction_scene::text::open(place, u64::MAX).is_ok_and(locked)
}
