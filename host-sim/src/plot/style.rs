//! The style of all pictures: colors that color-blind readers can distinguish (Okabe and Ito), one per role, and the type.

use super::sheet::px;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use stiction_core::StateKind;
use stiction_live::number::Number;

pub(super) const PAPER: RGBColor = WHITE;
pub(super) const INK: RGBColor = RGBColor(34, 34, 34);
pub(super) const FAINT: RGBColor = RGBColor(120, 120, 120);
pub(super) const GRID: RGBColor = RGBColor(225, 225, 225);
pub(super) const SOLID: RGBColor = RGBColor(238, 236, 232);
pub(super) const HAND: RGBColor = BLACK;
pub(super) const OPEN_HAND: RGBColor = RGBColor(170, 170, 170);
pub(super) const BODY: RGBColor = RGBColor(0, 114, 178);
/// The body at the end of the run.
pub(super) const BODY_END: RGBColor = RGBColor(190, 217, 235);
/// The body at its start.
pub(super) const BODY_THEN: RGBColor = RGBColor(120, 176, 212);
pub(super) const NORMAL: RGBColor = RGBColor(0, 158, 115);
pub(super) const FRICTION: RGBColor = RGBColor(213, 94, 0);
pub(super) const HAND_FORCE: RGBColor = RGBColor(230, 159, 0);
pub(super) const HAND_FORCE_Y: RGBColor = RGBColor(86, 180, 233);
pub(super) const SLIP: RGBColor = RGBColor(204, 121, 167);
pub(super) const SLIDE: RGBColor = RGBColor(148, 62, 108);
pub(super) const STATIC_LIMIT: RGBColor = RGBColor(122, 50, 0);
pub(super) const DYNAMIC_LIMIT: RGBColor = RGBColor(165, 80, 10);

/// Lines in these colors are dashed: lengths of dash and gap [px].
pub(super) const DASHES: [(RGBColor, [f64; 2]); 2] =
    [(STATIC_LIMIT, [6.0, 3.0]), (DYNAMIC_LIMIT, [1.8, 2.4])];

pub(super) fn state_color(state: StateKind) -> RGBColor {
    match state {
        StateKind::NonContact => RGBColor(205, 205, 205),
        StateKind::SingleVertex => RGBColor(86, 180, 233),
        StateKind::Edge => RGBColor(0, 158, 115),
        StateKind::TwoVertex => RGBColor(230, 159, 0),
        StateKind::Corner => RGBColor(240, 228, 66),
        StateKind::Locked => RGBColor(204, 121, 167),
    }
}

pub(crate) fn number_color(number: Number) -> RGBColor {
    match number {
        Number::F64 => RGBColor(0, 158, 115),
        Number::F32 => RGBColor(0, 114, 178),
        Number::Fixed => RGBColor(213, 94, 0),
    }
}

/// Room below a plot for its axis [px].
pub(super) const AXIS: f64 = 40.0;

/// Sizes of type [px].
pub(super) const TITLE: f64 = 16.0;
pub(super) const TEXT: f64 = 12.0;
pub(super) const SMALL: f64 = 11.0;

const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";
/// plotters divides the size of type by this.
const PLOTTERS_LEADING: f64 = 1.24;

/// Type of a size [px], anchored at its left and vertical middle.
pub(super) fn font(size: f64) -> TextStyle<'static> {
    (FAMILY, f64::from(px(size)) * PLOTTERS_LEADING)
        .into_font()
        .color(&INK)
        .pos(Pos::new(HPos::Left, VPos::Center))
}

/// A type, centred.
pub(super) fn centred(style: &TextStyle<'static>) -> TextStyle<'static> {
    style.pos(Pos::new(HPos::Center, VPos::Center))
}

/// The mark before a letter that is a subscript: a character of the private use area, which no text contains otherwise.
pub(super) const SUBSCRIPT: char = '\u{e000}';

/// A symbol with a letter as its subscript.
pub(super) fn symbol(name: &str, subscript: char) -> String {
    format!("{name}{SUBSCRIPT}{subscript}")
}

/// The approximate width of a text [px], not less than that in DejaVu Sans.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let ems = |c: char| match c {
        SUBSCRIPT => 0.0,
        'f' | 'i' | 'j' | 'l' | 'r' | 't' | ' ' | '.' | ',' | ':' | ';' | '(' | ')' | '|' => 0.39,
        'm' | 'w' | 'M' | 'W' | '±' | '=' | '+' | '−' | '·' => 0.88,
        'A'..='Z' => 0.72,
        _ => 0.6,
    };
    size * text.chars().map(ems).sum::<f64>()
}

/// A tick label of an axis that spans `extent`: a value that is 0 apart from rounding reads 0.
pub(super) fn tick(value: f64, extent: f64) -> String {
    number(if value.abs() < 1e-9 * extent {
        0.0
    } else {
        value
    })
}

/// A number without trailing zeros, with a true minus sign, and powers of ten where it is very large or small.
pub(super) fn number(value: f64) -> String {
    let magnitude = value.abs();
    let text = if magnitude != 0.0 && !(1e-4..1e6).contains(&magnitude) {
        format!("{:e}", significant(value))
    } else {
        format!("{}", significant(value))
    };
    text.replace('-', "−")
}

/// A value to six significant digits.
fn significant(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// A value to three significant digits.
pub(super) fn round(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}
