//! Unusable input: the file, the line, the problem there and what is allowed.

use std::fmt;
use std::path::{Path, PathBuf};

/// Why a scene or a trace cannot be judged.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{}: {problem}", file.display(), Line(*line))]
pub struct InputError {
    file: PathBuf,
    line: Option<u64>,
    problem: String,
}

impl InputError {
    /// A problem of a whole file.
    pub fn of_file(file: &Path, problem: impl fmt::Display) -> Self {
        Self {
            file: file.to_owned(),
            line: None,
            problem: problem.to_string(),
        }
    }

    /// A problem in a line, counted from 1.
    pub(crate) fn in_line(file: &Path, line: u64, problem: impl fmt::Display) -> Self {
        Self {
            line: Some(line),
            ..Self::of_file(file, problem)
        }
    }
}

struct Line(Option<u64>);

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |line| write!(f, ", line {line}"))
    }
}
