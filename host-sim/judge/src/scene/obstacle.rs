//! Obstacles of a scene file: fixed convex polygons, thin walls and pins, read and validated.

use serde::Deserialize;
use toml::Spanned;

use super::{Friction, Text};
use crate::error::InputError;
use crate::shape::sides;
use crate::vector::{Vec2, cross, sub};

/// A fixed convex polygon that the body cannot enter.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Its name in traces.
    pub name: String,
    /// Corners w_k (m), world frame, counter-clockwise; 2: a thin wall with two sides, 1: a pin. Side k runs from corner k to the next.
    pub vertices: Vec<[f64; 2]>,
    /// mu_s
    pub friction_static: f64,
    /// mu_d
    pub friction_dynamic: f64,
    /// D_c (m), as given: 0 for the shortest length that is resolved, `None` for the default.
    pub memory: Option<f64>,
}

#[derive(Deserialize)]
pub(super) struct Entry {
    name: Option<String>,
    vertices: Spanned<Vec<[f64; 2]>>,
    #[serde(rename = "static")]
    stick: Option<f64>,
    dynamic: Option<f64>,
    memory: Option<Spanned<f64>>,
}

impl Entry {
    pub(super) fn corners(&self) -> usize {
        self.vertices.get_ref().len()
    }
}

impl Text<'_> {
    pub(super) fn obstacle(
        &self,
        i: usize,
        given: &Spanned<Entry>,
        default: &Friction,
    ) -> Result<Obstacle, InputError> {
        let entry = given.get_ref();
        let name = entry.name.clone().unwrap_or_else(|| i.to_string());
        let vertices = entry.vertices.get_ref();
        if let Some(problem) = fault(vertices) {
            let problem = format!("`vertices` of obstacle {name:?}: {problem}");
            return Err(self.error(Some(entry.vertices.span()), &problem));
        }
        let of = |key: &str, own: Option<f64>, default: &Option<Spanned<f64>>| {
            let default = default.as_ref().map(|value| *value.get_ref());
            let what = format!("obstacle {name:?}");
            self.friction((&what, key), own.or(default), given.span())
        };
        let key = format!("obstacle[{i}].memory");
        Ok(Obstacle {
            vertices: vertices.clone(),
            friction_static: of("static", entry.stick, &default.stick)?,
            friction_dynamic: of("dynamic", entry.dynamic, &default.dynamic)?,
            memory: self.memory(&key, entry.memory.as_ref(), default)?,
            name,
        })
    }
}

/// The fault in an obstacle's corners, and what is allowed.
fn fault(vertices: &[Vec2]) -> Option<String> {
    let finite = vertices.iter().flatten().all(|x| x.is_finite());
    if vertices.is_empty() || !finite {
        return Some("allowed: at least one, each of two finite numbers".to_owned());
    }
    let corner = |k: usize| vertices[k % vertices.len()];
    for k in 0..sides(vertices) {
        if corner(k) == corner(k + 1) {
            return Some(format!(
                "corner {k} is where the next one is, allowed: each once"
            ));
        }
        let [before, after] = [
            sub(corner(k + 1), corner(k)),
            sub(corner(k + 2), corner(k + 1)),
        ];
        if vertices.len() > 2 && cross(before, after) <= 0.0 {
            let k = (k + 1) % vertices.len();
            return Some(format!(
                "corner {k} does not turn to the left, allowed: a convex polygon, counter-clockwise"
            ));
        }
    }
    (vertices.len() > 2 && winds_twice(vertices))
        .then(|| "it goes round more than once, allowed: a convex polygon".to_owned())
}

/// Whether corners that all turn to the left do so by more than one full turn.
fn winds_twice(vertices: &[Vec2]) -> bool {
    let corner = |k: usize| vertices[k % vertices.len()];
    let turns = (0..vertices.len()).map(|k| {
        let [a, b] = [
            sub(corner(k + 1), corner(k)),
            sub(corner(k + 2), corner(k + 1)),
        ];
        cross(a, b).atan2(a[0] * b[0] + a[1] * b[1])
    });
    turns.sum::<f64>() > 1.5 * std::f64::consts::TAU
}
