//! Contacts that could have held: a body whose contacts bear the load where the hand was and where it is bears every load between
//! them, as these are the sums of both, so that nothing happens to it and it stays. And `jammed`, which is told where the
//! contacts could hold the body with reactions beyond 64 k_h L alone.
//!
//! The friction that can be counted on is mu_s where contacts do nothing but stick and slip. Where they slide, too, a body
//! without stiction has mu_d. It has stiction if in the frame before no reactions within mu_d bear the load.

use crate::bearing::Bearing;
use crate::finding::{Finding, law};
use crate::frame::{Contact, Event, Frame, State, Status};
use crate::model::LIMIT;
use crate::slip::Step;
use crate::touch::Face;
use crate::vector::{Vec2, add, cross, distance, dot, length, scaled, sub};

/// Reactions that are certainly within the limit, whether N is meant or the whole, and those that are certainly beyond, in units
/// of it.
const WITHIN: f64 = 1.0 / 2.0;
const BEYOND: f64 = 17.0 / 16.0;

/// A load this large (k_h L) asks for large reactions anyway, and some number types refuse it.
const LOAD: f64 = 16.0;

/// What a frame and the one before tell of contacts that hold.
pub(crate) fn findings(step: &Step<'_>) -> Vec<Finding> {
    let let_go = let_go(step).map(|let_go| Finding::whether(law::HOLDS, !let_go));
    let jammed = is_rightly_jammed(step).map(|holds| Finding::whether(law::JAMMED, holds));
    let_go.into_iter().chain(jammed).collect()
}

/// Two contacts at least keep the body from turning, and all contacts are known and stick.
fn is_fixed(frame: &Frame) -> bool {
    frame.held
        && frame.complete
        && !frame.slides()
        && matches!(frame.state, State::Edge | State::TwoVertex | State::Locked)
        && (frame.contacts.iter())
            .any(|contact| !contact.touch.shares_vertex(frame.contacts[0].touch))
}

/// The body went elsewhere although its contacts bear the load all along the hand's way.
fn let_go(step: &Step<'_>) -> Option<bool> {
    let (last, next) = (step.last, step.next);
    let follows = last.status.is_followed();
    let is_taken = |event: &Event| matches!(event, Event::Grasp | Event::Release);
    if !follows || !is_fixed(last) || !next.held || next.events.iter().any(is_taken) {
        return None;
    }
    // Slips and slides of contacts that stay, and motions without an event, are other laws' concern.
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
    let limit = LIMIT * step.model.unit_force();
    // Beyond the limit a body is jammed, and stays no less.
    let bears = |contacts: &Bearing<'_>| {
        let hands = [last.hand, next.hand];
        (hands.iter()).all(|hand| contacts.bears(*hand, step.bounds.slip, 2.0 * limit))
    };
    let has_stiction = !last.tells_slides()
        || (last.status.is_followed() && of_dynamic.least(last.hand) > BEYOND * limit);
    bears(if has_stiction {
        &of_static
    } else {
        &of_dynamic
    })
}

/// Somewhere on its way the hand's pull alone opens all gaps: a jam that is pulled apart may open (STATICS 5). The body goes and
/// turns as the springs let it; where none holds its angle, as one of its size.
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

/// A vertex in a corner bears what its two cones bear together, whatever its turn: it is not jammed where reactions within a limit (N) do
/// so, nor where none do.
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

/// A body that is told to be jammed keeps its contacts, and they bear the load with no reactions within the limit; one that
/// is told to be well has such reactions.
fn is_rightly_jammed(step: &Step<'_>) -> Option<bool> {
    let next = step.next;
    let limit = LIMIT * step.model.unit_force();
    let bearing = |mu: fn(&Face) -> f64| Bearing::new(step.model, step.bounds, step.grip, next, mu);
    if next.status == Status::Jammed {
        let keeps = !next.events.is_empty() || next.has_contacts_of(step.last);
        // In a corner the body turns on, and one of one line bears no more than its load.
        let several = matches!(next.state, State::TwoVertex | State::Locked | State::Corner);
        let is_borne_or_moves = |contacts: &Bearing<'_>| {
            contacts.bears(next.hand, step.bounds.slip, WITHIN * limit)
                || contacts.never_bears(next.hand)
        };
        let frictions: [fn(&Face) -> f64; 2] =
            [|face| face.friction_dynamic, |face| face.friction_static];
        let idle = is_fixed(next) && frictions.iter().all(|mu| is_borne_or_moves(&bearing(*mu)));
        let idle_corner = next.state == State::Corner && !is_wedged(step, WITHIN * limit);
        return Some(keeps && several && !idle && !idle_corner);
    }
    let load = step.model.load(next.pose, next.hand, step.grip);
    let is_large = length(load.force) > LOAD * step.model.unit_force();
    if !next.status.is_followed() || !next.tells_slides() || !is_fixed(next) || is_large {
        return None;
    }
    let of_static = bearing(|face| face.friction_static);
    Some(of_static.least(next.hand) <= BEYOND * limit)
}
