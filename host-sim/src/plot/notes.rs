//! The events of a run, and the limits of its answers, as notes above a time axis, arranged in rows so that none covers another.
//! Lengths in px.

use super::sheet::{Area, Drawn, px, stroke};
use super::style::{FAINT, SMALL, font, text_width};
use plotters::prelude::*;
use stiction_core::{Event, Status};
use stiction_live::record::Frame;

const ROW: f64 = 13.0;
const MOST_ROWS: usize = 3;
const SPACE: f64 = 4.0;

/// The events of a frame, except slips and slides, which have their own marks; and the status when it changes from ok.
pub(super) struct Note {
    /// When [s].
    pub(super) t: f64,
    /// Position on the time axis.
    x: f64,
    names: String,
    /// Where the names begin.
    start: f64,
    /// The row from the top; `None`: no room for the names.
    row: Option<usize>,
}

pub(super) struct Notes {
    pub(super) notes: Vec<Note>,
    rows: usize,
}

impl Notes {
    /// Arranges the notes in as few rows as possible, left of `end`; `place` maps time to the axis.
    pub(super) fn new(frames: &[Frame], place: impl Fn(f64) -> f64, end: f64) -> Self {
        let mut status = Status::Ok;
        let note = |frame: &Frame| {
            let before = std::mem::replace(&mut status, frame.status);
            let limited =
                (frame.status != before && frame.status != Status::Ok).then(|| frame.status.name());
            let marked = [Event::Slip, Event::Slide, Event::Stop];
            let events = frame.events.iter().filter(|event| !marked.contains(event));
            let names = tally(events.map(|event| event.name()).chain(limited));
            let (x, width) = (place(frame.t), text_width(&names, SMALL));
            let fits = x + SPACE + width <= end;
            let start = if fits { x + SPACE } else { x - SPACE - width };
            (!names.is_empty()).then_some(Note {
                t: frame.t,
                x,
                names,
                start,
                row: None,
            })
        };
        let mut notes: Vec<Note> = frames.iter().filter_map(note).collect();
        let most = if notes.is_empty() { 0 } else { MOST_ROWS };
        let rows = (1..=most)
            .find(|&rows| set(&mut notes, rows))
            .unwrap_or(most);
        notes.dedup_by(|note, before| note.row.is_none() && note.x - before.x < 1.0);
        Self { notes, rows }
    }

    pub(super) fn height(&self) -> f64 {
        self.rows as f64 * ROW + SPACE
    }

    /// Draws the notes with ticks down to the lower edge of the area.
    pub(super) fn draw(&self, area: &Area) -> Drawn {
        for note in &self.notes {
            let top = note
                .row
                .map_or(self.height() - 5.0, |row| row as f64 * ROW + 2.0);
            let tick = vec![(px(note.x), px(top)), (px(note.x), px(self.height()))];
            area.draw(&PathElement::new(tick, stroke(FAINT, 1.0)))?;
            if let Some(row) = note.row {
                let middle = (row as f64 + 0.5) * ROW;
                area.draw_text(&note.names, &font(SMALL), (px(note.start), px(middle)))?;
            }
        }
        Ok(())
    }
}

/// Names in the order of their first use, with the number of their uses: "touch ×2, lift".
pub(super) fn tally(names: impl Iterator<Item = &'static str>) -> String {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for name in names {
        match counts.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => counts.push((name, 1)),
        }
    }
    let text = |(name, count): &(&str, usize)| match count {
        1 => (*name).to_owned(),
        count => format!("{name} ×{count}"),
    };
    counts.iter().map(text).collect::<Vec<_>>().join(", ")
}

/// Arranges notes in rows from the top; a note may neither cover another one nor draw its tick through one below. Returns whether
/// all found room.
fn set(notes: &mut [Note], rows: usize) -> bool {
    let mut ends = vec![0.0; rows];
    for note in notes.iter_mut() {
        let clear =
            |row: &usize| ends[*row] <= note.start && ends[*row..].iter().all(|&end| end <= note.x);
        note.row = (0..rows).find(clear);
        if let Some(row) = note.row {
            ends[row] = note.start + text_width(&note.names, SMALL) + SPACE;
        }
    }
    notes.iter().all(|note| note.row.is_some())
}
