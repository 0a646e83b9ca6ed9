//! Who follows a stream: the console with a trace, or a program that shows the board.

use std::time::Duration;

use super::counts::Counts;
use super::error::BoardError;
use super::print::Screen;
use super::trace::Trace;
use crate::record::Frame;

/// Is told how a stream goes.
pub(super) trait Audience {
    /// The answer to a sample, so long after it was sent.
    fn frame(&mut self, frame: Frame, latency: Duration) -> Result<(), BoardError>;

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

/// A line on the screen, and a trace where one is wanted.
#[derive(Debug)]
pub(super) struct Console {
    pub(super) screen: Screen,
    pub(super) trace: Trace,
}

impl Audience for Console {
    fn frame(&mut self, frame: Frame, _latency: Duration) -> Result<(), BoardError> {
        self.trace.write(&frame)
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
