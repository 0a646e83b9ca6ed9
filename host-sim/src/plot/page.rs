//! The sheet that a picture is drawn on: for a screen, or for a column of a paper, where its width is a length and its type has 7 to 9
//! points. A picture's own lengths are px.

use super::style::{SMALL, TEXT, TITLE, text_width};

/// Points per px of a figure in a paper: [`TEXT`] has 8.4 pt, [`SMALL`] 7.7 pt, a subscript of [`TEXT`] 7.1 pt.
const POINTS: f64 = 0.7;
const MM_PER_POINT: f64 = 25.4 / 72.0;
/// Pictures narrower than this have one column of panels [px]: two would have room for two labels on each axis.
const TWO_COLUMNS: f64 = 600.0;
/// Room for a label on a horizontal axis [px], and the number of labels of a short axis, for which it still has room.
const LABEL: f64 = 76.0;
const SHORT: f64 = 5.0;

#[derive(Clone, Debug)]
pub(super) enum Title {
    /// Scene and picture.
    Picture,
    /// The text of the user, if any.
    Own(Option<String>),
}

#[derive(Clone, Debug)]
pub(crate) struct Page {
    /// Width of the picture [px].
    pub(super) width: f64,
    /// Width in the paper [mm], if it is for one.
    pub(super) millimetres: Option<f64>,
    /// Room left of a plot for its axis, of which `edge` is free of labels [px].
    pub(super) left: f64,
    pub(super) edge: f64,
    /// Room left of legends [px].
    pub(super) margin: f64,
    /// Height of a panel, relative to that on a screen.
    pub(super) tall: f64,
    /// Number of snapshots in a row, and in a strip.
    pub(super) columns: usize,
    pub(super) snapshots: usize,
    /// The instants at which the body is shown [s]; without one, the picture chooses them.
    pub(super) at: Vec<f64>,
    pub(super) title: Title,
}

impl Page {
    /// A page for a screen.
    pub(crate) fn screen() -> Self {
        Self {
            width: 1000.0,
            millimetres: None,
            left: 70.0,
            edge: 14.0,
            margin: 70.0,
            tall: 1.0,
            columns: 4,
            snapshots: 8,
            at: Vec::new(),
            title: Title::Picture,
        }
    }

    /// A figure of a paper, of a width in mm, with a title if one is given.
    pub(crate) fn paper(millimetres: f64, title: Option<String>) -> Self {
        let width = millimetres / MM_PER_POINT / POINTS;
        let columns = if width < TWO_COLUMNS { 2 } else { 4 };
        Self {
            width,
            millimetres: Some(millimetres),
            left: 60.0,
            edge: 2.0,
            margin: 2.0,
            tall: 0.6,
            columns,
            snapshots: 4,
            at: Vec::new(),
            title: Title::Own(title),
        }
    }

    /// The page with these instants [s].
    pub(crate) fn at(self, at: Vec<f64>) -> Self {
        Self { at, ..self }
    }

    /// Room right of a plot [px].
    pub(super) const RIGHT: f64 = 16.0;

    /// Width of a plot [px].
    pub(super) fn inner(&self) -> f64 {
        self.width - self.left - Self::RIGHT
    }

    pub(super) fn is_narrow(&self) -> bool {
        self.width < TWO_COLUMNS
    }

    /// Length of one px as an attribute of SVG: its number and its unit.
    pub(super) fn unit(&self) -> (f64, &'static str) {
        match self.millimetres {
            Some(millimetres) => (millimetres / self.width, "mm"),
            None => (1.0, ""),
        }
    }

    /// The lines of the title and the size of their type [px]; `picture`: the title on a screen.
    pub(super) fn title(&self, picture: &str) -> (Vec<String>, f64) {
        let (text, size) = match &self.title {
            Title::Picture => (picture, TITLE),
            Title::Own(text) => (text.as_deref().unwrap_or(""), TEXT),
        };
        (wrapped(text, size, self.width - self.margin), size)
    }
}

/// The most labels of a horizontal axis of this width [px].
pub(super) fn labels(width: f64) -> usize {
    (width / LABEL).max(SHORT) as usize
}

/// The lines of a text that is broken at its spaces so that each fits into a width [px], if its words do.
pub(super) fn wrapped(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if text_width(&format!("{line} {word}"), size) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

const _: () = assert!(SMALL * POINTS > 7.0 && TEXT * POINTS < 9.0);
