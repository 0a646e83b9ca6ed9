//! A strip of snapshots: body, hand and spring at some moments of the run, with the forces at the contacts and of the hand
//! as bars. All snapshots have one scale of lengths and one of forces.

use super::instants::{choose, nearest};
use super::legend::{Entry, Heading, Mark};
use super::notes::tally;
use super::page::{Page, wrapped};
use super::plane::{View, hand_angle, length_unit};
use super::sheet::{self, Area, Drawn, part, px, stroke};
use super::style::*;
use plotters::prelude::*;
use stiction_live::drawing::{Turn, Window, placed};
use stiction_live::record::{ContactRecord, Frame, Run};

/// Room left and right of the snapshots on a screen, and between them [px].
const MARGIN: f64 = 14.0;
const GAP: f64 = 12.0;
/// Height of a line of a caption, and room around its lines [px].
const LINE: f64 = 14.5;
const AROUND: f64 = 12.5;
/// Height of a snapshot relative to its width.
const HEIGHTS: (f64, f64) = (0.55, 1.0);
/// All snapshots show one part of the plane if it is at most this many times as large as the largest of theirs.
const COMMON: f64 = 2.2;
/// The part of a snapshot's sides that body and hand fill at most.
const FILLED: f64 = 1.0 / 1.4;

/// Height of a cone of friction relative to the normal force, so that it shows beside a reaction at its edge.
const CONE: f64 = 1.3;

struct Scales {
    /// Width and height of a snapshot [px], and metres per pixel.
    size: (f64, f64),
    pixel: f64,
    /// The centre of all snapshots, if it is common.
    centre: Option<(f64, f64)>,
    /// Length of a force bar [m/N].
    per_newton: f64,
    /// Largest moment of the hand [N·m].
    moment: f64,
}

pub(super) fn svg(run: &Run, page: &Page) -> Drawn<String> {
    let frames: Vec<&Frame> = match page.at.is_empty() {
        true => choose(run, page.snapshots)
            .into_iter()
            .map(|index| &run.frames[index])
            .collect(),
        false => nearest(&run.frames, &page.at).collect(),
    };
    let margin = MARGIN.min(page.margin);
    let columns = page.columns.min(frames.len()).max(1);
    let gaps = (columns - 1) as f64 * GAP;
    let side = (page.width - 2.0 * margin - gaps) / columns as f64;
    let scale = scale(run, &frames, side);
    let (width, height) = scale.size;
    let captions: Vec<Vec<CaptionLine>> = frames.iter().map(|f| caption(f, &scale)).collect();
    let lines = captions.iter().map(Vec::len).max().unwrap_or(0);
    let below = AROUND + LINE * lines as f64;
    let heading = Heading {
        page,
        title: format!("{}: snapshots", run.scene.title),
        entries: entries(run, &frames, &scale),
        margin,
    };
    let top = heading.height();
    let rows = frames.len().div_ceil(columns);
    sheet::svg(page, top + rows as f64 * (height + below) + 4.0, |area| {
        heading.draw(area)?;
        for (index, (frame, caption)) in frames.iter().zip(&captions).enumerate() {
            let x = margin + (index % columns) as f64 * (width + GAP);
            let y = top + (index / columns) as f64 * (height + below);
            let before = index.checked_sub(1).map(|before| frames[before]);
            snapshot(&part(area, (x, y), scale.size), run, frame, before, &scale)?;
            for (k, (style, line)) in caption.iter().enumerate() {
                let place = (px(x + width / 2.0), px(y + height + 11.0 + LINE * k as f64));
                area.draw_text(line, &centred(style), place)?;
            }
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

/// The part of the plane that snapshots show: the width and height that hold each, and their centre, if they have one part.
fn shown(run: &Run, frames: &[&Frame]) -> ((f64, f64), Option<(f64, f64)>) {
    let extents: Vec<Window> = frames.iter().map(|frame| extent(run, frame)).collect();
    let most = |side: fn(&Window) -> f64| extents.iter().map(side).fold(0.0, f64::max);
    let largest = (most(Window::width), most(Window::height));
    let corners = extents.iter().flat_map(|extent| extent.corners());
    match Window::around(corners) {
        Some(all) if all.width().max(all.height()) <= COMMON * largest.0.max(largest.1) => {
            ((all.width(), all.height()), Some(all.centre()))
        }
        _ => (largest, None),
    }
}

fn scale(run: &Run, frames: &[&Frame], side: f64) -> Scales {
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |a: f64, b| a.max(b.abs()));
    let ((width, height), centre) = shown(run, frames);
    // The room of the forces is as large in both directions.
    let room = (1.0 / FILLED - 1.0) * width.max(height);
    let (width, height) = match width.max(height) > 0.0 {
        true => (width + room, height + room),
        false => (1.0, 1.0),
    };
    let aspect = (height / width).clamp(HEIGHTS.0, HEIGHTS.1);
    let pixel = (width / side).max(height / (aspect * side));
    let contacts = frames.iter().flat_map(|frame| &frame.contacts);
    let reactions = largest(&mut contacts.flat_map(|contact| [contact.normal, contact.friction]));
    let springs = largest(
        &mut frames
            .iter()
            .map(|frame| frame.wrench[0].hypot(frame.wrench[1])),
    );
    let force = reactions.max(springs);
    Scales {
        size: (side, aspect * side),
        pixel,
        centre,
        per_newton: if force > 0.0 {
            0.32 * pixel * aspect * side / force
        } else {
            0.0
        },
        moment: largest(&mut frames.iter().map(|frame| frame.wrench[2])),
    }
}

/// The meaning of the marks, and a bar for each scale.
fn entries(run: &Run, frames: &[&Frame], scale: &Scales) -> Vec<Entry> {
    let (unit, per_metre) = scale.unit();
    let pixel = scale.pixel;
    let mut entries = vec![
        Entry::new(Mark::Line(NORMAL, 3.2), "normal force"),
        Entry::new(Mark::Line(FRICTION, 3.2), "friction"),
    ];
    let contacts = || frames.iter().flat_map(|frame| &frame.contacts);
    if contacts().any(|contact| cone(run, contact) > 0.0) {
        entries.push(Entry::new(Mark::Line(INK, 1.3), "reaction"));
        entries.push(Entry::new(Mark::Line(STATIC_LIMIT, 1.3), "static cone"));
    }
    entries.extend([
        Entry::new(Mark::Line(HAND_FORCE, 3.2), "hand force, moment (arc)"),
        Entry::new(Mark::Ring(HAND), "hand and spring"),
        Entry::new(Mark::Dot(BODY), "holding point"),
    ]);
    if scale.centre.is_some() && frames.len() > 1 {
        let text = "body in the picture before";
        entries.push(Entry::new(Mark::Line(BODY_THEN, 1.2), text));
    }
    entries.push(scale_bar(1.0 / (per_metre * pixel), unit));
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

/// A frame, over the outline of the body in the frame before if all show one part of the plane.
fn snapshot(
    area: &Area,
    run: &Run,
    frame: &Frame,
    before: Option<&Frame>,
    scale: &Scales,
) -> Drawn {
    let (width, height) = scale.size;
    let centre = scale.centre.unwrap_or_else(|| extent(run, frame).centre());
    let window = Window::centred(centre, width * scale.pixel, height * scale.pixel);
    let view = View::new(area, window)?;
    view.solids(run)?;
    view.names_inside(&run.scene.obstacles)?;
    if let (Some(before), Some(_)) = (before, scale.centre) {
        view.outline(&placed(&run.scene.vertices, before.pose), BODY_THEN, 1.2)?;
    }
    let body = placed(&run.scene.vertices, frame.pose);
    view.fill(&body, BODY.mix(0.14))?;
    view.outline(&body, BODY, 2.0)?;
    forces(&view, run, frame, scale)?;
    hand(&view, run, frame, scale)?;
    let edge = Rectangle::new(
        [(0, 0), (px(width) - 1, px(height) - 1)],
        stroke(FAINT, 1.0),
    );
    area.draw(&edge)
}

/// mu_s of a contact.
fn cone(run: &Run, contact: &ContactRecord) -> f64 {
    let surface = contact
        .touch
        .surface()
        .and_then(|k| run.scene.surfaces.get(k));
    let obstacle = contact
        .touch
        .obstacle()
        .and_then(|k| run.scene.obstacles.get(k));
    let surface = surface.map(|surface| surface.friction_static);
    let obstacle = obstacle.map(|obstacle| obstacle.friction_static);
    surface.or(obstacle).unwrap_or(0.0)
}

/// The forces of the contacts, each in its cone of static friction.
fn forces(view: &View, run: &Run, frame: &Frame, scale: &Scales) -> Drawn {
    for contact in &frame.contacts {
        let [nx, ny] = contact.direction;
        let point: (f64, f64) = contact.point.into();
        let normal = contact.normal * scale.per_newton;
        let friction = contact.friction * scale.per_newton;
        let ends = [1.0, -1.0].map(|side| {
            let along = CONE * normal;
            let across = side * cone(run, contact) * along;
            (
                point.0 + nx * along + ny * across,
                point.1 + ny * along - nx * across,
            )
        });
        for end in ends {
            view.line(&[point, end], STATIC_LIMIT, 1.3)?;
        }
        let reaction = (nx * normal + ny * friction, ny * normal - nx * friction);
        view.arrow(point, reaction, INK, 1.3)?;
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

/// A line of a caption.
type CaptionLine = (TextStyle<'static>, String);

impl Scales {
    /// The unit of lengths, and how many of it make a metre.
    fn unit(&self) -> (&'static str, f64) {
        length_unit(self.pixel * self.size.0)
    }
}

fn caption(frame: &Frame, scale: &Scales) -> Vec<CaptionLine> {
    let (unit, per_metre) = scale.unit();
    let [x, y, theta] = frame.pose;
    // Without a zero that has a sign.
    let decimals = |value: f64| {
        let rounded = (10.0 * value).round() / 10.0 + 0.0;
        format!("{rounded:.1}").replace('-', "−")
    };
    // A space that no line is broken at.
    const SPACE: char = '\u{a0}';
    let texts: [(f64, &'static RGBColor, String); 3] = [
        (
            TEXT,
            &INK,
            format!("t = {:.3} s: {}", frame.t, frame.state.name()),
        ),
        (
            SMALL,
            &INK,
            format!(
                "x{SPACE}{}{SPACE}{unit}, y{SPACE}{}{SPACE}{unit}, θ{SPACE}{}°",
                decimals(x * per_metre),
                decimals(y * per_metre),
                decimals(theta.to_degrees())
            ),
        ),
        (
            SMALL,
            &FRICTION,
            tally(frame.events.iter().map(|event| event.name())),
        ),
    ];
    let mut lines = Vec::new();
    for (size, color, text) in texts {
        let style = font(size).color(color);
        let broken = wrapped(&text, size, scale.size.0);
        lines.extend(broken.into_iter().map(|line| (style.clone(), line)));
    }
    lines
}
