//! The times of slides, as bars above a time axis: distinct from the marks of slips, which have lengths.

use super::legend::{Entry, Mark};
use super::page::Page;
use super::sheet::{Area, Drawn, px};
use super::style::{SLIDE, TEXT, font, number, round};
use plotters::prelude::*;
use std::ops::Range;
use stiction_live::record::Frame;

/// Height of the bars [px].
const BAR: f64 = 9.0;
/// Maximum number of distinguished bars.
const COLUMNS: usize = 900;

pub(super) struct Slides {
    /// From the frame that reports it to the first one after that which does not [s].
    spans: Vec<Range<f64>>,
    /// Total over all frames [s].
    seconds: f64,
}

impl Slides {
    /// Of frames up to the end of the time axis [s]. In a column of many frames a slide of one of them shows.
    pub(super) fn of(frames: &[Frame], end: f64) -> Self {
        let slides = |frame: &Frame| frame.contacts.iter().any(|contact| contact.sliding != 0);
        let until = |index: usize| frames.get(index).map_or(end, |next| next.t);
        let lasting = frames.iter().enumerate().filter(|(_, frame)| slides(frame));
        let seconds = lasting.map(|(i, frame)| until(i + 1) - frame.t).sum();
        let group = frames.len().div_ceil(COLUMNS).max(1);
        let mut spans: Vec<Range<f64>> = Vec::new();
        for (index, chunk) in frames.chunks(group).enumerate() {
            if !chunk.iter().any(slides) {
                continue;
            }
            let span = chunk[0].t..until((index + 1) * group);
            match spans.last_mut() {
                Some(before) if before.end == span.start => before.end = span.end,
                _ => spans.push(span),
            }
        }
        Self { spans, seconds }
    }

    /// Height of the bars; nothing without a slide.
    pub(super) fn height(&self) -> f64 {
        if self.spans.is_empty() { 0.0 } else { BAR }
    }

    pub(super) fn legend(&self) -> Option<Entry> {
        let text = format!("slides: {} s", number(round(self.seconds)));
        (!self.spans.is_empty()).then(|| Entry::new(Mark::Box(SLIDE), text))
    }

    /// Draws the bars; `place` maps time to the axis [px].
    pub(super) fn draw(&self, area: &Area, page: &Page, place: impl Fn(f64) -> f64) -> Drawn {
        if self.spans.is_empty() {
            return Ok(());
        }
        for span in &self.spans {
            let [begin, end] = [span.start, span.end].map(|t| px(place(t)));
            let corners = [(begin, 0), (end.max(begin + px(1.0)), px(BAR))];
            area.draw(&Rectangle::new(corners, SLIDE.filled()))?;
        }
        area.draw_text("slide", &font(TEXT), (px(page.edge + 10.0), px(BAR / 2.0)))
    }
}
