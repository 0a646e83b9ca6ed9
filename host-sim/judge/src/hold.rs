//! Contacts that could have held the body: if they bear the load at the hand's previous and current pose, they bear every load in
//! between, which is a combination of the two; so nothing happens to the body and it stays. And `jammed`, which is reported if
//! the contacts can hold the body only with reactions beyond 64 k_h L.
//!
//! The friction that may be assumed is mu_s if contacts only stick and slip. If they can also slide, a body without stiction has
//! mu_d. It has stiction if in the previous frame no reactions within mu_d bear the load.

use stiction_core::{Event, StateKind as State, Status};

use crate::bearing::Bearing;
use crate::finding::{Finding, law};
use crate::frame::{Contact, Frame};
use crate::slip::Step;
use crate::touch::Face;
use crate::vector::{Vec2, add, cross, distance, dot, length, scaled, sub};

/// Reactions that are certainly within the limit, whether the limit refers to N or to the whole reaction, and those that are
/// certainly beyond it, in units of the limit.
const WITHIN: f64 = 1.0 / 2.0;
const BEYOND: f64 = 17.0 / 16.0;

/// A load of this part of the limit needs large reactions in any case, and some number types refuse it.
const LOAD: f64 = 1.0 / 4.0;

pub(crate) fn findings(step: &Step<'_>) -> Vec<Finding> {
    let let_go = let_go(step).map(|let_go| Finding::whether(law::HOLDS, !let_go));
    let jammed = is_rightly_jammed(step).map(|holds| Finding::whether(law::JAMMED, holds));
    let_go.into_iter().chain(jammed).collect()
}

/// Whether at least two contacts keep the body from turning, and all contacts are known and stick.
fn is_fixed(frame: &Frame) -> bool {
    frame.held
        && frame.complete
        && !frame.slides()
        && matches!(frame.state, State::Edge | State::TwoVertex | State::Locked)
        && !frame.is_in_corner()
}

/// Whether the body moved although its contacts bear the load along the whole path of the hand.
fn let_go(step: &Step<'_>) -> Option<bool> {
    let (last, next) = (step.last, step.next);
    let follows = last.is_followed();
    if !follows || !is_fixed(last) || !next.held || next.is_taken() {
        return None;
    }
    // Slips and slides of contacts that stay, and motions without an event, are judged by other laws.
    let glides = |event: &Event| matches!(event, Event::Slip | Event::Slide | Event::Stop);
    let stays = next.events.iter().all(glides) && next.has_contacts_of(last);
    let moved = distance([last.pose[0], last.pose[1]], [next.pose[0], next.pose[1]])
        .max(step.model.size * (next.pose[2] - last.pose[2]).abs());
    let scale = [last, next].map(|frame| step.model.length_scale(frame, step.bounds));
    if stays || moved <= 2.0 * step.bounds.gap * scale[0].max(scale[1]) {
        return Some(false);
    }
    Some(bears_all_along(step) && !opens(step))
}

fn bears_all_along(step: &Step<'_>) -> bool {
    let (last, next) = (step.last, step.next);
    let bearing = |mu: fn(&Face) -> f64| Bearing::new(step.model, step.bounds, step.grip, last, mu);
    let of_static = bearing(|face| face.friction_static);
    let of_dynamic = bearing(|face| face.friction_dynamic);
    let limit = step.model.limit();
    // Beyond the limit a body is jammed, but it stays as well.
    let bears = |contacts: &Bearing<'_>| {
        let hands = [last.hand, next.hand];
        (hands.iter()).all(|hand| contacts.bears(*hand, step.bounds.slip, 2.0 * limit))
    };
    let has_stiction = !last.tells_slides()
        || (last.is_followed() && of_dynamic.least(last.hand) > BEYOND * limit);
    bears(if has_stiction {
        &of_static
    } else {
        &of_dynamic
    })
}

/// Whether somewhere on its path the hand's pull alone opens all gaps: a jam that is pulled apart may open (STATICS 5). The body
/// moves and turns as the springs allow; if none holds its angle, a stiffness k_h L² is assumed.
fn opens(step: &Step<'_>) -> bool {
    let (model, last) = (step.model, step.last);
    let k = model.scene.stiffness_translation;
    let holding = model.holding_point(last.pose, step.grip);
    let stiffness = match model.scene.stiffness_rotation {
        0.0 => k * model.size * model.size,
        of_springs => of_springs,
    };
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for contact in &last.contacts {
        let face = model.face(last.pose, contact.touch);
        let lever = sub(model.foot(last.pose, contact.touch), holding);
        let [at_begin, at_end] = [last.hand, step.next.hand].map(|hand| {
            let load = model.load(last.pose, hand, step.grip);
            let turn = load.moment / stiffness * cross(lever, face.normal);
            dot(load.force, face.normal) / k + turn
        });
        let least = model.carried(last, step.bounds);
        let zero = (at_begin - least) / (at_begin - at_end);
        match (at_begin >= least, at_end >= least) {
            (true, true) => {}
            (true, false) => to = to.min(zero),
            (false, true) => from = from.max(zero),
            (false, false) => return false,
        }
    }
    from <= to
}

/// Whether a vertex is jammed in a corner. It bears what its two cones together bear, whatever its turn: it is not jammed if reactions
/// within a limit (N) bear the load, nor if none do.
fn is_wedged(step: &Step<'_>, limit: f64) -> bool {
    let next = step.next;
    let force = step.model.load(next.pose, next.hand, step.grip).force;
    let edges = |mu: fn(&Face) -> f64| -> Vec<Vec2> {
        let of = |contact: &Contact| {
            let face = step.model.face(next.pose, contact.touch);
            let slant = scaled(face.tangent(), mu(&face));
            [add(face.normal, slant), sub(face.normal, slant)]
        };
        next.contacts.iter().flat_map(of).collect()
    };
    let borne = |edges: &[Vec2], limit: f64| {
        edges.iter().any(|&a| {
            edges.iter().any(|&b| {
                let volume = cross(a, b);
                let parts = [cross(b, force), -cross(a, force)].map(|part| part / volume);
                parts.iter().all(|part| (0.0..=limit).contains(part))
            })
        })
    };
    let is_jam = |edges: Vec<Vec2>| !borne(&edges, limit) && borne(&edges, f64::MAX);
    is_jam(edges(|face| face.friction_dynamic)) || is_jam(edges(|face| face.friction_static))
}

/// Whether the jam is reported correctly: a jammed body keeps its contacts, and no reactions within the limit bear its
/// load; a body with status ok has such reactions.
fn is_rightly_jammed(step: &Step<'_>) -> Option<bool> {
    let next = step.next;
    let limit = step.model.limit();
    let bearing = |mu: fn(&Face) -> f64| Bearing::new(step.model, step.bounds, step.grip, next, mu);
    if next.status == Status::Jammed {
        let keeps = !next.events.is_empty() || next.has_contacts_of(step.last);
        // In a corner the body can still turn, and contacts on one line bear no more than the load.
        let several = matches!(next.state, State::TwoVertex | State::Locked | State::Corner);
        let is_borne_or_moves = |contacts: &Bearing<'_>| {
            contacts.bears(next.hand, step.bounds.slip, WITHIN * limit)
                || contacts.never_bears(next.hand)
        };
        let frictions: [fn(&Face) -> f64; 2] =
            [|face| face.friction_dynamic, |face| face.friction_static];
        let idle = is_fixed(next) && frictions.iter().all(|mu| is_borne_or_moves(&bearing(*mu)));
        let idle_corner = next.is_in_corner() && !is_wedged(step, WITHIN * limit);
        return Some(keeps && several && !idle && !idle_corner);
    }
    let load = step.model.load(next.pose, next.hand, step.grip);
    let is_large = length(load.force) > LOAD * limit;
    if !next.is_followed() || !next.tells_slides() || !is_fixed(next) || is_large {
        return None;
    }
    let of_static = bearing(|face| face.friction_static);
    Some(of_static.least(next.hand) <= BEYOND * limit)
}
