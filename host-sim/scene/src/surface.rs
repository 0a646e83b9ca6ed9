//! `[[surface]]` and `[friction]`, checked: half-planes with a name, a unit normal, both coefficients and the memory length.

use toml::Spanned;

use crate::check::Check;
use crate::document::{self, Document};
use crate::source::{InputError, excerpt};

/// What static friction may be.
const STATIC_FRICTION: &str = "not less than the dynamic friction";

/// A fixed half-plane: the free side is `normal`·p >= `offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceInfo {
    /// Its name in traces.
    pub name: String,
    /// Unit normal to the free side.
    pub normal: [f64; 2],
    /// Distance of the surface from the world's origin along the normal (m).
    pub offset: f64,
    /// mu_s
    pub friction_static: f64,
    /// mu_d
    pub friction_dynamic: f64,
    /// Memory length (m); `None` where the file gives none.
    pub memory: Option<f64>,
}

/// The surfaces of a file.
pub(crate) fn surfaces(
    check: Check<'_>,
    document: &Document,
) -> Result<Vec<SurfaceInfo>, InputError> {
    let default = &document.friction;
    let fallback = Friction {
        stick: coefficient(check, "friction.static", default.stick.as_ref())?,
        slip: coefficient(check, "friction.dynamic", default.slip.as_ref())?,
        memory: coefficient(check, "friction.memory", default.memory.as_ref())?,
    };
    if let (Some(stick), Some(slip), Some(given)) = (fallback.stick, fallback.slip, &default.stick)
        && stick < slip
    {
        return Err(check.error("friction.static", given, STATIC_FRICTION));
    }
    let mut checked: Vec<SurfaceInfo> = Vec::new();
    for (i, given) in document.surface.iter().enumerate() {
        let surface = surface(check, i, given, fallback)?;
        if let Some(first) = checked.iter().position(|other| other.name == surface.name) {
            let name = excerpt(&surface.name);
            let problem = format!(
                "`surface[{i}].name` is {name:?}, as that of surface {first}, allowed: a name of its own"
            );
            let place = given
                .get_ref()
                .name
                .as_ref()
                .map_or(given.span(), Spanned::span);
            return Err(check.source().error_at(place.start, problem));
        }
        checked.push(surface);
    }
    Ok(checked)
}

/// mu_s, mu_d and the memory length, as far as they are given.
#[derive(Clone, Copy)]
struct Friction {
    stick: Option<f64>,
    slip: Option<f64>,
    memory: Option<f64>,
}

/// A number of 0 or more.
fn coefficient(
    check: Check<'_>,
    key: &str,
    given: Option<&document::Number>,
) -> Result<Option<f64>, InputError> {
    let Some(given) = given else {
        return Ok(None);
    };
    let value = check.number(key, given)?;
    if value < 0.0 {
        return Err(check.error(key, given, "0 or more"));
    }
    Ok(Some(value))
}

fn surface(
    check: Check<'_>,
    i: usize,
    given: &Spanned<document::Surface>,
    fallback: Friction,
) -> Result<SurfaceInfo, InputError> {
    let surface = given.get_ref();
    let key = |name| format!("surface[{i}].{name}");
    let friction = |name, own: &Option<_>, default: Option<f64>| {
        coefficient(check, &key(name), own.as_ref())?
            .or(default)
            .ok_or_else(|| {
                let problem = format!(
                    "surface {i} has no `{name}` friction, allowed: `{name}` here or in [friction]"
                );
                check.source().error_at(given.span().start, problem)
            })
    };
    let normal = check.numbers(&key("normal"), &surface.normal, "x and y")?;
    let unit = unit_vector(normal).ok_or_else(|| {
        let allowed = "a vector that is not zero";
        check.error(&key("normal"), &surface.normal, allowed)
    })?;
    Ok(SurfaceInfo {
        name: match &surface.name {
            Some(name) => name.get_ref().clone(),
            None => i.to_string(),
        },
        normal: unit,
        offset: check.number(&key("offset"), &surface.offset)?,
        friction_static: friction("static", &surface.stick, fallback.stick)?,
        friction_dynamic: friction("dynamic", &surface.slip, fallback.slip)?,
        memory: coefficient(check, &key("memory"), surface.memory.as_ref())?.or(fallback.memory),
    })
}

/// The vector with length 1; scaled first, so that squares neither overflow nor vanish.
fn unit_vector([x, y]: [f64; 2]) -> Option<[f64; 2]> {
    let size = x.abs().max(y.abs());
    if size == 0.0 {
        return None;
    }
    let (x, y) = (x / size, y / size);
    let length = x.hypot(y);
    Some([x / length, y / length])
}
