//! The files that a run writes frame by frame: a trace and a recording, where they are wanted. They appear in their places
//! when all is written, or not at all.

use std::io;
use std::path::{Path, PathBuf};

use stiction_scene::Sample;

use crate::record::{Frame, Run};
use crate::recording::{Head, RecordingWriter};
use crate::trace::{Format, TraceWriter};

/// A file cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be written: {error}", file.display())]
pub struct WriteError {
    file: PathBuf,
    error: io::Error,
}

impl WriteError {
    pub(crate) fn of(file: &Path) -> impl FnOnce(io::Error) -> Self {
        let file = file.to_owned();
        |error| Self { file, error }
    }
}

/// A trace and a recording, or one of them, or none.
#[derive(Debug)]
pub(crate) struct Files {
    trace: Option<(PathBuf, TraceWriter)>,
    recording: Option<(PathBuf, RecordingWriter)>,
}

impl Files {
    /// Begins a trace of a run, where one is wanted.
    pub(crate) fn trace(file: Option<&(PathBuf, Format)>, run: &Run) -> Result<Self, WriteError> {
        let trace = file.map(|(file, format)| {
            let writer = TraceWriter::create(file, *format, run).map_err(WriteError::of(file))?;
            Ok((file.clone(), writer))
        });
        Ok(Self {
            trace: trace.transpose()?,
            recording: None,
        })
    }

    /// Begins a recording of the run, too, where one is wanted.
    pub(crate) fn with_recording(
        self,
        file: Option<&PathBuf>,
        head: &Head,
        run: &Run,
    ) -> Result<Self, WriteError> {
        let recording = file.map(|file| {
            let writer = RecordingWriter::create(file, head, run).map_err(WriteError::of(file))?;
            Ok((file.clone(), writer))
        });
        Ok(Self {
            recording: recording.transpose()?,
            ..self
        })
    }

    /// Adds a sample and the answer to it, which may not have come.
    pub(crate) fn write(
        &mut self,
        sample: &Sample,
        answer: Option<&Frame>,
    ) -> Result<(), WriteError> {
        if let (Some((file, writer)), Some(frame)) = (&mut self.trace, answer) {
            writer.write(frame).map_err(WriteError::of(file))?;
        }
        if let Some((file, writer)) = &mut self.recording {
            writer.write(sample, answer).map_err(WriteError::of(file))?;
        }
        Ok(())
    }

    /// Puts both in their places.
    pub(crate) fn finish(self) -> Result<(), WriteError> {
        if let Some((file, writer)) = self.trace {
            writer.finish().map_err(WriteError::of(&file))?;
        }
        if let Some((file, writer)) = self.recording {
            writer.finish().map_err(WriteError::of(&file))?;
        }
        Ok(())
    }
}
