//! Why a board could not be worked with.

use std::path::PathBuf;

use stiction_core::frame::FaultKind;
use stiction_scene::InputError;
use stiction_tools::process::EmulatorError;

use super::line::Line;
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
        "{0}: the board speaks another version of the wire format, allowed: {version}",
        version = stiction_core::frame::VERSION
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

/// What came over a line on which nothing that was waited for came.
pub(super) fn what_came(line: &Line) -> String {
    if line.frames > 0 {
        return format!("{} frames came, none of them that", line.frames);
    }
    if line.echoes > 0 {
        return "the line sends back what is sent to it: an echo, no board of this format"
            .to_owned();
    }
    if line.bytes == 0 {
        return "not a single byte came".to_owned();
    }
    let faults: Vec<String> = FaultKind::ALL
        .iter()
        .map(|kind| (kind.name(), line.faults().of(*kind)))
        .filter(|(_, count)| *count > 0)
        .map(|(name, count)| format!("{name} {count}"))
        .collect();
    let why = match faults.is_empty() {
        true => String::new(),
        false => format!(" ({})", faults.join(", ")),
    };
    format!("{} bytes came, no frame among them{why}", line.bytes)
}
