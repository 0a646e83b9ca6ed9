//! Headings and legends: rows of marks with their meaning, set from left to right and broken at the width of the sheet.
//! Lengths in px.

use super::page::Page;
use super::sheet::{self, Area, Drawn, part, px, stroke};
use super::style::{INK, TEXT, font, text_width};
use plotters::prelude::*;

/// Height of a row.
const ROW: f64 = 19.0;
/// Width of a mark other than a scale bar.
const MARK: f64 = 24.0;
/// Room right of a heading.
const MARGIN: f64 = 14.0;
/// Room around the title, and height of its lines relative to its type.
const HEADER: f64 = 10.0;
const LEADING: f64 = 1.5;
const GAP: f64 = 6.0;
const SPACE: f64 = 14.0;

#[derive(Clone, Copy)]
pub(super) enum Mark {
    /// A line of this width [px].
    Line(RGBColor, f64),
    Box(RGBColor),
    Dot(RGBColor),
    Ring(RGBColor),
    /// A scale bar of this length [px].
    Scale(f64),
}

impl Mark {
    fn width(self) -> f64 {
        match self {
            Self::Scale(length) => length,
            _ => MARK,
        }
    }
}

pub(super) struct Entry {
    pub(super) mark: Mark,
    pub(super) text: String,
}

impl Entry {
    pub(super) fn new(mark: Mark, text: impl Into<String>) -> Self {
        let text = text.into();
        Self { mark, text }
    }

    fn width(&self) -> f64 {
        self.mark.width() + GAP + text_width(&self.text, TEXT) + SPACE
    }
}

/// The corner of each entry within the legend, and the height of the whole [px].
fn layout(entries: &[Entry], width: f64) -> (Vec<(f64, f64)>, f64) {
    let (mut x, mut y) = (0.0, 0.0);
    let corners = entries
        .iter()
        .map(|entry| {
            if x > 0.0 && x + entry.width() > width {
                (x, y) = (0.0, y + ROW);
            }
            let corner = (x, y);
            x += entry.width();
            corner
        })
        .collect();
    let height = if entries.is_empty() { 0.0 } else { y + ROW };
    (corners, height)
}

/// The height of a legend of the given width [px].
pub(super) fn height(entries: &[Entry], width: f64) -> f64 {
    layout(entries, width).1
}

/// Draws a legend that fills the area's width.
pub(super) fn draw(area: &Area, entries: &[Entry]) -> Drawn {
    let (width, _) = sheet::size(area);
    let (corners, _) = layout(entries, width);
    for (entry, (x, y)) in entries.iter().zip(corners) {
        let middle = y + ROW / 2.0;
        draw_mark(area, entry.mark, (x, middle))?;
        let start = (px(x + entry.mark.width() + GAP), px(middle));
        area.draw_text(&entry.text, &font(TEXT), start)?;
    }
    Ok(())
}

/// The title of a picture, if it has one, above its legend.
pub(super) struct Heading<'a> {
    pub(super) page: &'a Page,
    /// On a screen.
    pub(super) title: String,
    pub(super) entries: Vec<Entry>,
    /// Room left of it.
    pub(super) margin: f64,
}

impl Heading<'_> {
    fn width(&self) -> f64 {
        self.page.width - self.margin - MARGIN
    }

    fn header(&self) -> f64 {
        match self.page.title(&self.title) {
            (lines, _) if lines.is_empty() => 2.0,
            (lines, size) => HEADER + LEADING * size * lines.len() as f64,
        }
    }

    /// The height, with some room below.
    pub(super) fn height(&self) -> f64 {
        self.header() + height(&self.entries, self.width()) + 9.0
    }

    pub(super) fn draw(&self, sheet: &Area) -> Drawn {
        let (lines, size) = self.page.title(&self.title);
        for (index, line) in lines.iter().enumerate() {
            let middle = HEADER / 2.0 + LEADING * size * (index as f64 + 0.5);
            sheet.draw_text(line, &font(size), (px(self.margin), px(middle)))?;
        }
        let header = self.header();
        let size = (self.width(), self.height() - header);
        draw(&part(sheet, (self.margin, header), size), &self.entries)
    }
}

/// Draws a mark from its left end on.
fn draw_mark(area: &Area, mark: Mark, (x, y): (f64, f64)) -> Drawn {
    let centre = (px(x + MARK / 2.0), px(y));
    match mark {
        Mark::Line(color, width) => {
            let ends = vec![(px(x), px(y)), (px(x + MARK), px(y))];
            area.draw(&PathElement::new(ends, stroke(color, width)))
        }
        Mark::Box(color) => {
            let corners = [(px(x), px(y - 5.0)), (px(x + MARK), px(y + 5.0))];
            area.draw(&Rectangle::new(corners, color.filled()))
        }
        Mark::Dot(color) => area.draw(&Circle::new(centre, px(4.0), color.filled())),
        Mark::Ring(color) => area.draw(&Circle::new(centre, px(4.5), stroke(color, 2.0))),
        Mark::Scale(length) => {
            let at = |dx: f64, dy: f64| (px(x + dx), px(y + dy));
            let bracket = [
                at(0.0, -4.0),
                at(0.0, 4.0),
                at(0.0, 0.0),
                at(length, 0.0),
                at(length, -4.0),
                at(length, 4.0),
            ];
            area.draw(&PathElement::new(bracket, stroke(INK, 1.6)))
        }
    }
}
