//! The forces over time: for each surface that is touched the normal reaction and the friction, summed over its contacts,
//! between the limits of sticking and of slipping; and the force of the hand's spring.

use super::legend::{Entry, Mark};
use super::sheet::Drawn;
use super::style::*;
use super::timeline::{Line, Panel, Timeline};
use crate::record::{Frame, Run};

/// A friction limit is shown up to this multiple of the largest force.
const ROOM_FOR_LIMITS: f64 = 1.5;

/// The picture as SVG.
pub(super) fn svg(run: &Run) -> Drawn<String> {
    let touched = |&surface: &usize| run.frames.iter().any(|frame| touches(frame, surface));
    let surfaces: Vec<usize> = (0..run.surfaces.len()).filter(touched).collect();
    let mut legend = Vec::new();
    if !surfaces.is_empty() {
        legend.extend([
            Entry::new(Mark::Line(NORMAL, 2.0), "normal N"),
            Entry::new(Mark::Line(FRICTION, 2.0), "friction T"),
            Entry::new(Mark::Line(STATIC_LIMIT, 1.3), "static limit ±μs N"),
            Entry::new(Mark::Line(DYNAMIC_LIMIT, 1.6), "slip end ±μd N"),
        ]);
    }
    legend.extend([
        Entry::new(Mark::Line(HAND_FORCE, 2.0), "hand Fx"),
        Entry::new(Mark::Line(HAND_FORCE_Y, 2.0), "hand Fy"),
    ]);
    let mut panels: Vec<Panel> = surfaces
        .iter()
        .map(|&surface| reactions(run, surface))
        .collect();
    panels.push(hand(run));
    Timeline {
        run,
        title: format!("{}: forces on the body", run.title),
        legend,
        panels,
    }
    .svg()
}

fn touches(frame: &Frame, surface: usize) -> bool {
    frame
        .contacts
        .iter()
        .any(|contact| contact.surface == surface)
}

/// The panel of a surface.
fn reactions(run: &Run, index: usize) -> Panel {
    let surface = &run.surfaces[index];
    let sum = |force: fn(&crate::record::ContactRecord) -> f64| -> Vec<f64> {
        let of_surface = |frame: &Frame| {
            let contacts = frame
                .contacts
                .iter()
                .filter(|contact| contact.surface == index);
            contacts.map(force).sum()
        };
        run.frames.iter().map(of_surface).collect()
    };
    let normal = sum(|contact| contact.normal);
    let friction = sum(|contact| contact.friction);
    let largest = normal
        .iter()
        .chain(&friction)
        .fold(0.0, |largest: f64, force| largest.max(force.abs()));
    let limit = |color, width, coefficient: f64| {
        let values: Vec<f64> = normal.iter().map(|n| coefficient * n).collect();
        let makes_room = values.iter().all(|v| v.abs() <= ROOM_FOR_LIMITS * largest);
        Line {
            limit: true,
            makes_room,
            ..Line::new(color, width, values)
        }
    };
    Panel {
        label: format!("{} [N]", surface.name),
        height: 210.0,
        lines: vec![
            limit(STATIC_LIMIT, 1.3, surface.friction_static),
            limit(STATIC_LIMIT, 1.3, -surface.friction_static),
            limit(DYNAMIC_LIMIT, 1.6, surface.friction_dynamic),
            limit(DYNAMIC_LIMIT, 1.6, -surface.friction_dynamic),
            Line::new(NORMAL, 1.8, normal.clone()),
            Line::new(FRICTION, 1.8, friction),
        ],
    }
}

/// The panel of the hand's spring.
fn hand(run: &Run) -> Panel {
    let force = |axis: usize| run.frames.iter().map(|frame| frame.wrench[axis]).collect();
    Panel {
        label: "hand force [N]".to_owned(),
        height: 120.0,
        lines: vec![
            Line::new(HAND_FORCE, 1.8, force(0)),
            Line::new(HAND_FORCE_Y, 1.8, force(1)),
        ],
    }
}
