//! The paths in the plane, to scale: the hand, the holding point, the vertices in contact, the body at the start and at
//! the end, and the surfaces.

use super::instants::nearest;
use super::legend::{Entry, Heading, Mark};
use super::page::{Page, labels};
use super::plane::{View, length_unit};
use super::series::sparse;
use super::sheet::{self, Area, Drawn, part, px, stroke};
use super::style::*;
use plotters::prelude::*;
use stiction_live::drawing::{Point, Window, corners_of, placed};
use stiction_live::record::{ContactRecord, Frame, Run};

/// The least and the greatest height of the plane [px].
const HEIGHTS: (f64, f64) = (240.0, 760.0);
/// Most points of a path, and dots of all vertices.
const MOST_POINTS: usize = 12_000;
const MOST_DOTS: usize = 4000;
/// The steps of a path of which names keep clear [px].
const COARSE: f64 = 2.0;

pub(super) fn svg(run: &Run, page: &Page) -> Drawn<String> {
    let shown = shown(run, page);
    let bounds = bounds(run, &shown);
    let inner = page.inner();
    let height = (inner * bounds.height() / bounds.width())
        .clamp(page.tall * HEIGHTS.0, page.tall * HEIGHTS.1)
        .round();
    let pixel = (bounds.width() / inner).max(bounds.height() / height);
    let bounds = Window::centred(bounds.centre(), inner * pixel, height * pixel);
    let heading = Heading {
        page,
        title: format!("{}: paths in the plane", run.scene.title),
        entries: entries(run, page, &shown),
        margin: page.margin,
    };
    let top = heading.height();
    sheet::svg(page, top + height + AXIS + 6.0, |area| {
        heading.draw(area)?;
        let plot = part(area, (page.left, top), (inner, height));
        let view = View::new(&plot, bounds.clone())?;
        view.solids(run)?;
        let plot = part(area, (0.0, top), (page.width, height + AXIS));
        axes(&plot, page, &bounds)?;
        bodies(&view, run, &shown)?;
        paths(&view, run)?;
        view.names(&run.scene, covered(&view, run, &shown))
    })
}

/// The frames in which the body is shown: at the instants of the page, or else at both ends.
fn shown<'a>(run: &'a Run, page: &Page) -> Vec<&'a Frame> {
    let ends = [run.frames.first(), run.frames.last()];
    match page.at.is_empty() {
        true => ends.into_iter().flatten().collect(),
        false => nearest(&run.frames, &page.at).collect(),
    }
}

fn entries(run: &Run, page: &Page, shown: &[&Frame]) -> Vec<Entry> {
    let times = |frames: &[&Frame]| {
        let times = frames.iter().map(|frame| number(frame.t));
        format!("body at {} s", times.collect::<Vec<_>>().join(", "))
    };
    let mut entries = vec![
        Entry::new(Mark::Line(HAND, 1.4), "hand, holding"),
        Entry::new(Mark::Ring(HAND), "at start"),
        Entry::new(Mark::Dot(HAND), "at end"),
        Entry::new(Mark::Line(BODY, 3.2), "holding point"),
    ];
    match shown {
        _ if page.at.is_empty() => entries.extend([
            Entry::new(Mark::Line(BODY_THEN, 1.6), "body at start"),
            Entry::new(Mark::Box(BODY_END), "body at end"),
        ]),
        [before @ .., last] => {
            if !before.is_empty() {
                entries.push(Entry::new(Mark::Line(BODY_THEN, 1.6), times(before)));
            }
            entries.push(Entry::new(Mark::Box(BODY_END), times(&[last])));
        }
        [] => {}
    }
    if run.frames.iter().any(|frame| !frame.held) {
        entries.insert(1, Entry::new(Mark::Line(OPEN_HAND, 1.4), "hand, open"));
    }
    if contacts(run).any(|contact| contact.touch.vertex().is_some()) {
        entries.push(Entry::new(Mark::Dot(FRICTION), "vertices in contact"));
    }
    if contacts(run).any(|contact| contact.touch.vertex().is_none()) {
        entries.push(Entry::new(Mark::Ring(FRICTION), "corners in contact"));
    }
    entries
}

fn contacts(run: &Run) -> impl Iterator<Item = &ContactRecord> {
    run.frames.iter().flat_map(|frame| &frame.contacts)
}

/// Everything that is drawn, with a margin for the surfaces.
fn bounds(run: &Run, shown: &[&Frame]) -> Window {
    let bodies = shown
        .iter()
        .flat_map(|frame| placed(&run.scene.vertices, frame.pose));
    let hands = run.frames.iter().map(hand_of);
    let held = run.frames.iter().filter(|frame| frame.held);
    let holding_points =
        held.map(|frame| frame.holding_point(run.scene.stiffness_translation).into());
    let contacts = contacts(run).map(|contact| contact.point.into());
    let bounds = Window::around(bodies.chain(hands).chain(holding_points).chain(contacts))
        .unwrap_or_else(|| Window::centred((0.0, 0.0), 0.0, 0.0));
    let bounds = with_corners_near(run, bounds);
    let extent = bounds.width().max(bounds.height());
    let margin = if extent > 0.0 { 0.06 * extent } else { 0.5 };
    Window::centred(
        bounds.centre(),
        bounds.width() + 2.0 * margin,
        bounds.height() + 2.0 * margin,
    )
}

/// Nearby corners of obstacles are shown.
fn with_corners_near(run: &Run, bounds: Window) -> Window {
    let extent = bounds.width().max(bounds.height());
    let (width, height) = (
        bounds.width() + 0.5 * extent,
        bounds.height() + 0.5 * extent,
    );
    let near = Window::centred(bounds.centre(), width, height);
    let corners = run.scene.obstacles.iter().flat_map(corners_of);
    let corners = corners.filter(|&corner| near.contains(corner));
    Window::around(bounds.corners().into_iter().chain(corners)).unwrap_or(bounds)
}

fn axes(area: &Area, page: &Page, bounds: &Window) -> Drawn {
    let (unit, per_metre) = length_unit(bounds.width().max(bounds.height()));
    let label = |metres: &f64| tick(metres * per_metre, bounds.width() * per_metre);
    let (_, height) = sheet::size(area);
    ChartBuilder::on(area)
        .margin_left(px(page.edge))
        .set_label_area_size(LabelAreaPosition::Left, px(page.left - page.edge))
        .set_label_area_size(LabelAreaPosition::Bottom, px(AXIS))
        .margin_right(px(Page::RIGHT))
        .build_cartesian_2d(bounds.x.clone(), bounds.y.clone())?
        .configure_mesh()
        .x_labels(labels(page.inner()))
        .y_labels((height / 50.0) as usize)
        .bold_line_style(stroke(INK.mix(0.1), 1.0))
        .light_line_style(TRANSPARENT)
        .axis_style(stroke(INK, 1.0))
        .label_style(font(SMALL))
        .axis_desc_style(font(TEXT))
        .x_label_formatter(&label)
        .y_label_formatter(&label)
        .x_desc(format!("x [{unit}]"))
        .y_desc(format!("y [{unit}]"))
        .set_all_tick_mark_size(px(4.0))
        .draw()
}

fn bodies(view: &View, run: &Run, shown: &[&Frame]) -> Drawn {
    let Some((last, before)) = shown.split_last() else {
        return Ok(());
    };
    for frame in before {
        view.outline(&placed(&run.scene.vertices, frame.pose), BODY_THEN, 1.6)?;
    }
    let end = placed(&run.scene.vertices, last.pose);
    view.fill(&end, BODY_END.mix(0.4))?;
    view.outline(&end, BODY, 1.6)
}

fn paths(view: &View, run: &Run) -> Drawn {
    for point in dots(view, run) {
        view.dot(point, 2.2, FRICTION)?;
    }
    for [obstacle, corner] in run.touched_corners() {
        if let Some(&[x, y]) = run.scene.obstacles[obstacle].vertices.get(corner) {
            view.touched_corner((x, y), FRICTION)?;
        }
    }
    for (points, color, width) in lines(view, run) {
        view.line(&points, color, width)?;
        view.direction(&points, color)?;
    }
    let ends = [run.frames.first(), run.frames.last()].map(|frame| frame.map(hand_of));
    if let [Some(start), Some(end)] = ends {
        view.ring(start, 4.0, HAND)?;
        view.dot(end, 4.0, HAND)?;
    }
    Ok(())
}

fn hand_of(frame: &Frame) -> Point {
    (frame.hand[0], frame.hand[1])
}

/// Where vertices were in contact.
fn dots(view: &View, run: &Run) -> Vec<Point> {
    let count = run.scene.vertices.len();
    let of_vertex = |vertex: usize| {
        let contacts = contacts(run).filter(|contact| contact.touch.vertex() == Some(vertex));
        let points: Vec<_> = contacts.map(|contact| contact.point.into()).collect();
        sparse(&points, 0.8 * view.pixel, MOST_DOTS / count)
    };
    (0..count).flat_map(of_vertex).collect()
}

/// The paths of holding point and hand, with their colors and widths [px].
fn lines(view: &View, run: &Run) -> Vec<(Vec<Point>, RGBColor, f64)> {
    let path = |points: Vec<Point>| sparse(&points, 0.3 * view.pixel, MOST_POINTS);
    let mut lines = Vec::new();
    for span in run.frames.chunk_by(|a, b| a.held == b.held) {
        if span[0].held {
            let point = |frame: &Frame| frame.holding_point(run.scene.stiffness_translation).into();
            lines.push((path(span.iter().map(point).collect()), BODY, 3.2));
        }
        let color = if span[0].held { HAND } else { OPEN_HAND };
        lines.push((path(span.iter().map(hand_of).collect()), color, 1.4));
    }
    lines
}

/// What bodies and paths cover, in convex shapes.
fn covered(view: &View, run: &Run, shown: &[&Frame]) -> Vec<Vec<Point>> {
    let bodies = shown
        .iter()
        .map(|frame| placed(&run.scene.vertices, frame.pose));
    let dots = dots(view, run).into_iter().map(|dot| vec![dot]);
    let steps = lines(view, run).into_iter().flat_map(|(points, ..)| {
        let points = sparse(&points, COARSE * view.pixel, MOST_DOTS);
        let steps = points.windows(2).map(<[Point]>::to_vec);
        steps.collect::<Vec<_>>()
    });
    bodies.chain(dots).chain(steps).collect()
}
