//! The motion over time: the angles of hand and body, and along x and y the hand, the holding point and the vertices
//! and corners in contact. A vertex that sticks draws a level line and one that slips a step: the staircase of stick-slip.

use super::legend::{Entry, Mark};
use super::page::Page;
use super::plane::hand_angle;
use super::sheet::Drawn;
use super::style::*;
use super::timeline::{Curve, TimePanel, Timeline};
use stiction_live::record::{ContactRecord, Frame, Run};

/// The smallest offset of the hand's angle that is mentioned [rad].
const LEAST_OFFSET: f64 = 0.01;

pub(super) fn svg(run: &Run, page: &Page) -> Drawn<String> {
    let offset = |frame: &Frame| (hand_angle(run, frame) - frame.hand[2]).abs() > LEAST_OFFSET;
    let hand_text = if run.frames.iter().any(offset) {
        "hand (angle less its offset in the grip)"
    } else {
        "hand"
    };
    let mut legend = vec![
        Entry::new(Mark::Line(HAND, 1.4), hand_text),
        Entry::new(Mark::Line(BODY, 3.2), "body (angle, holding point)"),
    ];
    if run.frames.iter().any(|frame| !frame.held) {
        legend.insert(1, Entry::new(Mark::Line(OPEN_HAND, 1.4), "hand, open"));
    }
    if run.frames.iter().any(|frame| !frame.contacts.is_empty()) {
        let text = if run.touched_corners().is_empty() {
            "vertices in contact"
        } else {
            "vertices and corners in contact"
        };
        legend.push(Entry::new(Mark::Line(FRICTION, 2.4), text));
    }
    Timeline {
        run,
        page,
        title: format!("{}: motion of hand and body", run.scene.title),
        legend,
        panels: vec![
            angles(run),
            positions(run, 0, "x [mm]"),
            positions(run, 1, "y [mm]"),
        ],
    }
    .svg()
}

/// One value per frame of those that `shown` picks.
fn values(run: &Run, shown: impl Fn(&Frame) -> bool, value: impl Fn(&Frame) -> f64) -> Vec<f64> {
    let value = |frame| if shown(frame) { value(frame) } else { f64::NAN };
    run.frames.iter().map(value).collect()
}

/// The lines of the hand: holding, and open.
fn hand(run: &Run, value: impl Fn(&Frame) -> f64) -> [Curve; 2] {
    [
        Curve::new(OPEN_HAND, 1.4, values(run, |frame| !frame.held, &value)),
        Curve::new(HAND, 1.4, values(run, |frame| frame.held, &value)),
    ]
}

fn angles(run: &Run) -> TimePanel {
    let body = values(run, |_| true, |frame| frame.pose[2].to_degrees());
    let mut lines = vec![Curve::new(BODY, 3.2, body)];
    lines.extend(hand(run, |frame| hand_angle(run, frame).to_degrees()));
    TimePanel {
        label: "angle [°]".to_owned(),
        height: 150.0,
        lines,
    }
}

fn positions(run: &Run, axis: usize, label: &str) -> TimePanel {
    let held = values(
        run,
        |frame| frame.held,
        |frame| 1e3 * frame.holding_point(run.scene.stiffness_translation)[axis],
    );
    let mut lines = vec![Curve::new(BODY, 3.2, held)];
    lines.extend(hand(run, |frame| 1e3 * frame.hand[axis]));
    let mut follow = |is_it: &dyn Fn(&ContactRecord) -> bool| {
        let touching = |frame: &Frame| {
            let contact = frame.contacts.iter().find(|contact| is_it(contact));
            contact.map_or(f64::NAN, |contact| 1e3 * contact.point[axis])
        };
        lines.push(Curve::new(FRICTION, 2.4, values(run, |_| true, touching)));
    };
    for vertex in 0..run.scene.vertices.len() {
        follow(&|contact| contact.touch.vertex() == Some(vertex));
    }
    for corner in run.touched_corners() {
        follow(&|contact| contact.touch.corner() == Some(corner));
    }
    TimePanel {
        label: label.to_owned(),
        height: 190.0,
        lines,
    }
}
