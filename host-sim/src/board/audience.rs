//! The audience of a stream: the console with a trace, or a program that displays the board.

use std::time::Duration;

use stiction_scene::Sample;

use super::counts::Counts;
use super::error::BoardError;
use super::print::Screen;
use crate::files::Files;
use stiction_live::record::Frame;

/// Receives the progress of a stream.
pub(super) trait Audience {
    /// The answer to a sample, with the latency since it was sent; none if a part of it is missing.
    fn frame(
        &mut self,
        sample: &Sample,
        answer: Option<Frame>,
        latency: Duration,
    ) -> Result<(), BoardError>;

    /// A sample that will not be answered.
    fn lost(&mut self, sample: &Sample) -> Result<(), BoardError>;

    /// The counts, often.
    fn counts(&mut self, counts: &Counts);

    /// A message for the user, one line.
    fn note(&mut self, text: &str);

    /// The board is disconnected.
    fn gone(&mut self);

    /// The board is connected again, at the start of its scene.
    fn back(&mut self);

    /// The result of a request. Returns an error that must end the stream.
    fn answer(&mut self, result: Result<(), BoardError>) -> Result<(), BoardError>;
}

/// A line on the screen, with a trace and a recording if requested.
#[derive(Debug)]
pub(super) struct Console {
    pub(super) screen: Screen,
    pub(super) files: Files,
}

impl Audience for Console {
    fn frame(
        &mut self,
        sample: &Sample,
        answer: Option<Frame>,
        _latency: Duration,
    ) -> Result<(), BoardError> {
        Ok(self.files.write(sample, answer.as_ref())?)
    }

    fn lost(&mut self, sample: &Sample) -> Result<(), BoardError> {
        Ok(self.files.write(sample, None)?)
    }

    fn counts(&mut self, counts: &Counts) {
        self.screen.show(counts);
    }

    fn note(&mut self, text: &str) {
        self.screen.note(text);
    }

    fn gone(&mut self) {}

    fn back(&mut self) {}

    fn answer(&mut self, result: Result<(), BoardError>) -> Result<(), BoardError> {
        result
    }
}
