//! `[[surface]]`, checked: half-planes with a name, a unit normal, both coefficients and the memory length.

use serde::{Deserialize, Serialize};
use toml::Spanned;

use crate::check::Check;
use crate::document::{self, Document};
use crate::friction::{Fallback, Owner};
use crate::name::Names;
use crate::source::InputError;

/// A fixed half-plane: the free side is `normal`·p >= `offset`.
///
/// Serialised with the keys of a scene file.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SurfaceInfo {
    /// Its name in traces.
    pub name: String,
    /// Unit normal to the free side.
    pub normal: [f64; 2],
    /// Distance of the surface from the world's origin along the normal (m).
    pub offset: f64,
    /// mu_s
    #[serde(rename = "static")]
    pub friction_static: f64,
    /// mu_d
    #[serde(rename = "dynamic")]
    pub friction_dynamic: f64,
    /// Memory length (m); `None` if the file gives none.
    pub memory: Option<f64>,
}

pub(crate) fn surfaces(
    check: Check<'_>,
    document: &Document,
    fallback: Fallback,
    names: &mut Names,
) -> Result<Vec<SurfaceInfo>, InputError> {
    let given = document.surface.iter().enumerate();
    given
        .map(|(i, given)| surface(check, (i, given), fallback, names))
        .collect()
}

fn surface(
    check: Check<'_>,
    (i, given): (usize, &Spanned<document::Surface>),
    fallback: Fallback,
    names: &mut Names,
) -> Result<SurfaceInfo, InputError> {
    let surface = given.get_ref();
    let key = |name| format!("surface[{i}].{name}");
    let normal = check.numbers(&key("normal"), &surface.normal, "x and y")?;
    let unit = unit_vector(normal).ok_or_else(|| {
        let allowed = "a vector that is not zero";
        check.error(&key("normal"), &surface.normal, allowed)
    })?;
    let offset = check.number(&key("offset"), &surface.offset)?;
    let owner = Owner {
        kind: "surface",
        index: i,
        span: given.span(),
        name: surface.name.as_ref(),
        stick: surface.stick.as_ref(),
        slip: surface.slip.as_ref(),
        memory: surface.memory.as_ref(),
    };
    let friction = fallback.of(check, &owner)?;
    Ok(SurfaceInfo {
        name: names.take(check, &owner)?,
        normal: unit,
        offset,
        friction_static: friction.stick,
        friction_dynamic: friction.slip,
        memory: friction.memory,
    })
}

/// The vector scaled to length 1; it is first scaled so that squares neither overflow nor vanish.
fn unit_vector([x, y]: [f64; 2]) -> Option<[f64; 2]> {
    let size = x.abs().max(y.abs());
    if size == 0.0 {
        return None;
    }
    let (x, y) = (x / size, y / size);
    let length = x.hypot(y);
    Some([x / length, y / length])
}
