//! Pictures over time: panels stacked above one time axis, below them the slips, the slides as bars, the events and the state as a
//! colored band.

use super::legend::{self, Entry, Heading, Mark};
use super::notes::Notes;
use super::page::{Page, labels};
use super::series::{envelope, outline};
use super::sheet::{self, Area, Drawn, Plane, part, px, stroke};
use super::slides::Slides;
use super::states;
use super::style::*;
use plotters::prelude::*;
use std::ops::Range;
use stiction_live::record::{Frame, Run};

/// Heights [px].
const GAP: f64 = 12.0;
const SLIPS: f64 = 70.0;
const BAND: f64 = 16.0;
/// Number of columns to which a line is thinned: one per pixel.
const COLUMNS: usize = 900;
/// Above this number, events are not drawn through the panels.
const MOST_GUIDES: usize = 24;

pub(super) struct Curve {
    pub(super) color: RGBColor,
    /// Width [px].
    pub(super) width: f64,
    /// One value per frame, not finite if there is none.
    pub(super) values: Vec<f64>,
    /// A limit: thinned to its outer edge, which can be dashed.
    pub(super) limit: bool,
    /// The panel makes room for it; other lines are clipped at the panel's edge.
    pub(super) makes_room: bool,
}

impl Curve {
    pub(super) fn new(color: RGBColor, width: f64, values: Vec<f64>) -> Self {
        Self {
            color,
            width,
            values,
            limit: false,
            makes_room: true,
        }
    }
}

/// A panel: lines over time with a common axis.
pub(super) struct TimePanel {
    /// The quantity on the vertical axis, with its unit.
    pub(super) label: String,
    /// Height [px].
    pub(super) height: f64,
    pub(super) lines: Vec<Curve>,
}

pub(super) struct Timeline<'a> {
    pub(super) run: &'a Run,
    pub(super) page: &'a Page,
    pub(super) title: String,
    pub(super) legend: Vec<Entry>,
    pub(super) panels: Vec<TimePanel>,
}

impl Timeline<'_> {
    pub(super) fn svg(mut self) -> Drawn<String> {
        let page = self.page;
        let times: Vec<f64> = self.run.frames.iter().map(|frame| frame.t).collect();
        let slips = Slips::of(self.run, &times);
        self.legend.extend(slips.legend());
        let time = span(&times);
        let slides = Slides::of(&self.run.frames, time.end);
        self.legend.extend(slides.legend());
        let place = |t| page.left + page.inner() * (t - time.start) / (time.end - time.start);
        let notes = Notes::new(&self.run.frames, place, page.width - 4.0);
        let states = states::legend(&self.run.frames);
        let legend_width = page.width - page.margin - Page::RIGHT;
        for panel in &mut self.panels {
            panel.height *= page.tall;
        }
        let heading = Heading {
            page,
            title: self.title,
            entries: self.legend,
            margin: page.margin,
        };
        let top = heading.height();
        let panels: f64 = self.panels.iter().map(|panel| panel.height + GAP).sum();
        let marks = slips.height() + slides.height() + notes.height();
        let bottom = top + panels + marks + BAND + AXIS + GAP;
        let height = bottom + legend::height(&states, legend_width) + 6.0;
        sheet::svg(page, height, |area| {
            heading.draw(area)?;
            let mut column = Column {
                area,
                page,
                times: &times,
                time: time.clone(),
                top,
            };
            for panel in &self.panels {
                column.panel(panel, &notes)?;
            }
            column.slips(&slips)?;
            slides.draw(&column.block(slides.height(), 0.0), page, place)?;
            notes.draw(&column.block(notes.height(), 0.0))?;
            column.band(&self.run.frames)?;
            let size = (legend_width, height - bottom);
            legend::draw(&part(area, (page.margin, bottom), size), &states)
        })
    }
}

/// The time axis [s] of some frames.
fn span(times: &[f64]) -> Range<f64> {
    match (times.first(), times.last()) {
        (Some(&begin), Some(&end)) if end > begin => begin..end,
        (Some(&begin), _) => begin - 0.5..begin + 0.5,
        _ => 0.0..1.0,
    }
}

/// The origin of the labels of a time axis: 0, or a round time before it if they would be too long (clock time) [s].
fn origin(time: &Range<f64>) -> f64 {
    let step = 10f64.powf((time.end - time.start).log10().ceil() + 1.0);
    let origin = (time.start / step).floor() * step;
    if origin.abs() < 1e3 * step {
        0.0
    } else {
        origin
    }
}

struct Slips {
    count: u64,
    /// The longest slip in each column of time: (t, length [mm]).
    peaks: Vec<(f64, f64)>,
    /// The longest of all [mm].
    longest: f64,
}

impl Slips {
    fn of(run: &Run, times: &[f64]) -> Self {
        let lengths: Vec<f64> = run
            .frames
            .iter()
            .map(|frame| 1e3 * frame.longest_slip)
            .collect();
        Self {
            count: run.frames.iter().map(|frame| u64::from(frame.slips)).sum(),
            peaks: outline(times, &lengths, COLUMNS)
                .into_iter()
                .flatten()
                .filter(|peak| peak.1 > 0.0)
                .collect(),
            longest: lengths.iter().copied().fold(0.0, f64::max),
        }
    }

    fn height(&self) -> f64 {
        if self.peaks.is_empty() {
            0.0
        } else {
            SLIPS + GAP
        }
    }

    fn legend(&self) -> Option<Entry> {
        let text = format!(
            "slips: {}, longest {} mm",
            self.count,
            number(round(self.longest))
        );
        (self.longest > 0.0).then(|| Entry::new(Mark::Line(SLIP, 2.0), text))
    }
}

struct Column<'a, 'b> {
    area: &'a Area<'b>,
    page: &'a Page,
    times: &'a [f64],
    /// The time axis [s].
    time: Range<f64>,
    /// The top of the next panel [px].
    top: f64,
}

impl<'b> Column<'_, 'b> {
    /// The next block of the sheet, of this height and a gap below it.
    fn block(&mut self, height: f64, gap: f64) -> Area<'b> {
        let block = part(self.area, (0.0, self.top), (self.page.width, height));
        self.top += height + gap;
        block
    }

    /// A block with the time axis and a vertical axis, whose label is `label`.
    fn axes(&mut self, height: f64, values: Range<f64>, label: &str) -> Drawn<Plane<'b>> {
        let block = self.block(height, GAP);
        let extent = values.end - values.start;
        let mut chart = ChartBuilder::on(&block)
            .margin_left(px(self.page.edge))
            .set_label_area_size(LabelAreaPosition::Left, px(self.page.left - self.page.edge))
            .margin_right(px(Page::RIGHT))
            .build_cartesian_2d(self.time.clone(), values)?;
        chart
            .configure_mesh()
            .x_labels(labels(self.page.inner()))
            .y_labels((height / 24.0).max(4.0) as usize)
            .disable_x_axis()
            .bold_line_style(stroke(GRID, 1.0))
            .light_line_style(TRANSPARENT)
            .axis_style(stroke(FAINT, 1.0))
            .label_style(font(SMALL))
            .axis_desc_style(font(TEXT))
            .y_label_formatter(&|value| tick(*value, extent))
            .y_desc(label)
            .set_all_tick_mark_size(px(4.0))
            .draw()?;
        Ok(chart.plotting_area().clone())
    }

    fn panel(&mut self, panel: &TimePanel, notes: &Notes) -> Drawn {
        let range = range(&panel.lines);
        let plane = self.axes(panel.height, range.clone(), &panel.label)?;
        if range.contains(&0.0) {
            let zero = vec![(self.time.start, 0.0), (self.time.end, 0.0)];
            plane.draw(&PathElement::new(zero, stroke(FAINT, 1.0)))?;
        }
        if notes.notes.len() <= MOST_GUIDES {
            for note in &notes.notes {
                let guide = vec![(note.t, range.start), (note.t, range.end)];
                plane.draw(&PathElement::new(guide, stroke(FAINT.mix(0.45), 1.0)))?;
            }
        }
        for line in &panel.lines {
            let cut: Vec<f64> = line
                .values
                .iter()
                .map(|v| v.clamp(range.start, range.end))
                .collect();
            let thin = if line.limit { outline } else { envelope };
            for points in thin(self.times, &cut, COLUMNS) {
                plane.draw(&PathElement::new(points, stroke(line.color, line.width)))?;
            }
        }
        Ok(())
    }

    fn slips(&mut self, slips: &Slips) -> Drawn {
        if slips.peaks.is_empty() {
            return Ok(());
        }
        let plane = self.axes(SLIPS, 0.0..1.1 * slips.longest, "slip [mm]")?;
        for &(t, length) in &slips.peaks {
            let stem = vec![(t, 0.0), (t, length)];
            plane.draw(&PathElement::new(stem, stroke(SLIP, 1.6)))?;
        }
        Ok(())
    }

    /// The state as a band with the time axis below it.
    fn band(&mut self, frames: &[Frame]) -> Drawn {
        let block = self.block(BAND + AXIS, GAP);
        let extent = self.time.end - self.time.start;
        let origin = origin(&self.time);
        let description = match origin {
            0.0 => "time t [s]".to_owned(),
            origin => format!("time t − {origin} s [s]"),
        };
        let mut chart = ChartBuilder::on(&block)
            .set_label_area_size(LabelAreaPosition::Bottom, px(AXIS))
            .margin_left(px(self.page.left))
            .margin_right(px(Page::RIGHT))
            .build_cartesian_2d(self.time.clone(), 0.0..1.0)?;
        for (range, state) in states::spans(frames, self.time.end) {
            let corners = [(range.start, 0.0), (range.end, 1.0)];
            chart
                .plotting_area()
                .draw(&Rectangle::new(corners, state_color(state).filled()))?;
        }
        chart
            .configure_mesh()
            .disable_mesh()
            .disable_y_axis()
            .x_labels(labels(self.page.inner()))
            .axis_style(stroke(INK, 1.0))
            .label_style(font(SMALL))
            .axis_desc_style(font(TEXT))
            .x_label_formatter(&|t| tick(*t - origin, extent))
            .x_desc(description)
            .set_all_tick_mark_size(px(4.0))
            .draw()?;
        let place = (px(self.page.edge + 10.0), px(BAND / 2.0));
        block.draw_text("state", &font(TEXT), place)
    }
}

/// The range of a panel, from its lines that make room, with some margin.
fn range(lines: &[Curve]) -> Range<f64> {
    let values = || {
        let lines = lines.iter().filter(|line| line.makes_room);
        lines.flat_map(|line| line.values.iter().copied().filter(|v| v.is_finite()))
    };
    let low = values().fold(f64::INFINITY, f64::min);
    let high = values().fold(f64::NEG_INFINITY, f64::max);
    if low > high {
        return -1.0..1.0;
    }
    let extent = high - low;
    let margin = if extent > 1e-9 * high.abs().max(low.abs()) {
        0.06 * extent
    } else {
        high.abs().max(1.0)
    };
    low - margin..high + margin
}
