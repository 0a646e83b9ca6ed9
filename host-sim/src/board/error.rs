//! Why a board could not be worked with.

use std::path::PathBuf;

use stiction_core::frame::{VERSION, VERSION_AMONG};
use stiction_scene::InputError;
use stiction_tools::process::EmulatorError;

use crate::files::WriteError;

/// Why a board could not be worked with.
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
    /// There is no board, or it went away.
    #[error("{address}: {problem}")]
    Gone {
        /// Where the board was looked for.
        address: String,
        /// What the system says.
        problem: String,
    },
    /// Nothing came in time.
    #[error("{address}: no {what} within {seconds} s; {came}")]
    Silent {
        /// Where the board is.
        address: String,
        /// What was waited for.
        what: String,
        /// So long.
        seconds: f64,
        /// What came instead.
        came: String,
    },
    /// Another version of the wire format.
    #[error(
        "{0}: the board speaks another version of the wire format, allowed: {VERSION}, and {VERSION_AMONG} for obstacles"
    )]
    Version(String),
    /// The board refuses a command, or the scene is too large for it.
    #[error("{0}")]
    Refused(String),
    /// The tracker is not there, or went away.
    #[error("tracker {}: {problem}", place.display())]
    Tracker {
        /// Its port.
        place: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// The user ended it.
    #[error("ended before the board was ready")]
    Stopped,
}

impl BoardError {
    /// The board may come back.
    pub(super) const fn may_pass(&self) -> bool {
        matches!(self, Self::Gone { .. } | Self::Silent { .. })
    }
}
