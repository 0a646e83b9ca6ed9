//! An input file held as text, and the message that says what is wrong in it and where.

use std::fmt;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

/// Input that cannot be used: the file, the line, what is wrong there and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputError {
    file: PathBuf,
    line: Option<(usize, String)>,
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

    /// What is wrong and what is allowed, without the file and the line.
    pub fn problem(&self) -> &str {
        &self.problem
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (file, problem) = (self.file.display(), &self.problem);
        match &self.line {
            None => write!(f, "{file}: {problem}"),
            Some((number, text)) => {
                write!(f, "{file}, line {number}: {problem}\n{number:>6} | {text}")
            }
        }
    }
}

impl std::error::Error for InputError {}

/// What a message shows of a text: its first 100 characters.
pub(crate) fn excerpt(text: &str) -> String {
    match text.char_indices().nth(100) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

/// A text file with its name.
#[derive(Clone, Debug)]
pub struct Source {
    file: PathBuf,
    text: String,
}

impl Source {
    /// Text that is there already.
    pub fn new(file: impl Into<PathBuf>, text: impl Into<String>) -> Self {
        let (file, text) = (file.into(), text.into());
        Self { file, text }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// The file cannot be read or is not UTF-8.
    pub fn read(file: &Path) -> Result<Self, InputError> {
        let bytes = std::fs::read(file)
            .map_err(|error| InputError::of_file(file, format!("cannot be read: {error}")))?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = 1 + good.iter().filter(|&&byte| byte == b'\n').count();
            InputError::of_file(file, format!("line {line} is not UTF-8 text"))
        })?;
        Ok(Self::new(file, text.trim_start_matches('\u{feff}')))
    }

    /// The name of the file.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// Its text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The file as TOML has it.
    ///
    /// # Errors
    /// It is not TOML, or not what T takes.
    pub fn toml<T: DeserializeOwned>(&self) -> Result<T, InputError> {
        toml::from_str(&self.text).map_err(|error| match error.span() {
            Some(span) if span.start > 0 || span.len() < self.text.len() => {
                self.error_at(span.start, error.message())
            }
            _ => self.error(error.message()),
        })
    }

    /// A problem of the whole file.
    pub fn error(&self, problem: impl fmt::Display) -> InputError {
        InputError::of_file(&self.file, problem)
    }

    /// A problem in the line that holds the byte at `offset`.
    pub fn error_at(&self, offset: usize, problem: impl fmt::Display) -> InputError {
        let before = self.text.get(..offset).unwrap_or(&self.text);
        self.error_in_line(1 + before.matches('\n').count(), problem)
    }

    /// A problem in a line, counted from 1.
    pub(crate) fn error_in_line(&self, line: usize, problem: impl fmt::Display) -> InputError {
        let text = self.text.lines().nth(line.saturating_sub(1)).unwrap_or("");
        InputError {
            line: Some((line, excerpt(text.trim_end()))),
            ..self.error(problem)
        }
    }
}
