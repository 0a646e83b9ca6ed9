//! The errors of working with a board.

use std::path::PathBuf;

use crate::firmware::process::EmulatorError;
use stiction_scene::InputError;
use stiction_wire::VERSION;

use crate::files::WriteError;

/// The reason why working with a board failed.
#[derive(Debug, thiserror::Error)]
pub enum BoardError {
    /// The scene or the hand's path cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The trace or the recording cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The emulated board cannot be built or started.
    #[error(transparent)]
    Emulator(#[from] EmulatorError),
    /// There is no board, or it was disconnected.
    #[error("{address}: {problem}")]
    Gone {
        /// Where the board was expected.
        address: String,
        /// The system's message.
        problem: String,
    },
    /// Nothing arrived in time.
    #[error("{address}: no {what} within {seconds} s; {came}")]
    Silent {
        /// Where the board is.
        address: String,
        /// What was expected.
        what: String,
        /// The time that it was waited for.
        seconds: f64,
        /// What arrived instead.
        came: String,
    },
    /// Another version of the wire format.
    #[error("{0}: the board speaks another version of the wire format, allowed: {VERSION}")]
    Version(String),
    /// The board refuses a command, or the scene is too large for it.
    #[error("{0}")]
    Refused(String),
    /// The tracker is missing, or was disconnected.
    #[error("tracker {}: {problem}", place.display())]
    Tracker {
        /// Its port.
        place: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// The user ended the operation.
    #[error("ended before the board was ready")]
    Stopped,
}

impl BoardError {
    /// Returns whether the board may come back.
    pub(super) const fn may_pass(&self) -> bool {
        matches!(self, Self::Gone { .. } | Self::Silent { .. })
    }
}
