//! The laws of one frame among obstacles: how deep the body is, whether each contact is on its side and faces it, and which features
//! touch without being a contact.
//!
//! **Tolerance.** Two contacts on one obstacle that are closer than 2^-19 L are one, so the ends of sides are known only to that
//! accuracy, in addition to the tolerance of gaps. A touch is certain only if the gap is within rounding in two consecutive frames.

use stiction_core::{Event, Touch};

use crate::finding::{Bounds, Finding, law};
use crate::frame::{Contact, Frame};
use crate::model::Model;
use crate::pairs::Lined;
use crate::scene::Scene;
use crate::shape::{ends, separation};
use crate::vector::{Vec2, distance, dot, length, sub};

/// Contacts on one obstacle that are closer than this (L) are one.
pub(crate) const OVERLAP: f64 = 1.0 / 524_288.0;
/// The largest gap of a touching pair, in roundings of the farthest coordinate.
const CLOSED: f64 = 8.0;
/// Normals whose dot product exceeds this are equal.
const SAME_NORMAL: f64 = 1.0 - 1e-9;

/// The vertices of the body in the world frame.
pub(crate) fn placed(model: &Model, pose: [f64; 3]) -> Vec<Vec2> {
    let vertices = model.scene.vertices.iter();
    vertices.map(|&vertex| Scene::place(pose, vertex)).collect()
}

/// The greatest depth of the body in an obstacle (m); negative if it is apart from all.
pub(crate) fn depth(model: &Model, frame: &Frame) -> f64 {
    let body = placed(model, frame.pose);
    let apart = (model.scene.obstacles.iter()).map(|o| separation(&body, &o.vertices));
    -apart.fold(f64::INFINITY, f64::min)
}

pub(crate) fn share_a_place(model: &Model, frame: &Frame) -> bool {
    let place = |contact: &Contact| model.foot(frame.pose, contact.touch);
    (frame.contacts.iter().enumerate()).any(|(i, a)| {
        frame.contacts[..i].iter().any(|b| {
            a.touch.obstacle().is_some()
                && a.touch.obstacle() == b.touch.obstacle()
                && distance(place(a), place(b)) <= OVERLAP / 2.0 * model.size
        })
    })
}

/// Contacts with obstacles are on their sides, which face the body; reported directions are the normals.
pub(crate) fn contacts(model: &Model, bounds: &Bounds, frame: &Frame) -> Vec<Finding> {
    let size = model.length_scale(frame, bounds);
    let (mut beyond, mut hidden) = (0.0_f64, 0.0_f64);
    for contact in &frame.contacts {
        beyond = beyond.max(-model.inside_ends(frame.pose, contact.touch));
        hidden = hidden.max(model.unsupported(frame.pose, contact.touch));
    }
    let mut findings = Vec::new();
    if frame.meets_obstacles() {
        let little = OVERLAP * model.size / size;
        findings.push(Finding::new(
            law::ON_SIDE,
            beyond / size,
            bounds.gap + little,
        ));
        // Two contacts near each other tell the body's angle, and with it the sides beyond them, less exactly.
        let span = match &frame.contacts[..] {
            [a, b] => {
                distance(
                    model.foot(frame.pose, a.touch),
                    model.foot(frame.pose, b.touch),
                ) / model.size
            }
            _ => 1.0,
        };
        let allowed = bounds.gap / span.clamp(OVERLAP, 1.0) + little;
        findings.push(Finding::new(law::FACES, hidden / size, allowed));
    }
    let off = |contact: &Contact| -> Option<f64> {
        let reported = sub(
            contact.direction?,
            model.face(frame.pose, contact.touch).normal,
        );
        let unknown = model.carried(frame, bounds) / model.size;
        let allowed = bounds.gap + unknown + blur(model, bounds, contact.touch);
        Some(length(reported) / allowed)
    };
    let worst = frame.contacts.iter().filter_map(off).reduce(f64::max);
    findings.extend(worst.map(|off| Finding::new(law::DIRECTION, off, 1.0)));
    findings
}

/// The uncertainty of a side's normal due to the rounding of its ends.
fn blur(model: &Model, bounds: &Bounds, touch: Touch) -> f64 {
    let [from, to] = match touch {
        Touch::Surface { .. } => return 0.0,
        Touch::Side { obstacle, side, .. } => ends(&model.scene.obstacles[obstacle].vertices, side),
        Touch::Corner { body_side, .. } => ends(&model.scene.vertices, body_side),
    };
    4.0 * bounds.rounding * length(from).max(length(to)) / distance(from, to)
}

/// Features that touched in the previous frame without being a contact.
#[derive(Clone, Debug, Default)]
pub(crate) struct Unreported {
    /// Each pair, with whether it is known to have opened.
    pairs: Vec<(Touch, bool)>,
}

impl Unreported {
    /// A pair that touches in two consecutive frames, as far as is certain, is a contact; except one that has opened and has
    /// not moved away yet.
    pub(crate) fn next(
        &mut self,
        model: &Model,
        bounds: &Bounds,
        (last, frame): (Option<&Frame>, &Frame),
    ) -> Option<Finding> {
        if !frame.is_usable() || model.scene.obstacles.is_empty() {
            self.pairs.clear();
            return None;
        }
        let is_quiet = |event: &Event| matches!(event, Event::Slide | Event::Stop);
        let happened = !frame.events.iter().all(is_quiet);
        let known = |touch: Touch| self.pairs.iter().find(|(pair, _)| *pair == touch);
        let mut holds = true;
        let mut pairs = Vec::new();
        for touch in closed(model, bounds, frame) {
            if represents(model, bounds, frame, touch) {
                continue;
            }
            let was_contact = last.is_some_and(|last| represents(model, bounds, last, touch));
            let opened = known(touch).map_or(happened && was_contact, |(_, opened)| *opened);
            holds &= opened || known(touch).is_none();
            pairs.push((touch, opened));
        }
        self.pairs = pairs;
        Some(Finding::whether(law::REPORTED, holds))
    }
}

/// The pairs whose gap is within rounding, away from the ends of their sides.
fn closed(model: &Model, bounds: &Bounds, frame: &Frame) -> Vec<Touch> {
    let zone = CLOSED / 64.0 * model.carried(frame, bounds);
    let body = placed(model, frame.pose);
    let near =
        |obstacle: &usize| separation(&body, &model.scene.obstacles[*obstacle].vertices) <= zone;
    let is_closed = |touch: &Touch| {
        model.gap(frame.pose, *touch).abs() <= zone
            && model.inside_ends(frame.pose, *touch) >= 2.0 * OVERLAP * model.size
            && model.unsupported(frame.pose, *touch) <= zone
    };
    let obstacles = (0..model.scene.obstacles.len()).filter(near);
    let pairs = obstacles.flat_map(|obstacle| model.pairs_with(obstacle));
    pairs.filter(is_closed).collect()
}

/// Whether the contacts of a frame represent a pair: by one at its place on the same obstacle or with the same normal, or by two on
/// one line with it, on both sides of it.
fn represents(model: &Model, bounds: &Bounds, frame: &Frame, touch: Touch) -> bool {
    let pose = frame.pose;
    let (place, face) = (model.foot(pose, touch), model.face(pose, touch));
    let stands_for = |contact: &Contact| {
        let other = contact.touch;
        let same = other.obstacle() == touch.obstacle()
            || dot(model.face(pose, other).normal, face.normal) > SAME_NORMAL;
        let near = distance(model.foot(pose, other), place) <= 2.0 * OVERLAP * model.size;
        other == touch || (same && near)
    };
    let unknown = model.carried(frame, bounds);
    let in_line = frame
        .contacts
        .iter()
        .filter(|contact| model.lined(pose, [contact.touch, touch], unknown) != Lined::No);
    let ways: Vec<f64> = in_line
        .map(|contact| dot(sub(model.foot(pose, contact.touch), place), face.tangent()))
        .collect();
    frame.contacts.iter().any(stands_for)
        || (ways.iter().any(|&way| way > 0.0) && ways.iter().any(|&way| way < 0.0))
}
