//! `[[obstacle]]`, checked: convex polygons, thin walls and pins with a name, both coefficients and the memory length. The solver
//! checks whether the corners make a convex polygon.

use serde::{Deserialize, Serialize};
use toml::Spanned;

use crate::check::Check;
use crate::document::{self, Document};
use crate::friction::{Fallback, Owner};
use crate::name::Names;
use crate::source::InputError;

/// A fixed obstacle with corners.
///
/// Serialised with the keys of a scene file.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ObstacleInfo {
    /// Its name in traces.
    pub name: String,
    /// Its corners (m), world frame, counter-clockwise; two: a thin wall, one: a pin.
    pub vertices: Vec<[f64; 2]>,
    /// mu_s
    #[serde(rename = "static")]
    pub friction_static: f64,
    /// mu_d
    #[serde(rename = "dynamic")]
    pub friction_dynamic: f64,
    /// Memory length (m); `None` if the file gives none.
    pub memory: Option<f64>,
}

pub(crate) fn obstacles(
    check: Check<'_>,
    document: &Document,
    fallback: Fallback,
    names: &mut Names,
) -> Result<Vec<ObstacleInfo>, InputError> {
    let given = document.obstacle.iter().enumerate();
    given
        .map(|(i, given)| obstacle(check, (i, given), fallback, names))
        .collect()
}

fn obstacle(
    check: Check<'_>,
    (i, given): (usize, &Spanned<document::Obstacle>),
    fallback: Fallback,
    names: &mut Names,
) -> Result<ObstacleInfo, InputError> {
    let obstacle = given.get_ref();
    let list = &obstacle.vertices;
    if list.get_ref().is_empty() {
        let problem = format!("`obstacle[{i}].vertices` is empty, allowed: at least one corner");
        return Err(check.source().error_at(list.span().start, problem));
    }
    let corner =
        |(k, corner)| check.numbers(&format!("obstacle[{i}].vertices[{k}]"), corner, "x and y");
    let vertices = list.get_ref().iter().enumerate().map(corner);
    let vertices = vertices.collect::<Result<_, _>>()?;
    let owner = Owner {
        kind: "obstacle",
        index: i,
        span: given.span(),
        name: obstacle.name.as_ref(),
        stick: obstacle.stick.as_ref(),
        slip: obstacle.slip.as_ref(),
        memory: obstacle.memory.as_ref(),
    };
    let friction = fallback.of(check, &owner)?;
    Ok(ObstacleInfo {
        name: names.take(check, &owner)?,
        vertices,
        friction_static: friction.stick,
        friction_dynamic: friction.slip,
        memory: friction.memory,
    })
}
