//! The forces over time: for each touched surface and obstacle the normal reaction and the friction, summed over its contacts,
//! between the limits of sticking and of slipping; and the force of the hand's spring.

use super::legend::{Entry, Mark};
use super::page::Page;
use super::sheet::Drawn;
use super::style::*;
use super::timeline::{Curve, TimePanel, Timeline};
use stiction_live::record::{ContactRecord, Frame, Run};

/// A friction limit is shown up to this multiple of the largest force.
const ROOM_FOR_LIMITS: f64 = 1.5;

pub(super) fn svg(run: &Run, page: &Page) -> Drawn<String> {
    let touched = touched(run);
    let mut legend = Vec::new();
    if !touched.is_empty() {
        legend.extend([
            Entry::new(Mark::Line(NORMAL, 2.0), "normal N"),
            Entry::new(Mark::Line(FRICTION, 2.0), "friction T"),
            Entry::new(
                Mark::Line(STATIC_LIMIT, 1.3),
                format!("static limit ±{} N", symbol("μ", 's')),
            ),
            Entry::new(
                Mark::Line(DYNAMIC_LIMIT, 1.6),
                format!("slip end ±{} N", symbol("μ", 'd')),
            ),
        ]);
    }
    legend.extend([
        Entry::new(
            Mark::Line(HAND_FORCE, 2.0),
            format!("hand {}", symbol("F", 'x')),
        ),
        Entry::new(
            Mark::Line(HAND_FORCE_Y, 2.0),
            format!("hand {}", symbol("F", 'y')),
        ),
    ]);
    let mut panels: Vec<TimePanel> = touched.iter().map(|solid| reactions(run, solid)).collect();
    panels.push(hand(run));
    Timeline {
        run,
        page,
        title: format!("{}: forces on the body", run.scene.title),
        legend,
        panels,
    }
    .svg()
}

/// A surface or an obstacle.
struct Solid<'a> {
    name: &'a str,
    /// mu_s and mu_d.
    friction: [f64; 2],
    contacts: Box<dyn Fn(&ContactRecord) -> bool>,
}

fn touched(run: &Run) -> Vec<Solid<'_>> {
    let surfaces = run
        .scene
        .surfaces
        .iter()
        .enumerate()
        .map(|(k, surface)| Solid {
            name: &surface.name,
            friction: [surface.friction_static, surface.friction_dynamic],
            contacts: Box::new(move |contact| contact.touch.surface() == Some(k)),
        });
    let obstacles = run.scene.obstacles.iter().enumerate();
    let obstacles = obstacles.map(|(k, obstacle)| Solid {
        name: &obstacle.name,
        friction: [obstacle.friction_static, obstacle.friction_dynamic],
        contacts: Box::new(move |contact| contact.touch.obstacle() == Some(k)),
    });
    let contacts = || run.frames.iter().flat_map(|frame| &frame.contacts);
    let is_touched = |solid: &Solid<'_>| contacts().any(&solid.contacts);
    surfaces.chain(obstacles).filter(is_touched).collect()
}

fn reactions(run: &Run, solid: &Solid<'_>) -> TimePanel {
    let sum = |force: fn(&ContactRecord) -> f64| -> Vec<f64> {
        let of_solid = |frame: &Frame| {
            let contacts = frame.contacts.iter();
            contacts.filter(|c| (solid.contacts)(c)).map(force).sum()
        };
        run.frames.iter().map(of_solid).collect()
    };
    let [mu_s, mu_d] = solid.friction;
    let normal = sum(|contact| contact.normal);
    let friction = sum(|contact| contact.friction);
    let largest = normal
        .iter()
        .chain(&friction)
        .fold(0.0, |largest: f64, force| largest.max(force.abs()));
    let limit = |color, width, coefficient: f64| {
        let values: Vec<f64> = normal.iter().map(|n| coefficient * n).collect();
        let makes_room = values.iter().all(|v| v.abs() <= ROOM_FOR_LIMITS * largest);
        Curve {
            limit: true,
            makes_room,
            ..Curve::new(color, width, values)
        }
    };
    TimePanel {
        label: format!("{} [N]", solid.name),
        height: 210.0,
        lines: vec![
            limit(STATIC_LIMIT, 1.3, mu_s),
            limit(STATIC_LIMIT, 1.3, -mu_s),
            limit(DYNAMIC_LIMIT, 1.6, mu_d),
            limit(DYNAMIC_LIMIT, 1.6, -mu_d),
            Curve::new(NORMAL, 1.8, normal.clone()),
            Curve::new(FRICTION, 1.8, friction),
        ],
    }
}

fn hand(run: &Run) -> TimePanel {
    let force = |axis: usize| run.frames.iter().map(|frame| frame.wrench[axis]).collect();
    TimePanel {
        label: "hand [N]".to_owned(),
        height: 120.0,
        lines: vec![
            Curve::new(HAND_FORCE, 1.8, force(0)),
            Curve::new(HAND_FORCE_Y, 1.8, force(1)),
        ],
    }
}
