//! A strip of snapshots: body, hand and spring at some moments of the run, with the forces at the contacts and of the hand
//! as bars. All snapshots have one scale of lengths and one of forces.

use super::instants::choose;
use super::legend::{Entry, Heading, Mark};
use super::notes::tally;
use super::plane::{View, hand_angle, length_unit};
use super::sheet::{self, Area, Drawn, part, px, stroke};
use super::style::*;
use plotters::prelude::*;
use stiction_live::drawing::{Turn, Window, placed};
use stiction_live::record::{Frame, Run};

/// Room left and right of the snapshots [px].
const MARGIN: f64 = 14.0;
const COLUMNS: usize = 4;
const SNAPSHOTS: usize = 8;
/// Side of a snapshot and the room below it for its caption [px].
const SIDE: f64 = 234.0;
const CAPTION: f64 = 56.0;
const GAP: f64 = (WIDTH - 2.0 * MARGIN - COLUMNS as f64 * SIDE) / (COLUMNS - 1) as f64;

struct Scales {
    /// Side of a snapshot [m].
    window: f64,
    /// Length of a force bar [m/N].
    per_newton: f64,
    /// Largest moment of the hand [N·m].
    moment: f64,
}

pub(super) fn svg(run: &Run) -> Drawn<String> {
    let frames: Vec<&Frame> = choose(run, SNAPSHOTS)
        .into_iter()
        .map(|index| &run.frames[index])
        .collect();
    let scale = scale(run, &frames);
    let heading = Heading {
        title: format!("{}: snapshots", run.scene.title),
        entries: entries(&scale),
        margin: MARGIN,
    };
    let top = heading.height();
    let rows = frames.len().div_ceil(COLUMNS);
    let height = top + rows as f64 * (SIDE + CAPTION) + 4.0;
    sheet::svg((WIDTH, height), |area| {
        heading.draw(area)?;
        for (index, frame) in frames.iter().enumerate() {
            let x = MARGIN + (index % COLUMNS) as f64 * (SIDE + GAP);
            let y = top + (index / COLUMNS) as f64 * (SIDE + CAPTION);
            snapshot(&part(area, (x, y), (SIDE, SIDE)), run, frame, &scale)?;
            caption(&part(area, (x, y + SIDE), (SIDE, CAPTION)), frame, &scale)?;
        }
        Ok(())
    })
}

fn extent(run: &Run, frame: &Frame) -> Window {
    let hand = frame.held.then_some((frame.hand[0], frame.hand[1]));
    Window::around(
        placed(&run.scene.vertices, frame.pose)
            .into_iter()
            .chain(hand),
    )
    .unwrap_or_else(|| Window::centred((frame.pose[0], frame.pose[1]), 0.0, 0.0))
}

fn scale(run: &Run, frames: &[&Frame]) -> Scales {
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |a: f64, b| a.max(b.abs()));
    let side = |frame: &&Frame| {
        let extent = extent(run, frame);
        extent.width().max(extent.height())
    };
    let extent = largest(&mut frames.iter().map(side));
    let window = if extent > 0.0 { 1.4 * extent } else { 1.0 };
    let contacts = frames.iter().flat_map(|frame| &frame.contacts);
    let reactions = largest(&mut contacts.flat_map(|contact| [contact.normal, contact.friction]));
    let springs = largest(
        &mut frames
            .iter()
            .map(|frame| frame.wrench[0].hypot(frame.wrench[1])),
    );
    let force = reactions.max(springs);
    Scales {
        window,
        per_newton: if force > 0.0 {
            0.32 * window / force
        } else {
            0.0
        },
        moment: largest(&mut frames.iter().map(|frame| frame.wrench[2])),
    }
}

/// The meaning of the marks, and a bar for each scale.
fn entries(scale: &Scales) -> Vec<Entry> {
    let (unit, per_metre) = length_unit(scale.window);
    let pixel = scale.window / SIDE;
    let mut entries = vec![
        Entry::new(Mark::Line(NORMAL, 3.2), "normal force"),
        Entry::new(Mark::Line(FRICTION, 3.2), "friction"),
        Entry::new(Mark::Line(HAND_FORCE, 3.2), "hand force, moment (arc)"),
        Entry::new(Mark::Ring(HAND), "hand and spring"),
        Entry::new(Mark::Dot(BODY), "holding point"),
        scale_bar(1.0 / (per_metre * pixel), unit),
    ];
    if scale.per_newton > 0.0 {
        entries.push(scale_bar(scale.per_newton / pixel, "N"));
    }
    entries
}

/// A scale bar of 1, 2 or 5 times a power of ten, from the length of one unit [px].
fn scale_bar(one: f64, unit: &str) -> Entry {
    const LONGEST: f64 = 60.0;
    let decade = 10f64.powf((LONGEST / one).log10().floor());
    let fits = |step: &f64| step * decade * one <= LONGEST;
    let value = decade * [5.0, 2.0].into_iter().find(fits).unwrap_or(1.0);
    Entry::new(
        Mark::Scale(value * one),
        format!("{} {unit}", number(value)),
    )
}

fn snapshot(area: &Area, run: &Run, frame: &Frame, scale: &Scales) -> Drawn {
    let centre = extent(run, frame).centre();
    let view = View::new(area, Window::centred(centre, scale.window, scale.window))?;
    view.solids(run)?;
    view.names(&run.scene.obstacles, false)?;
    let body = placed(&run.scene.vertices, frame.pose);
    view.fill(&body, BODY.mix(0.14))?;
    view.outline(&body, BODY, 2.0)?;
    forces(&view, frame, scale)?;
    hand(&view, run, frame, scale)?;
    let edge = Rectangle::new([(0, 0), (px(SIDE) - 1, px(SIDE) - 1)], stroke(FAINT, 1.0));
    area.draw(&edge)
}

fn forces(view: &View, frame: &Frame, scale: &Scales) -> Drawn {
    for contact in &frame.contacts {
        let [nx, ny] = contact.direction;
        let point = contact.point.into();
        let normal = contact.normal * scale.per_newton;
        let friction = contact.friction * scale.per_newton;
        view.arrow(point, (nx * normal, ny * normal), NORMAL, 3.2)?;
        view.arrow(point, (ny * friction, -nx * friction), FRICTION, 3.2)?;
        view.dot(point, 3.0, INK)?;
    }
    Ok(())
}

/// The hand with its spring, force and moment; the strokes at its ring and at the holding point show phi and theta.
fn hand(view: &View, run: &Run, frame: &Frame, scale: &Scales) -> Drawn {
    let [x, y, _] = frame.hand;
    let phi = hand_angle(run, frame);
    let pointer = |(x, y): (f64, f64), angle: f64, color| {
        let length = 15.0 * view.pixel;
        view.line(
            &[(x, y), (x + length * angle.cos(), y + length * angle.sin())],
            color,
            1.8,
        )
    };
    if !frame.held {
        pointer((x, y), phi, OPEN_HAND)?;
        return view.ring((x, y), 5.0, OPEN_HAND);
    }
    let point = frame.holding_point(run.scene.stiffness_translation).into();
    let [fx, fy, moment] = frame.wrench;
    view.arrow(
        point,
        (fx * scale.per_newton, fy * scale.per_newton),
        HAND_FORCE,
        3.2,
    )?;
    if scale.moment > 0.0 {
        arc(view, point, moment / scale.moment)?;
    }
    view.spring(point, (x, y), HAND)?;
    pointer(point, frame.pose[2], BODY)?;
    view.dot(point, 3.5, BODY)?;
    pointer((x, y), phi, HAND)?;
    view.ring((x, y), 5.0, HAND)
}

/// A moment as an arc around a point: the share 1 is three quarters of a turn.
fn arc(view: &View, place: (f64, f64), share: f64) -> Drawn {
    let Some(turn) = Turn::new(place, share, view.pixel) else {
        return Ok(());
    };
    view.line(&turn.arc, HAND_FORCE, 2.2)?;
    view.arrow(turn.tip, turn.along, HAND_FORCE, 2.4)
}

fn caption(area: &Area, frame: &Frame, scale: &Scales) -> Drawn {
    let (unit, per_metre) = length_unit(scale.window);
    let [x, y, theta] = frame.pose;
    let decimals = |value: f64| format!("{value:.1}").replace('-', "−");
    let lines = [
        (
            font(TEXT),
            format!("t = {:.3} s: {}", frame.t, frame.state.name()),
        ),
        (
            font(SMALL),
            format!(
                "x {} {unit}, y {} {unit}, θ {}°",
                decimals(x * per_metre),
                decimals(y * per_metre),
                decimals(theta.to_degrees())
            ),
        ),
        (
            font(SMALL).color(&FRICTION),
            tally(frame.events.iter().map(|event| event.name())),
        ),
    ];
    let (width, _) = sheet::size(area);
    for ((style, text), y) in lines.iter().zip([11.0, 26.0, 40.0]) {
        area.draw_text(text, &centred(style), (px(width / 2.0), px(y)))?;
    }
    Ok(())
}
