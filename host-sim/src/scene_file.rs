//! A scene file: from TOML to a checked [`Scene`] of the solver and the hand's motion. Every message names the key, the
//! line, the value and what is allowed.

mod check;
mod document;
mod hand_section;
mod locate;

use std::path::Path;

use stiction_core::{Description, Full, Model, Real, Scene, SiFloat, Solver, SurfaceDescription};
use toml::Spanned;

use crate::number::Number;
use crate::record::SurfaceInfo;
use crate::source::{InputError, Source};
use check::Check;
use document::Document;
pub use hand_section::{HandSection, Motion};

/// At most this many vertices on the host.
pub const VERTICES: usize = 64;
/// At most this many surfaces on the host.
pub const SURFACES: usize = 16;

/// A scene with the capacities of the host.
pub type HostScene<R> = Scene<R, VERTICES, SURFACES>;

/// A solver of any scene file.
pub type HostSolver<R> = Solver<R, VERTICES, SURFACES>;

/// A scene file whose numbers are finite, in range and complete. Whether they make a scene is for
/// [`SceneFile::scene`] to say. SI units; see [`Description`] for the meaning of each.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The file name without its extension.
    pub title: String,
    /// Vertices (m), body frame.
    pub vertices: Vec<[f64; 2]>,
    /// x, y (m), theta (rad) of the body at the start.
    pub start: [f64; 3],
    /// Weight (N).
    pub weight: f64,
    /// The initial holding point (m), body frame.
    pub holding_point: Option<[f64; 2]>,
    /// How far outside the polygon a hand may be and still take hold (m).
    pub reach: f64,
    /// k_h (N/m)
    pub stiffness_translation: f64,
    /// k_theta (N·m/rad)
    pub stiffness_rotation: f64,
    /// The surfaces, their normals with length 1.
    pub surfaces: Vec<SurfaceInfo>,
    /// The hand's motion.
    pub hand: HandSection,
    source: Source,
    document: Document,
}

impl SceneFile {
    /// Reads a scene file for a number type.
    ///
    /// # Errors
    /// The file cannot be read, is not TOML, or a key is unknown, missing, of the wrong type or out of range.
    pub fn read(file: &Path, number: Number) -> Result<Self, InputError> {
        Self::parse(Source::read(file)?, number)
    }

    /// Reads a scene from text.
    ///
    /// # Errors
    /// As [`SceneFile::read`].
    pub fn parse(source: Source, number: Number) -> Result<Self, InputError> {
        let document: Document = toml::from_str(source.text()).map_err(|error| {
            let problem = error.message();
            match error.span() {
                Some(span) if span.start > 0 || span.len() < source.text().len() => {
                    source.error_at(span.start, problem)
                }
                _ => source.error(problem),
            }
        })?;
        let check = Check {
            source: &source,
            limit: number.limit(),
        };
        let (body, grasp, spring) = (&document.body, &document.grasp, &document.spring);
        let point = |given| check.numbers("grasp.point", given, "x and y");
        let title = source.file().file_stem().unwrap_or_default();
        Ok(Self {
            title: title.to_string_lossy().into_owned(),
            vertices: vertices(check, body)?,
            start: check.numbers("body.start", &body.start, "x, y and theta")?,
            weight: check.number_or("body.weight", body.weight.as_ref(), 0.0)?,
            holding_point: grasp.point.as_ref().map(point).transpose()?,
            reach: check.number_or("grasp.reach", grasp.reach.as_ref(), 0.0)?,
            stiffness_translation: check.number("spring.translation", &spring.translation)?,
            stiffness_rotation: check.number("spring.rotation", &spring.rotation)?,
            surfaces: surfaces(check, &document)?,
            hand: HandSection::new(check, &document.hand)?,
            document,
            source,
        })
    }

    /// The scene for the solver.
    ///
    /// # Errors
    /// The numbers do not make a scene: the message names the key that the solver's
    /// [`SceneError`](stiction_core::SceneError) is about.
    pub fn scene<R: Real>(&self) -> Result<HostScene<R>, InputError>
    where
        R::Si: SiFloat,
    {
        self.scene_in::<R, Full>()
    }

    /// The scene for a solver that lacks parts.
    ///
    /// # Errors
    /// As [`SceneFile::scene`]; also where the scene needs a part that is not there.
    pub fn scene_in<R: Real, M: Model>(&self) -> Result<Scene<R, VERTICES, SURFACES, M>, InputError>
    where
        R::Si: SiFloat,
    {
        self.described(|description| Scene::new(description))
            .map_err(|error| self.explain(&error))
    }

    /// The scene in the float of a solver, as it is given to it or sent to a board.
    pub(crate) fn described<F: SiFloat, T>(
        &self,
        take: impl FnOnce(&Description<'_, F>) -> T,
    ) -> T {
        let narrow = F::narrow;
        let vertices: Vec<_> = self.vertices.iter().map(|v| v.map(narrow)).collect();
        let surface = |s: &SurfaceInfo| SurfaceDescription {
            normal: s.normal.map(narrow),
            offset: narrow(s.offset),
            friction_static: narrow(s.friction_static),
            friction_dynamic: narrow(s.friction_dynamic),
        };
        let surfaces: Vec<_> = self.surfaces.iter().map(surface).collect();
        take(&Description {
            vertices: &vertices,
            start: self.start.map(narrow),
            weight: narrow(self.weight),
            holding_point: self.holding_point.map(|point| point.map(narrow)),
            reach: narrow(self.reach),
            stiffness_translation: narrow(self.stiffness_translation),
            stiffness_rotation: narrow(self.stiffness_rotation),
            surfaces: &surfaces,
        })
    }

    /// A problem of the whole file.
    pub(crate) fn error(&self, problem: &str) -> InputError {
        self.source.error(problem)
    }
}

fn vertices(check: Check<'_>, body: &document::Body) -> Result<Vec<[f64; 2]>, InputError> {
    match (&body.vertices, &body.rectangle) {
        (Some(list), None) => list
            .get_ref()
            .iter()
            .enumerate()
            .map(|(i, v)| check.numbers(&format!("body.vertices[{i}]"), v, "x and y"))
            .collect(),
        (None, Some(rectangle)) => {
            let key = "body.rectangle";
            let [width, height] = check.numbers(key, rectangle, "width and height")?;
            if width <= 0.0 || height <= 0.0 {
                return Err(check.error(key, rectangle, "width and height more than 0"));
            }
            let (x, y) = (width / 2.0, height / 2.0);
            Ok(vec![[-x, -y], [x, -y], [x, y], [-x, y]])
        }
        (Some(_), Some(rectangle)) => Err(check.source.error_at(
            rectangle.span().start,
            "`body.rectangle` is given besides `body.vertices`, allowed: one of the two",
        )),
        (None, None) => Err(check
            .source
            .error("[body] has neither `vertices` nor `rectangle`, allowed: one of the two")),
    }
}

fn surfaces(check: Check<'_>, document: &Document) -> Result<Vec<SurfaceInfo>, InputError> {
    let default = &document.friction;
    let fallback = Friction {
        stick: coefficient(check, "friction.static", default.stick.as_ref())?,
        slip: coefficient(check, "friction.dynamic", default.slip.as_ref())?,
    };
    if let (Some(stick), Some(slip), Some(given)) = (fallback.stick, fallback.slip, &default.stick)
        && stick < slip
    {
        return Err(check.error("friction.static", given, locate::STATIC_FRICTION));
    }
    let mut checked: Vec<SurfaceInfo> = Vec::new();
    for (i, given) in document.surface.iter().enumerate() {
        let surface = surface(check, i, given, fallback)?;
        if let Some(first) = checked.iter().position(|other| other.name == surface.name) {
            let name = &surface.name;
            let problem = format!(
                "`surface[{i}].name` is {name:?}, as that of surface {first}, allowed: a name of its own"
            );
            let place = given
                .get_ref()
                .name
                .as_ref()
                .map_or(given.span(), Spanned::span);
            return Err(check.source.error_at(place.start, problem));
        }
        checked.push(surface);
    }
    Ok(checked)
}

/// mu_s and mu_d, as far as they are given.
#[derive(Clone, Copy)]
struct Friction {
    stick: Option<f64>,
    slip: Option<f64>,
}

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
                check.source.error_at(given.span().start, problem)
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
