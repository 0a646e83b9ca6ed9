//! The laws of one frame: geometry and balance, from nothing but the scene, the grip and the frame.

use std::collections::BTreeSet;

use stiction_core::{StateKind as State, Touch};

use crate::finding::{Bounds, Finding, law};
use crate::frame::{Contact, Frame};
use crate::model::{Grip, Model};
use crate::obstacles;
use crate::pairs::Lined;
use crate::scene::Scene;
use crate::touch::share_vertex;
use crate::vector::{add, cross, distance, dot, length, sub};

pub(crate) fn finite(frame: &Frame) -> Finding {
    let contact = |c: &Contact| {
        let [x, y] = c.direction.unwrap_or_default();
        [c.point[0], c.point[1], x, y, c.normal, c.friction]
    };
    let holds = [frame.t, frame.depth]
        .into_iter()
        .chain(frame.hand)
        .chain(frame.pose)
        .chain(frame.wrench)
        .chain(frame.contacts.iter().flat_map(contact))
        .all(f64::is_finite);
    Finding::whether(law::FINITE, holds)
}

/// The finding on a contact that refers to a feature that the scene does not have.
pub(crate) fn unknown(model: &Model, frame: &Frame) -> Option<Finding> {
    let is_known = |contact: &Contact| model.has(contact.touch);
    let all = frame.contacts.iter().all(is_known);
    (!all).then(|| Finding::whether(law::EXISTS, false))
}

/// The state's name, and contacts that are listed twice.
pub(crate) fn names(model: &Model, bounds: &Bounds, frame: &Frame) -> [Finding; 2] {
    let contacts = &frame.contacts;
    let named = match contacts.as_slice() {
        _ if !frame.complete => frame.state == State::Locked,
        [] => frame.state == State::NonContact,
        [_] => frame.state == State::SingleVertex,
        [a, b] => is_named(model, bounds, frame, [a.touch, b.touch]),
        _ => frame.state == State::Locked,
    };
    let touches: BTreeSet<_> = contacts.iter().map(|contact| contact.touch).collect();
    let twice = touches.len() < contacts.len() || obstacles::share_a_place(model, frame);
    [
        Finding::whether(law::NAME, named),
        Finding::whether(law::ONCE, !twice),
    ]
}

/// Whether two contacts have the state's name, according to what they have in common.
fn is_named(model: &Model, bounds: &Bounds, frame: &Frame, pair: [Touch; 2]) -> bool {
    if share_vertex(pair[0], pair[1]) {
        return frame.state == State::Corner;
    }
    match model.lined(frame.pose, pair, model.carried(frame, bounds)) {
        Lined::Yes => frame.state == State::Edge,
        Lined::No => frame.state == State::TwoVertex,
        Lined::Maybe => matches!(frame.state, State::Edge | State::TwoVertex),
    }
}

pub(crate) fn geometry(model: &Model, bounds: &Bounds, frame: &Frame) -> Vec<Finding> {
    let size = model.length_scale(frame, bounds);
    let (mut inside, mut off, mut apart) = (0.0_f64, 0.0_f64, 0.0_f64);
    for &vertex in &model.scene.vertices {
        let place = Scene::place(frame.pose, vertex);
        for surface in &model.scene.surfaces {
            inside = inside.max(surface.offset - dot(surface.normal, place));
        }
    }
    for contact in &frame.contacts {
        off = off.max(model.gap(frame.pose, contact.touch).abs());
        apart = apart.max(distance(
            model.foot(frame.pose, contact.touch),
            contact.point,
        ));
    }
    inside = inside.max(obstacles::depth(model, frame));
    let mut findings = vec![(law::OUTSIDE, inside)];
    if !frame.contacts.is_empty() {
        findings.extend([(law::ON_SURFACE, off), (law::AT_VERTEX, apart)]);
    }
    let finding = |(law, length)| Finding::new(law, length / size, bounds.gap);
    let of_obstacles = obstacles::contacts(model, bounds, frame);
    (findings.into_iter().map(finding))
        .chain(of_obstacles)
        .collect()
}

/// Findings on springs, balance and friction. If not all contacts are known: on the springs alone, and on the known contacts.
pub(crate) fn statics(model: &Model, bounds: &Bounds, grip: &Grip, frame: &Frame) -> Vec<Finding> {
    let scale = model.scale(frame, grip, bounds.residual, bounds.rounding);
    let springs = model.springs(frame.pose, frame.hand, grip);
    let load = model.load(frame.pose, frame.hand, grip);
    let holding = model.holding_point(frame.pose, grip);
    let (mut force, mut moment) = (load.force, load.moment);
    let (mut outside, mut pulling) = (0.0_f64, 0.0_f64);
    for contact in &frame.contacts {
        let reaction = model.reaction(frame.pose, contact);
        let foot = model.foot(frame.pose, contact.touch);
        force = add(force, reaction);
        moment += cross(sub(foot, holding), reaction);
        let mu = model.face(frame.pose, contact.touch).friction_static;
        outside = outside.max((contact.friction.abs() - mu * contact.normal) / mu.hypot(1.0));
        pulling = pulling.max(-contact.normal);
    }
    let [fx, fy, reported] = frame.wrench;
    let exact = model.exactness(frame, grip, bounds);
    let wrench = (distance([fx, fy], springs.force) / exact.force)
        .max((reported - springs.moment).abs() / exact.moment);
    // Two or more reactions share a load, and the moment determines the shares.
    let of_reaction = if frame.contacts.len() > 1 {
        scale.moment
    } else {
        scale.force
    };
    let mut findings = Vec::new();
    if !frame.contacts.is_empty() {
        findings.push((law::CONE, outside / of_reaction));
        findings.push((law::PUSH, pulling / of_reaction));
    }
    if frame.complete {
        findings.push((law::FORCES, length(force) / scale.force));
        findings.push((law::MOMENTS, moment.abs() / (scale.moment * model.size)));
    }
    let finding = |(law, residual)| Finding::new(law, residual, bounds.residual);
    let of_springs = Finding::new(law::WRENCH, wrench, 1.0);
    (findings.into_iter().map(finding))
        .chain([of_springs])
        .collect()
}

pub(crate) fn idle(frame: &Frame) -> Finding {
    Finding::whether(law::IDLE, frame.wrench == [0.0; 3])
}
