//! Contacts that slide with the hand: what follows from one frame, and from two.
//!
//! **Tolerance.** T = -s mu_d N has to hold as exactly as at the end of a slip, and a foot may move back by no more than a
//! sticking contact may move. Signs of velocities count if the velocities exceed the uncertainty of the positions in the trace.

use stiction_core::{Event, Evolution, StateKind as State};

use crate::finding::{Bounds, Finding, law};
use crate::frame::{Contact, Frame};
use crate::model::{Grip, Model};
use crate::slip::{EVENTS, Step, drive, static_excess};
use crate::vector::{Vec3, cross, cross3, dot3, length3, sub};

/// If the normals of the contacts leave one motion of the body, the largest sine between two of them is at least this; if they
/// leave none, their volume.
const APART: f64 = 1e-3;

/// The findings on sliding contacts from one frame in balance.
pub(crate) fn alone(model: &Model, bounds: &Bounds, grip: &Grip, frame: &Frame) -> Vec<Finding> {
    if !frame.slides() {
        return Vec::new();
    }
    let scale = model.scale(frame, grip, bounds.slip, bounds.rounding);
    let of_reaction = if frame.contacts.len() > 1 {
        scale.moment
    } else {
        scale.force
    };
    let mut off = 0.0_f64;
    for contact in &frame.contacts {
        if let Some(sign @ (-1 | 1)) = contact.sliding {
            let mu = model.face(frame.pose, contact.touch).friction_dynamic;
            let reaction = (contact.normal, contact.friction);
            off = off.max(drive(reaction, mu, f64::from(sign)).abs());
        }
    }
    let mut findings = vec![Finding::new(law::SLIDES, off / of_reaction, bounds.slip)];
    if frame.complete && frame.contacts.len() > 1 {
        let holds = is_one_motion(model, bounds, frame);
        findings.extend(holds.map(|holds| Finding::whether(law::ONE_MOTION, holds)));
    }
    findings
}

/// Whether the signs of all slides are those of a motion that keeps every contact closed. `None` if the normals do not
/// determine that motion.
fn is_one_motion(model: &Model, bounds: &Bounds, frame: &Frame) -> Option<bool> {
    let centre = [frame.pose[0], frame.pose[1]];
    let face = |contact: &Contact| model.face(frame.pose, contact.touch);
    let wrench = |contact: &Contact, direction| -> Vec3 {
        let lever = sub(model.foot(frame.pose, contact.touch), centre);
        let moment = cross(lever, direction) / model.size;
        [direction[0], direction[1], moment]
    };
    let unit = |a: Vec3| a.map(|x| x / length3(a));
    let normals: Vec<Vec3> = (frame.contacts.iter())
        .map(|contact| unit(wrench(contact, face(contact).normal)))
        .collect();
    let pairs = (normals.iter().enumerate())
        .flat_map(|(i, &a)| normals[..i].iter().map(move |&b| cross3(a, b)));
    let twist = pairs.max_by(|a, b| length3(*a).total_cmp(&length3(*b)))?;
    let apart = length3(twist);
    if apart < APART {
        return None;
    }
    let twist = unit(twist);
    let volume = (normals.iter()).fold(0.0_f64, |most, n| most.max(dot3(*n, twist).abs()));
    // A vertex in a corner, or contacts that leave the body no motion.
    if frame.is_in_corner() || volume > APART {
        return Some(false);
    }
    let unknown = (4.0 * model.carried(frame, bounds) / model.size + volume) / apart;
    let fits = |forth: f64| {
        frame.contacts.iter().all(|contact| {
            let along = forth * dot3(twist, wrench(contact, face(contact).tangent()));
            match contact.sliding {
                Some(0) => along.abs() <= unknown,
                Some(sign) => f64::from(sign) * along >= -unknown,
                None => true,
            }
        })
    };
    Some(fits(1.0) || fits(-1.0))
}

pub(crate) fn findings(step: &Step<'_>) -> Vec<Finding> {
    let mut findings = Vec::new();
    findings.extend(reported(step).map(|holds| Finding::whether(law::SLIDE_REPORTED, holds)));
    findings.extend(stops(step));
    findings
}

/// Whether a slide begins with `slide` and ends with `stop`, or another event explains it. `None` if a contact has no
/// friction or no force, since it may then do either.
fn reported(step: &Step<'_>) -> Option<bool> {
    let (last, next) = (step.last, step.next);
    let usable = |frame: &Frame| {
        let grips = |contact: &Contact| {
            step.model.face(frame.pose, contact.touch).friction_static > 0.0
                && !is_idle(step.model, step.bounds, step.grip, frame, contact)
        };
        frame.is_usable() && frame.contacts.iter().all(grips)
    };
    let tells = [last, next].map(|frame| frame.contacts.is_empty() || frame.tells_slides());
    if !usable(last) || !usable(next) || tells != [true; 2] || next.events.len() >= EVENTS {
        return None;
    }
    let has = |event| next.events.contains(&event);
    let (before, after) = (last.slides(), next.slides());
    let one_surface = matches!(next.state, State::SingleVertex | State::Edge);
    let begun_and_gone = next.events.last() == Some(&Event::Slide) && !after;
    let ended_and_there = next.events.last() == Some(&Event::Stop) && after && one_surface;
    let ended_unbegun = next.events.first() == Some(&Event::Stop) && !before;
    let begun_with_stiction =
        next.events.first() == Some(&Event::Slide) && !before && has_stiction(step);
    if begun_and_gone || ended_and_there || ended_unbegun || begun_with_stiction {
        return Some(false);
    }
    let explains = |event: &Event| !matches!(event, Event::Slide | Event::Stop);
    if next.events.iter().any(explains) {
        return Some(true);
    }
    let signs = |frame: &Frame| frame.contacts.first().and_then(|contact| contact.sliding);
    let turns = before && after && one_surface && signs(last) != signs(next);
    let begins = (!before && after) || turns;
    let ends = (before && !after) || turns;
    Some((!begins || has(Event::Slide)) && (!ends || has(Event::Stop)))
}

/// Whether a contact has stiction: it bore more than mu_d N, and slips before it slides.
pub(crate) fn has_stiction(step: &Step<'_>) -> bool {
    let last = step.last;
    let Some(face) = step.one_friction(last) else {
        return false;
    };
    let sum = |of: fn(&Contact) -> f64| last.contacts.iter().map(of).sum::<f64>();
    let reaction = (sum(|c| c.normal), sum(|c| c.friction));
    matches!(last.state, State::SingleVertex | State::Edge)
        && static_excess(reaction, face.friction_dynamic) > step.allowed(false)
}

/// Whether the force on a contact is only rounding: the vertex swings along its surface as the body turns out of the way.
pub(crate) fn is_idle(
    model: &Model,
    bounds: &Bounds,
    grip: &Grip,
    frame: &Frame,
    contact: &Contact,
) -> bool {
    let scale = model.scale(frame, grip, bounds.residual, bounds.rounding);
    contact.normal.hypot(contact.friction) <= bounds.residual * scale.moment
}

/// A slide on one surface continues as long as N does not rise to N*, where it sticks.
fn stops(step: &Step<'_>) -> Option<Finding> {
    let (last, next) = (step.last, step.next);
    let face = step.one_friction(next)?;
    let is_one =
        matches!(next.state, State::SingleVertex | State::Edge) && last.state == next.state;
    let goes_on =
        next.events.is_empty() && next.has_contacts_of(last) && last.slides() && next.slides();
    if !is_one || !goes_on || step.evolution == Evolution::Frame || !face.jumps() {
        return None;
    }
    if ![last, next].iter().all(|frame| frame.is_followed()) {
        return None;
    }
    let threshold = step.model.threshold(&face);
    let normal = |frame: &Frame| -> f64 { frame.contacts.iter().map(|c| c.normal).sum() };
    let beyond = (threshold - normal(last)).min(normal(next) - threshold);
    Some(step.finding(law::SLIDE_STOPS, beyond.max(0.0), true))
}
