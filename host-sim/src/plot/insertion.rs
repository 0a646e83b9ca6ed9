//! A peg in a hole: the jamming diagram with the path of the load through it, and F_z over depth compared with Whitney's formulas
//! for small angles. Loads in the peg's frame.

use super::legend::{Entry, Heading, Mark};
use super::page::{Page, labels};
use super::series::sparse;
use super::sheet::{self, Area, Drawn, Plane, part, px, stroke};
use super::style::*;
use plotters::prelude::*;
use std::ops::Range;
use stiction_judge::insertion::{Diagram, Insertion, Meter, Verdict};
use stiction_live::drawing::Point;
use stiction_live::meter::small_angles;
use stiction_live::record::{Frame, Run};

/// Height of a panel, and room between two [px].
const HEIGHT: f64 = 430.0;
const GAP: f64 = 30.0;
/// Most points of a path.
const MOST_POINTS: usize = 6000;
/// The two sides of the parallelogram on which two points slide in, and those of one wall.
const TWO_POINTS: RGBColor = FRICTION;
const ONE_WALL: RGBColor = SLIDE;
const ONE_POINT_FORMULA: RGBColor = HAND_FORCE;
const TWO_POINT_FORMULA: RGBColor = NORMAL;

/// The picture as SVG; without a reading its panels are empty.
pub(super) fn svg(run: &Run, page: &Page) -> Drawn<String> {
    let readings: Vec<(&Frame, Insertion)> = run.readings().collect();
    let heading = Heading {
        page,
        title: format!("{}: the peg in its hole", run.scene.title),
        entries: entries(&readings),
        margin: page.margin,
    };
    let top = heading.height();
    let panel_height = page.tall * HEIGHT + AXIS;
    let (width, [across, down]) = match page.is_narrow() {
        true => (page.width, [0.0, panel_height + GAP]),
        false => ((page.width - GAP) / 2.0, [(page.width + GAP) / 2.0, 0.0]),
    };
    sheet::svg(page, top + down + panel_height + 6.0, |area| {
        heading.draw(area)?;
        let panel = |k: f64| part(area, (k * across, top + k * down), (width, panel_height));
        if let Some(meter) = &run.meter {
            jamming(&panel(0.0), page, meter, &readings)?;
            forces(&panel(1.0), page, run, &readings)?;
        }
        Ok(())
    })
}

fn entries(readings: &[(&Frame, Insertion)]) -> Vec<Entry> {
    let mut entries = vec![
        Entry::new(Mark::Line(TWO_POINTS, 2.0), "two points slide in"),
        Entry::new(Mark::Line(ONE_WALL, 2.0), "one wall slides in"),
        Entry::new(Mark::Line(BODY, 2.0), "load, going in"),
        Entry::new(Mark::Line(BODY_THEN, 2.0), "drawn out"),
        Entry::new(
            Mark::Line(ONE_POINT_FORMULA, 3.4),
            "small angles, one point",
        ),
        Entry::new(
            Mark::Line(TWO_POINT_FORMULA, 3.4),
            "small angles, two points",
        ),
    ];
    for (verdict, color) in MARKED {
        let count = readings
            .iter()
            .filter(|(_, found)| found.verdict == verdict)
            .count();
        if count > 0 {
            entries.push(Entry::new(
                Mark::Dot(color),
                format!("{}: {count} frames", verdict.name()),
            ));
        }
    }
    entries
}

/// Frames with these verdicts have dots.
const MARKED: [(Verdict, RGBColor); 2] = [(Verdict::Jammed, SLIP), (Verdict::Wedged, INK)];

struct DiagramAxes<'a> {
    x: (Range<f64>, &'a str),
    y: (Range<f64>, &'a str),
}

impl DiagramAxes<'_> {
    fn draw<'b>(&self, area: &Area<'b>, page: &Page) -> Drawn<Plane<'b>> {
        let ((x, x_label), (y, y_label)) = (&self.x, &self.y);
        let extents = [x, y].map(|range| range.end - range.start);
        let mut chart = ChartBuilder::on(area)
            .margin_left(px(page.edge))
            .margin_right(px(Page::RIGHT))
            .set_label_area_size(LabelAreaPosition::Left, px(page.left - page.edge))
            .set_label_area_size(LabelAreaPosition::Bottom, px(AXIS))
            .build_cartesian_2d(x.clone(), y.clone())?;
        chart
            .configure_mesh()
            .x_labels(labels(sheet::size(area).0))
            .y_labels(10)
            .bold_line_style(stroke(GRID, 1.0))
            .light_line_style(TRANSPARENT)
            .axis_style(stroke(FAINT, 1.0))
            .label_style(font(SMALL))
            .axis_desc_style(font(TEXT))
            .x_label_formatter(&|value| tick(*value, extents[0]))
            .y_label_formatter(&|value| tick(*value, extents[1]))
            .x_desc(*x_label)
            .y_desc(*y_label)
            .set_all_tick_mark_size(px(4.0))
            .draw()?;
        Ok(chart.plotting_area().clone())
    }

    /// A line through the points that are inside.
    fn path(&self, plane: &Plane<'_>, points: &[Point], color: RGBColor, width: f64) -> Drawn {
        let is_inside = |(x, y): &Point| self.x.0.contains(x) && self.y.0.contains(y);
        let [per_x, per_y] = [&self.x.0, &self.y.0].map(|range| HEIGHT / (range.end - range.start));
        for run in points.split(|point| !is_inside(point)) {
            let pixels: Vec<Point> = run.iter().map(|(x, y)| (x * per_x, y * per_y)).collect();
            let thinned = sparse(&pixels, 0.3, MOST_POINTS);
            let thinned: Vec<Point> = thinned
                .iter()
                .map(|(x, y)| (x / per_x, y / per_y))
                .collect();
            plane.draw(&PathElement::new(thinned, stroke(color, width)))?;
        }
        Ok(())
    }

    /// Dots at the readings with the verdicts of [`MARKED`].
    fn dots(
        &self,
        plane: &Plane<'_>,
        readings: &[(&Frame, Insertion)],
        points: impl Fn(&[(&Frame, Insertion)]) -> Vec<Point>,
    ) -> Drawn {
        let [per_x, per_y] = [&self.x.0, &self.y.0].map(|range| HEIGHT / (range.end - range.start));
        for (verdict, color) in MARKED {
            let marked = readings
                .iter()
                .filter(|(_, found)| found.verdict == verdict);
            let points = points(&marked.copied().collect::<Vec<_>>());
            let pixels: Vec<Point> = points.iter().map(|(x, y)| (x * per_x, y * per_y)).collect();
            for (x, y) in sparse(&pixels, 2.0, MOST_POINTS) {
                let place = (x / per_x, y / per_y);
                if self.x.0.contains(&place.0) && self.y.0.contains(&place.1) {
                    plane.draw(&Circle::new(place, px(2.2), color.filled()))?;
                }
            }
        }
        Ok(())
    }
}

/// The last frame in which the peg is deepest, apart from rounding; from there on it is drawn out.
fn turn(readings: &[(&Frame, Insertion)]) -> usize {
    let deepest = readings
        .iter()
        .map(|(_, found)| found.depth)
        .fold(0.0, f64::max);
    let is_deepest = |(_, found): &(&Frame, Insertion)| found.depth >= (1.0 - 1e-3) * deepest;
    readings
        .iter()
        .rposition(is_deepest)
        .map_or(0, |last| last + 1)
}

/// Where two points are touched first and where the load has a place at last: depth (m) and diagram.
fn diagrams(meter: &Meter, readings: &[(&Frame, Insertion)]) -> Vec<(f64, Diagram)> {
    let in_diagram = |found: &&Insertion| found.margin.is_some();
    let found = || readings.iter().map(|(_, found)| found);
    let first = found().filter(in_diagram).find(|found| found.walls == 2);
    let deepest = found()
        .filter(in_diagram)
        .max_by(|a, b| a.depth.total_cmp(&b.depth));
    let of = |found: &Insertion| {
        let lambda = found.lambda?;
        Some((
            found.depth,
            Diagram {
                friction: meter.friction,
                lambda,
            },
        ))
    };
    let moments = [first, deepest].into_iter().flatten();
    moments.filter_map(of).collect()
}

/// The parallelograms where two points are touched first and where the load has a place at last, and the path of the load.
fn jamming(area: &Area<'_>, page: &Page, meter: &Meter, readings: &[(&Frame, Insertion)]) -> Drawn {
    let diagrams = diagrams(meter, readings);
    let lambda = diagrams
        .iter()
        .map(|(_, diagram)| diagram.lambda)
        .fold(1.0, f64::max);
    let (across, up) = (1.3 / meter.friction.max(1e-3), 1.15 * (2.0 * lambda + 1.0));
    let axes = DiagramAxes {
        x: (-across..across, "Fx / Fz"),
        y: (-up..up, "M / (r Fz)"),
    };
    let plane = axes.draw(area, page)?;
    for (k, (depth, diagram)) in diagrams.iter().enumerate() {
        let width = if k + 1 == diagrams.len() { 2.4 } else { 1.4 };
        let corners = diagram.corners().map(|[x, y]| (x, y));
        for side in 0..4 {
            let color = if side % 2 == 0 { TWO_POINTS } else { ONE_WALL };
            let ends = vec![corners[side], corners[(side + 1) % 4]];
            plane.draw(&PathElement::new(ends, stroke(color, width)))?;
        }
        // Next to its upper corner.
        let label = format!("l = {} mm", number(round(1e3 * depth)));
        let place = (corners[1].0 + 0.03 * across, corners[1].1 + 0.02 * up);
        plane.draw(&Text::new(label, place, font(SMALL).color(&FAINT)))?;
    }
    let loads = |readings: &[(&Frame, Insertion)]| -> Vec<Point> {
        let load = |(_, found): &(&Frame, Insertion)| {
            found
                .load(meter.radius)
                .map_or((f64::NAN, f64::NAN), |[x, y]| (x, y))
        };
        readings.iter().map(load).collect()
    };
    axes.path(&plane, &loads(readings), BODY, 1.8)?;
    axes.dots(&plane, readings, loads)
}

/// F_z over depth, and the values of the formulas while the peg moves in.
fn forces(area: &Area<'_>, page: &Page, run: &Run, readings: &[(&Frame, Insertion)]) -> Drawn {
    let Some(meter) = &run.meter else {
        return Ok(());
    };
    let forces = || readings.iter().map(|(_, found)| found.fz);
    let deepest = readings
        .iter()
        .map(|(_, found)| found.depth)
        .fold(0.0, f64::max);
    let (low, high) = (forces().fold(0.0, f64::min), forces().fold(0.0, f64::max));
    let room = if high > low { 0.12 * (high - low) } else { 1.0 };
    let end = if deepest > 0.0 { 1.03e3 * deepest } else { 1.0 };
    let axes = DiagramAxes {
        x: (0.0..end, "depth l [mm]"),
        y: (low - room..high + room, "Fz [N]"),
    };
    let plane = axes.draw(area, page)?;
    let (inwards, outwards) = readings.split_at(turn(readings));
    let springs = [
        run.scene.stiffness_translation,
        run.scene.stiffness_rotation,
    ];
    let mut formulas = [Vec::new(), Vec::new()];
    for (frame, found) in inwards {
        let small = small_angles(meter, found.depth, frame, springs);
        let values = [small.one_point, small.two_points];
        for (line, value) in formulas.iter_mut().zip(values) {
            line.push((1e3 * found.depth, value.unwrap_or(f64::NAN)));
        }
    }
    let path = |readings: &[(&Frame, Insertion)]| -> Vec<Point> {
        readings
            .iter()
            .map(|(_, found)| (1e3 * found.depth, found.fz))
            .collect()
    };
    plane.draw(&PathElement::new(
        vec![(0.0, 0.0), (end, 0.0)],
        stroke(FAINT, 1.0),
    ))?;
    axes.path(&plane, &formulas[0], ONE_POINT_FORMULA, 3.4)?;
    axes.path(&plane, &formulas[1], TWO_POINT_FORMULA, 3.4)?;
    axes.path(&plane, &path(outwards), BODY_THEN, 1.8)?;
    axes.path(&plane, &path(inwards), BODY, 1.8)?;
    axes.dots(&plane, readings, path)
}
