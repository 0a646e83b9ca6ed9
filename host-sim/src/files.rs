//! The output files of commands: they never replace an input, and no two have the same place. Those that a run writes frame by
//! frame, a trace and a recording if requested, appear in their places when everything is written, or not at all.

pub(crate) mod whole;

use std::io;
use std::path::{Path, PathBuf};

use stiction_scene::Sample;

use crate::recording::{Change, Head, RecordingWriter};
use crate::trace::{Format, TraceWriter};
use stiction_live::record::{Frame, Run};

/// A file cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The system refuses to write it.
    #[error("{}: cannot be written: {error}", file.display())]
    System {
        /// The file.
        file: PathBuf,
        /// The system's message.
        error: io::Error,
    },
    /// It would replace an input.
    #[error("{}: is read and would be written by {by}, allowed: another name", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// The option that names it.
        by: &'static str,
    },
    /// It exists already, and may be somebody's work.
    #[error("{}: is there already and stays as it is, allowed: another name", .0.display())]
    Exists(PathBuf),
    /// It would replace another output.
    #[error(
        "{}: would be written by {} and by {}, allowed: a name for each",
        file.display(), by[0], by[1]
    )]
    Twice {
        /// The file.
        file: PathBuf,
        /// The options that name it.
        by: [&'static str; 2],
    },
}

impl WriteError {
    pub(crate) fn of(file: &Path) -> impl FnOnce(io::Error) -> Self {
        let file = file.to_owned();
        |error| Self::System { file, error }
    }
}

/// Resolves a name; if the file does not exist yet, from the nearest folder that does.
fn place(file: &Path) -> PathBuf {
    let absolute = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    let whole = absolute.ancestors().find_map(|folder| {
        let rest = absolute.strip_prefix(folder).ok()?;
        Some(
            folder
                .canonicalize()
                .ok()?
                .components()
                .chain(rest.components())
                .collect(),
        )
    });
    whole.unwrap_or(absolute)
}

/// An option and the file that it makes the program write.
pub(crate) type Written = (&'static str, PathBuf);

/// Checks the names of all files that a command reads (if the file exists) and writes, before anything is written.
pub(crate) fn check<'a>(
    read: impl IntoIterator<Item = &'a Path>,
    written: impl IntoIterator<Item = Written>,
) -> Result<(), WriteError> {
    let read = read.into_iter().filter(|file| file.exists());
    let read: Vec<PathBuf> = read.map(place).collect();
    let mut known: Vec<Written> = Vec::new();
    for (by, file) in written {
        let there = place(&file);
        if read.contains(&there) {
            return Err(WriteError::Read { file, by });
        }
        if let Some((before, _)) = known.iter().find(|(_, place)| *place == there) {
            let by = [*before, by];
            return Err(WriteError::Twice { file, by });
        }
        known.push((by, there));
    }
    Ok(())
}

/// The trace and the recording that [`Files`] writes.
pub(crate) fn written(
    out: Option<&(PathBuf, Format)>,
    record: Option<&PathBuf>,
) -> impl Iterator<Item = Written> {
    let out = out.map(|(file, _)| ("--out", file.clone()));
    let record = record.map(|file| ("--record", file.clone()));
    out.into_iter().chain(record)
}

/// A trace and a recording, or one of them, or none.
#[derive(Debug)]
pub(crate) struct Files {
    trace: Option<(PathBuf, TraceWriter)>,
    recording: Option<(PathBuf, RecordingWriter)>,
}

impl Files {
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

    /// From here on, the body is under another setting, that of `run`.
    pub(crate) fn change(&mut self, change: &Change, run: &Run) -> Result<(), WriteError> {
        if let Some((_, writer)) = &mut self.trace {
            writer.change(run);
        }
        match &mut self.recording {
            Some((file, writer)) => writer.change(change, run).map_err(WriteError::of(file)),
            None => Ok(()),
        }
    }

    /// Moves both to their places.
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
