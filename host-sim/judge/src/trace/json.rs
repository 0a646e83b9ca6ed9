//! JSON Lines: one object per line. A number that is not finite is `null`, as JSON writers output it.

use std::borrow::Cow;
use std::fs::File;
use std::io::BufReader;

use serde::{Deserialize, Deserializer};

use super::{LONGEST_RECORD, Line, Names, Told, event, sliding, state, status};
use crate::frame::{Contact, Frame};

#[derive(Deserialize)]
struct Object<'a> {
    #[serde(deserialize_with = "number")]
    t: f64,
    hand: [Option<f64>; 3],
    held: bool,
    pose: [Option<f64>; 3],
    #[serde(default, deserialize_with = "number")]
    depth: f64,
    #[serde(borrow)]
    state: Cow<'a, str>,
    #[serde(borrow)]
    contacts: Vec<Entry<'a>>,
    wrench: [Option<f64>; 3],
    slips: u32,
    #[serde(borrow)]
    events: Vec<Cow<'a, str>>,
    #[serde(borrow)]
    status: Cow<'a, str>,
    behind: Option<f64>,
}

#[derive(Deserialize)]
struct Entry<'a> {
    vertex: Option<usize>,
    #[serde(borrow)]
    surface: Option<Cow<'a, str>>,
    #[serde(borrow)]
    obstacle: Option<Cow<'a, str>>,
    side: Option<usize>,
    corner: Option<usize>,
    body_side: Option<usize>,
    point: [Option<f64>; 2],
    direction: Option<[Option<f64>; 2]>,
    #[serde(deserialize_with = "number")]
    normal: f64,
    #[serde(deserialize_with = "number")]
    friction: f64,
    sliding: Option<i64>,
}

impl Entry<'_> {
    fn told(&self) -> Told<'_> {
        Told {
            vertex: self.vertex,
            surface: self.surface.as_deref(),
            obstacle: self.obstacle.as_deref(),
            side: self.side,
            corner: self.corner,
            body_side: self.body_side,
        }
    }
}

fn number<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(finite(Option::deserialize(deserializer)?))
}

fn finite(number: Option<f64>) -> f64 {
    number.unwrap_or(f64::NAN)
}

pub(super) struct Lines(stiction_text::Lines<BufReader<File>>);

impl Lines {
    pub(super) fn new(file: BufReader<File>) -> Self {
        Self(stiction_text::Lines::new(file, LONGEST_RECORD))
    }

    /// The next line that is not blank, with its number.
    pub(super) fn next(&mut self, names: &Names) -> Option<Line> {
        loop {
            let line = self.0.number() as u64 + 1;
            match self.0.advance() {
                Ok(None) => return None,
                Ok(Some(text)) if text.trim_ascii().is_empty() => {}
                Ok(Some(text)) => return Some((line, frame(text, names))),
                Err(problem) => return Some((line, Err(problem))),
            }
        }
    }
}

fn frame(text: &[u8], names: &Names) -> Result<Frame, String> {
    let object: Object<'_> = serde_json::from_slice(text).map_err(|error| problem(text, &error))?;
    let contact = |(i, entry): (usize, &Entry<'_>)| {
        Ok(Contact {
            touch: names.touch(i, &entry.told())?,
            point: entry.point.map(finite),
            direction: entry.direction.map(|direction| direction.map(finite)),
            normal: entry.normal,
            friction: entry.friction,
            sliding: entry.sliding.map(|sign| sliding(i, sign)).transpose()?,
        })
    };
    let contacts = object.contacts.iter().enumerate().map(contact);
    let events = object.events.iter().map(|name| event(name));
    Ok(Frame {
        t: object.t,
        hand: object.hand.map(finite),
        held: object.held,
        pose: object.pose.map(finite),
        depth: object.depth,
        state: state(&object.state)?,
        contacts: contacts.collect::<Result<_, String>>()?,
        complete: true,
        wrench: object.wrench.map(finite),
        slips: object.slips,
        events: events.collect::<Result<_, String>>()?,
        status: status(&object.status)?,
        behind: object.behind,
    })
}

/// The problem in a line, and the key after which it occurs.
fn problem(text: &[u8], error: &serde_json::Error) -> String {
    let message = error.to_string();
    let message = message.split(" at line ").next().unwrap_or_default();
    let column = error.column();
    let before = String::from_utf8_lossy(text.get(..column).unwrap_or(text));
    let key = before.rfind("\":").and_then(|end| {
        let start = before[..end].rfind('"')?;
        Some(format!(", near `{}`", &before[start + 1..end]))
    });
    format!(
        "{message}, at column {column}{}; allowed: a JSON object with the keys of a trace",
        key.unwrap_or_default()
    )
}
