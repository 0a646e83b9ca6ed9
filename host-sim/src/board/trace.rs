//! The trace of a stream, where one is wanted.

use std::io;
use std::path::{Path, PathBuf};

use stiction_core::Evolution;

use super::error::BoardError;
use crate::number::Number;
use crate::record::{Frame, Run};
use crate::scene_file::SceneFile;
use crate::trace::{Format, TraceWriter};

/// A trace that is being written, or none.
#[derive(Debug)]
pub(super) struct Trace(Option<(PathBuf, TraceWriter)>);

impl Trace {
    pub(super) fn create(
        out: Option<&(PathBuf, Format)>,
        scene: &SceneFile,
        evolution: Evolution,
    ) -> Result<Self, BoardError> {
        let Some((file, format)) = out else {
            return Ok(Self(None));
        };
        // What a board sends is f32, whatever its solver counts in.
        let run = Run::of(scene, Number::F32, evolution);
        match TraceWriter::create(file, *format, &run) {
            Ok(writer) => Ok(Self(Some((file.clone(), writer)))),
            Err(error) => Err(cannot_write(file, error)),
        }
    }

    pub(super) fn write(&mut self, frame: &Frame) -> Result<(), BoardError> {
        match &mut self.0 {
            Some((file, writer)) => writer
                .write(frame)
                .map_err(|error| cannot_write(file, error)),
            None => Ok(()),
        }
    }

    pub(super) fn finish(self) -> Result<(), BoardError> {
        match self.0 {
            Some((file, writer)) => writer.finish().map_err(|error| cannot_write(&file, error)),
            None => Ok(()),
        }
    }
}

fn cannot_write(file: &Path, error: io::Error) -> BoardError {
    BoardError::Trace {
        file: file.to_owned(),
        error,
    }
}
