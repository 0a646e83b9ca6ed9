//! Errors against costs: panels with two logarithmic axes and a common error axis, a mark per setting, and the front of
//! those that no other one beats in both. From points in any unit to an SVG.

use super::legend::{Entry, Heading, Mark};
use super::page::Page;
use super::sheet::{self, Area, Drawn, px, stroke};
use super::style::{AXIS, FAINT, GRID, INK, SMALL, TEXT, centred, font, text_width};
use plotters::prelude::*;
use std::ops::Range;

/// Height of a panel, and room between two [px].
const HEIGHT: f64 = 520.0;
const GAP: f64 = 26.0;
/// Radius of a mark [px].
const RADIUS: f64 = 4.5;
/// Height of a label [px].
const LINE: f64 = 12.0;

/// A setting.
pub(crate) struct Point {
    /// Cost, above 0.
    pub(crate) x: f64,
    /// Error; below the floor it is drawn there.
    pub(crate) y: f64,
    pub(crate) color: RGBColor,
    /// A dot; otherwise a ring.
    pub(crate) filled: bool,
    /// Shown for the best.
    pub(crate) label: String,
    /// No other point has less cost and less error.
    pub(crate) best: bool,
}

/// A panel: what its cost axis shows, and its points.
pub(crate) struct Panel {
    pub(crate) label: String,
    pub(crate) points: Vec<Point>,
}

pub(crate) struct Fronts {
    pub(crate) title: String,
    /// The meaning of a color.
    pub(crate) colors: Vec<(RGBColor, &'static str)>,
    /// The meaning of dots and of rings.
    pub(crate) marks: [&'static str; 2],
    /// The label of the error axis.
    pub(crate) error: String,
    /// The smallest error that is distinguished.
    pub(crate) floor: f64,
    pub(crate) panels: Vec<Panel>,
}

impl Fronts {
    pub(super) fn svg(&self) -> Drawn<String> {
        let page = Page::screen();
        let heading = Heading {
            page: &page,
            title: self.title.clone(),
            entries: self.entries(),
            margin: page.left,
        };
        let (top, count) = (heading.height(), self.panels.len().max(1) as f64);
        let points = self.panels.iter().flat_map(|panel| &panel.points);
        let highest = extent(points.map(|point| point.y.max(self.floor))).end;
        let y = self.floor.log10()..highest.max(self.floor.log10() + 1.0);
        let width = (page.inner() - GAP * (count - 1.0)) / count;
        sheet::svg(&page, top + HEIGHT + AXIS + 6.0, |area| {
            heading.draw(area)?;
            for (k, panel) in self.panels.iter().enumerate() {
                let axes = Axes {
                    area,
                    corner: (page.left + k as f64 * (width + GAP), top),
                    width,
                    x: extent(panel.points.iter().map(|point| point.x)),
                    y: y.clone(),
                };
                axes.draw(&panel.label, (k == 0).then_some(self))?;
                axes.points(&panel.points)?;
            }
            Ok(())
        })
    }

    fn entries(&self) -> Vec<Entry> {
        let colors = self.colors.iter();
        let mut entries: Vec<_> = colors
            .map(|(color, name)| Entry::new(Mark::Box(*color), *name))
            .collect();
        let [dots, rings] = self.marks;
        entries.push(Entry::new(Mark::Dot(INK), dots));
        entries.push(Entry::new(Mark::Ring(INK), rings));
        entries.push(Entry::new(
            Mark::Line(FAINT, 1.4),
            "front: none is better in both",
        ));
        entries
    }
}

/// The part of a logarithmic axis, as exponents of 10, that holds all values above 0, with some room on both sides.
fn extent(values: impl Iterator<Item = f64>) -> Range<f64> {
    let exponents = values.filter(|value| *value > 0.0).map(f64::log10);
    let (low, high) = exponents.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    if low > high {
        return 0.0..1.0;
    }
    let room = 0.06 * (high - low) + 0.05;
    low - room..high + room
}

/// Powers of ten on an axis, with their doubles and fives if there is room for them.
fn ticks(axis: &Range<f64>) -> Vec<f64> {
    let steps: &[f64] = if axis.end - axis.start < 3.2 {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0]
    };
    let decades = axis.start.floor() as i32..=axis.end.floor() as i32;
    decades
        .flat_map(|exponent| steps.iter().map(move |step| step * 10_f64.powi(exponent)))
        .filter(|value| axis.contains(&value.log10()))
        .collect()
}

/// A tick's label, with an exponent if it would be long.
fn label(value: f64) -> String {
    let text = if (1e-3..1e4).contains(&value) {
        format!("{}", (value * 1e6).round() / 1e6)
    } else {
        format!("{value:e}")
    };
    text.replace('-', "−")
}

struct Axes<'a, 'b> {
    area: &'a Area<'b>,
    corner: (f64, f64),
    width: f64,
    /// Exponents of 10.
    x: Range<f64>,
    y: Range<f64>,
}

impl Axes<'_, '_> {
    /// The place of a point on the sheet [px].
    fn place(&self, x: f64, y: f64) -> (f64, f64) {
        let part = |value: f64, range: &Range<f64>| {
            ((value.log10() - range.start) / (range.end - range.start)).clamp(0.0, 1.0)
        };
        (
            self.corner.0 + self.width * part(x, &self.x),
            self.corner.1 + HEIGHT * (1.0 - part(y, &self.y)),
        )
    }

    fn line(&self, points: &[(f64, f64)], color: RGBColor, width: f64) -> Drawn {
        let points: Vec<_> = points.iter().map(|&(x, y)| (px(x), px(y))).collect();
        self.area
            .draw(&PathElement::new(points, stroke(color, width)))
    }

    fn text(&self, text: &str, at: (f64, f64), size: f64) -> Drawn {
        self.colored(text, at, size, INK)
    }

    fn colored(&self, text: &str, (x, y): (f64, f64), size: f64, color: RGBColor) -> Drawn {
        let style = centred(&font(size)).color(&color);
        self.area.draw_text(text, &style, (px(x), px(y)))
    }

    /// Grid, labels and frame; the error axis has its own where `fronts` is given.
    fn draw(&self, cost: &str, fronts: Option<&Fronts>) -> Drawn {
        let (left, top) = self.corner;
        let (right, bottom) = (left + self.width, top + HEIGHT);
        for value in ticks(&self.x) {
            let (x, _) = self.place(value, 1.0);
            self.line(&[(x, top), (x, bottom)], GRID, 1.0)?;
            self.text(&label(value), (x, bottom + 12.0), SMALL)?;
        }
        for value in ticks(&self.y) {
            let (_, y) = self.place(1.0, value);
            self.line(&[(left, y), (right, y)], GRID, 1.0)?;
            if let Some(fronts) = fronts {
                let at_floor = value <= 1.001 * fronts.floor;
                let text = format!("{}{}", if at_floor { "≤ " } else { "" }, label(value));
                let x = left - 6.0 - text_width(&text, SMALL) / 2.0;
                self.text(&text, (x, y), SMALL)?;
            }
        }
        let corners = [(left, top), (left, bottom), (right, bottom)];
        self.line(&corners, INK, 1.0)?;
        self.text(cost, (left + self.width / 2.0, bottom + 31.0), TEXT)?;
        if let Some(fronts) = fronts {
            let turned = centred(&font(TEXT)).transform(FontTransform::Rotate270);
            let middle = (px(left - 54.0), px(top + HEIGHT / 2.0));
            self.area.draw_text(&fronts.error, &turned, middle)?;
        }
        Ok(())
    }

    fn points(&self, points: &[Point]) -> Drawn {
        let place = |point: &Point| self.place(point.x, point.y.max(f64::MIN_POSITIVE));
        let mut front: Vec<_> = (points.iter().filter(|point| point.best))
            .map(place)
            .collect();
        front.sort_by(|a, b| a.0.total_cmp(&b.0));
        if front.len() > 1 {
            self.line(&front, FAINT, 1.4)?;
        }
        let places: Vec<_> = points.iter().map(place).collect();
        for (point, &(x, y)) in points.iter().zip(&places) {
            let style = if point.filled {
                point.color.filled()
            } else {
                stroke(point.color, 2.0)
            };
            self.area
                .draw(&Circle::new((px(x), px(y)), px(RADIUS), style))?;
        }
        let best: Vec<_> = points.iter().filter(|point| point.best).collect();
        let named: Vec<_> = best
            .iter()
            .map(|point| (point.label.as_str(), place(point)))
            .collect();
        let (left, top) = self.corner;
        let inside = (left..left + self.width, top..top + HEIGHT);
        for (point, at) in best.iter().zip(labels(&named, &places, &inside)) {
            self.colored(&point.label, at, SMALL, point.color)?;
        }
        Ok(())
    }
}

/// The middle of a label next to each of the named places: right, left, above or below, wherever it covers least of the marks and
/// of the earlier labels, and stays inside.
fn labels(
    named: &[(&str, (f64, f64))],
    marks: &[(f64, f64)],
    inside: &(Range<f64>, Range<f64>),
) -> Vec<(f64, f64)> {
    let overlap = |(x, y): (f64, f64), width: f64, (u, v): (f64, f64), size: (f64, f64)| {
        let across = (width + size.0) / 2.0 - (x - u).abs();
        let along = (LINE + size.1) / 2.0 - (y - v).abs();
        across.max(0.0) * along.max(0.0)
    };
    let mut set: Vec<((f64, f64), f64)> = Vec::new();
    for &(name, (x, y)) in named {
        let width = 0.92 * text_width(name, SMALL);
        let (dx, dy) = (RADIUS + 3.0 + width / 2.0, RADIUS + 1.0 + LINE / 2.0);
        let beside = [
            (dx, 0.0),
            (-dx, 0.0),
            (0.0, -dy),
            (0.0, dy),
            (dx, -dy),
            (dx, dy),
            (-dx, -dy),
            (-dx, dy),
            (0.0, -2.2 * dy),
            (0.0, 2.2 * dy),
        ];
        let cost = |&(u, v): &(f64, f64)| {
            let marks = marks
                .iter()
                .map(|&at| overlap((u, v), width, at, (2.0 * RADIUS, 2.0 * RADIUS)));
            let others = set
                .iter()
                .map(|&(at, wide)| overlap((u, v), width, at, (wide, LINE)));
            let ends = [u - width / 2.0, u + width / 2.0];
            let out = !(ends.iter().all(|u| inside.0.contains(u)) && inside.1.contains(&v));
            // The farther from its mark, the worse.
            let away = 2.0 * ((u - x).hypot(v - y) - dx.min(dy));
            marks.sum::<f64>() + 3.0 * others.sum::<f64>() + away + if out { 1e3 } else { 0.0 }
        };
        let spots = beside.map(|(dx, dy)| (x + dx, y + dy));
        let best = spots.iter().min_by(|a, b| cost(a).total_cmp(&cost(b)));
        set.push((*best.unwrap_or(&(x + dx, y)), width));
    }
    set.into_iter().map(|(at, _)| at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_holds_all_values_and_has_ticks() {
        let axis = extent([0.0, 3.0, 40.0].into_iter());
        assert!(axis.start < 3_f64.log10() && axis.end > 40_f64.log10());
        assert_eq!(ticks(&axis), [5.0, 10.0, 20.0, 50.0]);
        assert_eq!(ticks(&(-2.0..2.5)), [0.01, 0.1, 1.0, 10.0, 100.0]);
        assert_eq!(extent([0.0].into_iter()), 0.0..1.0);
        assert_eq!(
            [0.01, 0.3, 20.0, 1e5, 1e-6].map(label),
            ["0.01", "0.3", "20", "1e5", "1e−6"]
        );
    }

    #[test]
    fn labels_of_marks_close_together_do_not_cover_each_other() {
        let places = [(100.0, 100.0), (104.0, 101.0), (100.0, 108.0)];
        let named = [("31", places[0]), ("100", places[1]), ("1000", places[2])];
        let at = labels(&named, &places, &(0.0..200.0, 0.0..200.0));
        for (i, a) in at.iter().enumerate() {
            for b in &at[..i] {
                assert!(
                    (a.1 - b.1).abs() >= LINE || (a.0 - b.0).abs() > 12.0,
                    "{at:?}"
                );
            }
        }
    }
}
