//! Reads a trace record by record, JSON Lines or CSV; errors name the file, the line and the key.

mod json;
mod table;

use std::borrow::Borrow;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use crate::error::InputError;
use crate::frame::{Event, Frame, State, Status};
use crate::scene::Scene;
use crate::touch::Touch;

/// The longest allowed record (bytes): 192 contacts, one for each vertex and corner of the largest scene, of a kilobyte each take
/// less than a quarter of it.
const LONGEST_RECORD: usize = 1 << 20;

/// A trace that is being read: an iterator over its frames, each with its line, counted from 1.
pub struct Trace {
    file: PathBuf,
    names: Names,
    lines: Lines,
    failed: bool,
}

enum Lines {
    Json(json::Lines),
    Table(Box<table::Rows>),
}

/// A line, counted from 1, and its frame or the problem.
type Line = (u64, Result<Frame, String>);

impl Trace {
    /// Opens a trace of a scene; its extension, `jsonl` or `csv`, determines the format.
    ///
    /// # Errors
    /// The file cannot be read, has neither extension, or its header lacks a column.
    pub fn open(file: &Path, scene: &Scene) -> Result<Self, InputError> {
        let open = || {
            // The file may have any length: it is read record by record.
            let opened = stiction_text::open(file, u64::MAX);
            opened
                .map(|opened| BufReader::with_capacity(1 << 16, opened))
                .map_err(|problem| InputError::of_file(file, problem))
        };
        let lines = match file.extension().and_then(|extension| extension.to_str()) {
            Some("jsonl") => Lines::Json(json::Lines::new(open()?)),
            Some("csv") => {
                let rows = table::Rows::new(open()?);
                let in_header = |problem| InputError::in_line(file, 1, problem);
                Lines::Table(Box::new(rows.map_err(in_header)?))
            }
            _ => {
                let problem = "allowed: a trace whose name ends in .jsonl or .csv";
                return Err(InputError::of_file(file, problem));
            }
        };
        Ok(Self {
            file: file.to_owned(),
            names: Names {
                surfaces: scene.surfaces.iter().map(|s| s.name.clone()).collect(),
                obstacles: scene.obstacles.iter().map(|o| o.name.clone()).collect(),
                corners: scene.obstacles.iter().map(|o| o.vertices.len()).collect(),
                vertices: scene.vertices.len(),
            },
            lines,
            failed: false,
        })
    }
}

impl Iterator for Trace {
    type Item = Result<(u64, Frame), InputError>;

    /// The next frame; none after an error.
    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let (line, result) = match &mut self.lines {
            Lines::Json(lines) => lines.next(&self.names)?,
            Lines::Table(rows) => rows.next(&self.names)?,
        };
        self.failed = result.is_err();
        let frame = result.map(|frame| (line, frame));
        Some(frame.map_err(|problem| InputError::in_line(&self.file, line, problem)))
    }
}

/// The scene's names of surfaces and obstacles, and the numbers of their vertices and of the body's.
struct Names {
    surfaces: Vec<String>,
    obstacles: Vec<String>,
    corners: Vec<usize>,
    vertices: usize,
}

/// A trace's description of a touch: absent keys are `None`.
struct Told<'a> {
    vertex: Option<usize>,
    surface: Option<&'a str>,
    obstacle: Option<&'a str>,
    side: Option<usize>,
    corner: Option<usize>,
    body_side: Option<usize>,
}

impl Names {
    /// The index of the surface of a contact.
    fn surface(&self, contact: usize, name: &str) -> Result<usize, String> {
        (self.surfaces.iter().position(|known| known == name)).ok_or_else(|| {
            unknown(
                &format!("the `surface` of contact {contact}"),
                name,
                &self.surfaces,
            )
        })
    }

    /// The touching features of a contact.
    fn touch(&self, contact: usize, told: &Told<'_>) -> Result<Touch, String> {
        let obstacle = |name: &str| {
            let place = self.obstacles.iter().position(|known| known == name);
            place.ok_or_else(|| {
                let what = format!("the `obstacle` of contact {contact}");
                unknown(&what, name, &self.obstacles)
            })
        };
        let index = |key: &str, index: usize, count: usize| match count {
            _ if index < count => Ok(index),
            0 => Err(format!(
                "the `{key}` of contact {contact} is {index}, but there is none"
            )),
            _ => Err(format!(
                "the `{key}` of contact {contact} is {index}, allowed: 0 to {}",
                count - 1
            )),
        };
        let sides = |vertices: usize| if vertices < 2 { 0 } else { vertices };
        match *told {
            Told {
                vertex: Some(vertex),
                surface: Some(surface),
                obstacle: None,
                side: None,
                corner: None,
                body_side: None,
            } => Ok(Touch::Surface {
                vertex: index("vertex", vertex, self.vertices)?,
                surface: self.surface(contact, surface)?,
            }),
            Told {
                vertex: Some(vertex),
                surface: None,
                obstacle: Some(name),
                side: Some(side),
                corner: None,
                body_side: None,
            } => {
                let obstacle = obstacle(name)?;
                Ok(Touch::Side {
                    vertex: index("vertex", vertex, self.vertices)?,
                    obstacle,
                    side: index("side", side, sides(self.corners[obstacle]))?,
                })
            }
            Told {
                vertex: None,
                surface: None,
                obstacle: Some(name),
                side: None,
                corner: Some(corner),
                body_side: Some(body_side),
            } => {
                let obstacle = obstacle(name)?;
                Ok(Touch::Corner {
                    obstacle,
                    corner: index("corner", corner, self.corners[obstacle])?,
                    body_side: index("body_side", body_side, sides(self.vertices))?,
                })
            }
            _ => Err(format!(
                "contact {contact}: allowed: `vertex` and `surface`, `vertex`, `obstacle` and `side`, or `corner`, `obstacle` and \
                 `body_side`"
            )),
        }
    }
}

fn unknown<S: Borrow<str>>(what: &str, name: &str, known: &[S]) -> String {
    format!("{what} is {name:?}, allowed: {}", known.join(", "))
}

fn state(name: &str) -> Result<State, String> {
    State::named(name).ok_or_else(|| unknown("`state`", name, State::NAMES))
}

fn event(name: &str) -> Result<Event, String> {
    Event::named(name).ok_or_else(|| unknown("one of `events`", name, Event::NAMES))
}

/// The sign of the slide of a contact.
fn sliding(contact: usize, sign: i64) -> Result<i8, String> {
    match sign {
        -1..=1 => Ok(sign as i8),
        _ => Err(format!(
            "`sliding` of contact {contact} is {sign}, allowed: -1, 0, 1"
        )),
    }
}

fn status(name: &str) -> Result<Status, String> {
    Status::named(name).ok_or_else(|| unknown("`status`", name, Status::NAMES))
}
