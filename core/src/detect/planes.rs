//! The first half-plane that a motion reaches among obstacles (STATICS 12), on which the placed point need not be a vertex.

use super::obstacles::{Reached, first_reached};
use crate::contact::Pair;
use crate::falls::{Level, first_fall};
use crate::motion::Instant;
use crate::real::Real;
use crate::search::Found;
use crate::world::World;

/// The first obstacle or half-plane that a piece of a motion from 0 to `end` reaches, but for contacts that last. `fastest`: no point of the
/// body goes faster.
pub(crate) fn first_met<R: Real, W: World<R>>(
    scene: &W,
    lasting: &[Pair],
    (end, fastest): (R, R),
    at: &dyn Fn(R) -> Instant<R>,
) -> Option<Reached<R>> {
    if end <= R::ZERO {
        return None;
    }
    let plane = first_plane(scene, lasting, (end, fastest), at);
    let end = plane.map_or(end, |reached| reached.x);
    if end <= R::ZERO {
        return plane;
    }
    first_reached(scene, lasting, (end, end), at).or(plane)
}

fn first_plane<R: Real, W: World<R>>(
    scene: &W,
    lasting: &[Pair],
    (end, fastest): (R, R),
    at: &dyn Fn(R) -> Instant<R>,
) -> Option<Reached<R>> {
    let start = at(R::ZERO);
    let mut first: Option<Reached<R>> = None;
    let pairs = scene.surface_indices().flat_map(|surface| {
        let vertices = scene.vertex_indices();
        vertices.map(move |vertex| Pair { vertex, surface })
    });
    for contact in pairs.filter(|pair| !lasting.contains(pair)) {
        let end = first.map_or(end, |reached| reached.x);
        if end <= R::ZERO || start.gap(scene, contact).value > fastest * end {
            continue;
        }
        let rounding = start.placed.rounding();
        let found = first_fall((end, end), |x| {
            [Some(Level::new(at(x).gap(scene, contact), rounding))]
        });
        first = match found {
            Found::Zero { x, .. } => Some((x, false)),
            Found::Unsure { x, .. } => Some((x, true)),
            Found::Nothing { .. } => None,
        }
        .map(|(x, unsure)| Reached { x, contact, unsure })
        .or(first);
    }
    first
}
