//! Who follows a stream: the console with a trace, or a program that shows the board.

use std::time::Duration;

use stiction_scene::Sample;

use super::counts::Counts;
use super::error::BoardError;
use super::print::Screen;
use crate::files::Files;
use crate::record::Frame;

/// Is told how a stream goes.
pub(super) trait Audience {
    /// The answer to a sample, so long after it was sent; none where a part of it is missing.
    fn frame(
        &mut self,
        sample: &Sample,
        answer: Option<Frame>,
        latency: Duration,
    ) -> Result<(), BoardError>;

    /// A sample that none will answer.
    fn lost(&mut self, sample: &Sample) -> Result<(), BoardError>;

    /// The counts, often.
    fn counts(&mut self, counts: &Counts);

    /// Something worth a line to the user.
    fn note(&mut self, text: &str);

    /// The board is gone.
    fn gone(&mut self);

    /// It is back, at the start of its scene.
    fn back(&mut self);

    /// What became of a wish. An error that does not let the stream go on is given back.
    fn answer(&mut self, result: Result<(), BoardError>) -> Result<(), BoardError>;
}

/// A line on the screen, a trace and a recording where they are wanted.
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
