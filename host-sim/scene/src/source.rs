//! An input file as text, and the message that states the problem in it and its position.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::text::{self, unknown};

/// Unusable input: the file, the line, the problem there and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputError {
    file: PathBuf,
    line: Option<u64>,
    /// The text of the line, where it helps.
    text: Option<String>,
    problem: String,
}

impl InputError {
    /// A problem of a whole file.
    pub fn of_file(file: &Path, problem: impl fmt::Display) -> Self {
        Self {
            file: file.to_owned(),
            line: None,
            text: None,
            problem: problem.to_string(),
        }
    }

    /// A problem of a line, counted from 1.
    pub fn at_line(file: &Path, line: u64, problem: impl fmt::Display) -> Self {
        Self {
            line: Some(line),
            ..Self::of_file(file, problem)
        }
    }

    /// A problem of a line with its number, counted from 1, and its text.
    pub(crate) fn in_line(
        file: &Path,
        (number, text): (usize, &str),
        problem: impl fmt::Display,
    ) -> Self {
        Self {
            text: Some(excerpt(text.trim_end())),
            ..Self::at_line(file, number as u64, problem)
        }
    }

    /// The problem and what is allowed, without the file and the line.
    pub fn problem(&self) -> &str {
        &self.problem
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (file, problem) = (self.file.display(), &self.problem);
        let Some(number) = self.line else {
            return write!(f, "{file}: {problem}");
        };
        write!(f, "{file}, line {number}: {problem}")?;
        match &self.text {
            Some(text) => write!(f, "\n{number:>6} | {text}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for InputError {}

/// The message about a line that is not text.
pub(crate) fn not_text(line: usize) -> String {
    format!("line {line} is not UTF-8 text")
}

/// The part of a text that a message shows: its first 100 characters.
pub(crate) fn excerpt(text: &str) -> String {
    match text.char_indices().nth(100) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

/// The key below a table whose value is at a position in the text, such as `.spring.rotation` or
/// `.surface[0].normal[1]`.
fn key_of_table(table: &DeTable<'_>, span: &Range<usize>) -> Option<String> {
    let mut entries = table.iter();
    entries.find_map(|(name, value)| Some(format!(".{}{}", name.get_ref(), key_of(value, span)?)))
}

/// The rest of the key from a value on: empty if this is the value.
fn key_of(value: &Spanned<DeValue<'_>>, span: &Range<usize>) -> Option<String> {
    let below = match value.get_ref() {
        DeValue::Table(table) => key_of_table(table, span),
        DeValue::Array(array) => {
            let mut entries = array.iter().enumerate();
            entries.find_map(|(i, value)| Some(format!("[{i}]{}", key_of(value, span)?)))
        }
        _ => None,
    };
    below.or_else(|| (value.span() == *span).then(String::new))
}

/// A key that nothing has, from the reader's message: the one that was probably meant, and all.
fn unknown_key(message: &str) -> Option<String> {
    let (key, rest) = message.strip_prefix("unknown field `")?.split_once('`')?;
    let allowed: Vec<&str> = rest.split('`').skip(1).step_by(2).collect();
    Some(unknown("key", key, &allowed))
}

/// A section of the whole file with one pair of brackets instead of two, or the other way round.
fn brackets(key: &str, allowed: &str) -> Option<String> {
    let is_section = |name: &str| !name.contains(['.', '[']);
    match key.strip_suffix("[0]") {
        Some(name) if is_section(name) => Some(format!(
            "[[{name}]] is for sections of which there can be many, write [{name}]"
        )),
        None if is_section(key) && allowed == "an array" => Some(format!(
            "there can be many of this section, write [[{key}]]"
        )),
        _ => None,
    }
}

/// The story of a scene file with this text; see [`Source::story`].
pub fn story(text: &str) -> Option<&str> {
    let story = text.lines().next()?.strip_prefix('#')?.trim();
    (!story.is_empty()).then_some(story)
}

/// A text file with its name.
#[derive(Clone, Debug)]
pub struct Source {
    file: PathBuf,
    text: String,
}

impl Source {
    /// Text that is already loaded.
    pub fn new(file: impl Into<PathBuf>, text: impl Into<String>) -> Self {
        let (file, text) = (file.into(), text.into());
        Self { file, text }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// The file cannot be read, is longer than 1 MiB, or is not UTF-8.
    pub fn read(file: &Path) -> Result<Self, InputError> {
        let bytes = text::read(file);
        let bytes = bytes.map_err(|problem| InputError::of_file(file, problem))?;
        Self::of_bytes(file, bytes)
    }

    /// The content of a file, without a byte order mark at its beginning.
    ///
    /// # Errors
    /// It is not UTF-8.
    pub fn of_bytes(file: &Path, bytes: Vec<u8>) -> Result<Self, InputError> {
        let text = String::from_utf8(bytes).map_err(|error| {
            let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = 1 + good.iter().filter(|&&byte| byte == b'\n').count();
            InputError::of_file(file, not_text(line))
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

    /// A one-line description of what to observe in the scene: the comment in the first line. `None` if the file begins with something else.
    pub fn story(&self) -> Option<&str> {
        story(&self.text)
    }

    /// The file parsed as TOML.
    ///
    /// # Errors
    /// The file is not TOML, or does not fit T.
    pub fn toml<T: DeserializeOwned>(&self) -> Result<T, InputError> {
        toml::from_str(&self.text).map_err(|error| match error.span() {
            Some(span) if span.start > 0 || span.len() < self.text.len() => {
                let message = error.message();
                if let Some(error) = self.section_twice(&span, message) {
                    return error;
                }
                let explained = (unknown_key(message)).or_else(|| self.mistyped(&span, message));
                self.error_at(span.start, explained.unwrap_or_else(|| message.to_owned()))
            }
            _ => self.error(error.message()),
        })
    }

    /// A section that is given twice although its brackets say that there is only one, from the position of the second one.
    fn section_twice(&self, span: &Range<usize>, message: &str) -> Option<InputError> {
        let number = 1 + self.text.get(..span.start)?.matches('\n').count();
        let header = self.text.lines().nth(number - 1)?.trim();
        let name = header.strip_prefix('[')?.trim_matches(['[', ']']);
        let single = format!("[{name}]");
        let (mut lines, many) = (self.text.lines(), format!("[[{name}]]"));
        if message != "duplicate key" {
            return None;
        }
        let first = 1 + lines.position(|line| line.trim() == single)?;
        Some(match self.text.contains(&many) {
            true => self.error_in_line(
                first,
                format!("there are more of this section, write {many}"),
            ),
            false => self.error_in_line(
                number,
                format!("{single} is there already, in line {first}"),
            ),
        })
    }

    /// A message about a value of a wrong type, from its position and the reader's message: its key, what it is, what
    /// is allowed.
    fn mistyped(&self, span: &Range<usize>, message: &str) -> Option<String> {
        let is_of = |kind| message.strip_prefix(kind);
        let rest = is_of("invalid type: ").or(is_of("invalid value: "))?;
        let (value, expected) = rest.rsplit_once(", expected ")?;
        let allowed = match expected {
            "f64" => "a number",
            "a string" => "a text",
            "a sequence" => "an array",
            "u64" | "u32" => "a whole number, 0 or more",
            _ if expected.starts_with("struct ") => "a section",
            other => other,
        };
        let table = DeTable::parse(&self.text).ok()?;
        let key = key_of_table(table.get_ref(), span)?;
        let key = key.trim_start_matches('.');
        if value == "map"
            && let Some(wrong) = brackets(key, allowed)
        {
            return Some(wrong);
        }
        Some(format!("`{key}` is {value}, allowed: {allowed}"))
    }

    /// A problem of the whole file.
    pub fn error(&self, problem: impl fmt::Display) -> InputError {
        InputError::of_file(&self.file, problem)
    }

    /// A problem in the line that contains the byte at `offset`.
    pub fn error_at(&self, offset: usize, problem: impl fmt::Display) -> InputError {
        let before = self.text.get(..offset).unwrap_or(&self.text);
        self.error_in_line(1 + before.matches('\n').count(), problem)
    }

    /// A problem in a line, counted from 1.
    pub(crate) fn error_in_line(&self, line: usize, problem: impl fmt::Display) -> InputError {
        let text = self.text.lines().nth(line.saturating_sub(1)).unwrap_or("");
        InputError::in_line(&self.file, (line, text), problem)
    }
}
