//! The part of a scene file that a judge needs: body, springs, surfaces, obstacles, the initial holding point. SI units; other keys
//! are left to the program that runs the scene.

use std::collections::HashSet;
use std::ops::Range;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;

use crate::error::InputError;
use crate::touch::Face;
use crate::vector::{Vec2, add, length, turned};
pub use obstacle::Obstacle;

mod obstacle;

/// A scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Vertices of the body (m), body frame, counter-clockwise; 1: a point, 2: a rod.
    pub vertices: Vec<[f64; 2]>,
    /// The pose of the body before the first record: x, y (m), theta (rad) of the body frame in the world.
    pub start: [f64; 3],
    /// W (N), at the centroid, along world -y.
    pub weight: f64,
    /// The initial holding point g (m), body frame; `None`: taken from the hand at the grasp.
    pub holding_point: Option<[f64; 2]>,
    /// k_h (N/m)
    pub stiffness_translation: f64,
    /// k_theta (N·m/rad)
    pub stiffness_rotation: f64,
    /// The surfaces.
    pub surfaces: Vec<Surface>,
    /// The obstacles.
    pub obstacles: Vec<Obstacle>,
}

/// A fixed half-plane: the free side is `normal`·p >= `offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Its name in traces.
    pub name: String,
    /// Unit normal n to the free side.
    pub normal: [f64; 2],
    /// b (m)
    pub offset: f64,
    /// mu_s
    pub friction_static: f64,
    /// mu_d
    pub friction_dynamic: f64,
    /// D_c (m), as given: 0 for the shortest length that is resolved, `None` for the default.
    pub memory: Option<f64>,
}

impl Surface {
    /// The properties of the surface that a contact needs.
    pub(crate) const fn face(&self) -> Face {
        Face {
            normal: self.normal,
            friction_static: self.friction_static,
            friction_dynamic: self.friction_dynamic,
            memory: self.memory,
        }
    }
}

#[derive(Deserialize)]
struct Document {
    body: Body,
    #[serde(default)]
    grasp: Grasp,
    spring: Spring,
    #[serde(default)]
    friction: Friction,
    #[serde(default)]
    surface: Vec<Spanned<SurfaceEntry>>,
    #[serde(default)]
    obstacle: Vec<Spanned<obstacle::Entry>>,
}

#[derive(Deserialize)]
struct Body {
    vertices: Option<Spanned<Vec<[f64; 2]>>>,
    rectangle: Option<Spanned<[f64; 2]>>,
    start: Spanned<[f64; 3]>,
    weight: Option<Spanned<f64>>,
}

#[derive(Default, Deserialize)]
struct Grasp {
    point: Option<Spanned<[f64; 2]>>,
}

#[derive(Deserialize)]
struct Spring {
    translation: Spanned<f64>,
    rotation: Spanned<f64>,
}

#[derive(Default, Deserialize)]
struct Friction {
    #[serde(rename = "static")]
    stick: Option<Spanned<f64>>,
    dynamic: Option<Spanned<f64>>,
    memory: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
struct SurfaceEntry {
    name: Option<String>,
    normal: Spanned<[f64; 2]>,
    offset: Spanned<f64>,
    #[serde(rename = "static")]
    stick: Option<f64>,
    dynamic: Option<f64>,
    memory: Option<Spanned<f64>>,
}

/// The largest number of vertices, surfaces and corners of a scene: they are examined in pairs, a million of them. It is sixteen times
/// the solver's capacity.
const MOST: usize = 1024;

/// The text of a scene, for messages with line numbers.
struct Text<'a> {
    file: &'a Path,
    text: &'a str,
}

impl Text<'_> {
    fn error(&self, place: Option<Range<usize>>, problem: &str) -> InputError {
        let Some(place) = place else {
            return InputError::of_file(self.file, problem);
        };
        let before = self.text.get(..place.start).unwrap_or(self.text);
        let line = 1 + before.matches('\n').count() as u64;
        InputError::in_line(self.file, line, problem)
    }

    fn check_counts(&self, document: &Document) -> Result<(), InputError> {
        let vertices = document.body.vertices.as_ref();
        let corners = document.obstacle.iter().map(|o| o.get_ref().corners());
        let counts = [
            ("vertices", vertices.map_or(0, |list| list.get_ref().len())),
            ("surfaces", document.surface.len()),
            ("corners of obstacles", corners.sum()),
        ];
        match counts.into_iter().find(|(_, count)| *count > MOST) {
            Some((what, count)) => {
                let problem = format!("there are {count} {what}, allowed: at most {MOST}");
                Err(self.error(None, &problem))
            }
            None => Ok(()),
        }
    }

    fn number(&self, key: &str, given: &Spanned<f64>, least: f64) -> Result<f64, InputError> {
        let value = *given.get_ref();
        if value.is_finite() && value >= least {
            return Ok(value);
        }
        let allowed = if least.is_finite() {
            format!("a finite number of at least {least:?}")
        } else {
            "a finite number".to_owned()
        };
        let problem = format!("`{key}` is {value:?}, allowed: {allowed}");
        Err(self.error(Some(given.span()), &problem))
    }

    fn numbers<const N: usize>(
        &self,
        key: &str,
        given: &Spanned<[f64; N]>,
    ) -> Result<[f64; N], InputError> {
        let values = *given.get_ref();
        if values.iter().all(|value| value.is_finite()) {
            return Ok(values);
        }
        let problem = format!("`{key}` is {values:?}, allowed: finite numbers");
        Err(self.error(Some(given.span()), &problem))
    }

    fn vertices(&self, body: &Body) -> Result<Vec<Vec2>, InputError> {
        match (&body.vertices, &body.rectangle) {
            (Some(given), None) => {
                let vertices = given.get_ref();
                let finite = vertices.iter().flatten().all(|x| x.is_finite());
                if finite && !vertices.is_empty() {
                    return Ok(vertices.clone());
                }
                let problem = "`body.vertices`: allowed: at least one, each of two finite numbers";
                Err(self.error(Some(given.span()), problem))
            }
            (None, Some(given)) => {
                let [x, y] = self
                    .numbers("body.rectangle", given)?
                    .map(|side| side / 2.0);
                Ok(vec![[-x, -y], [x, -y], [x, y], [-x, y]])
            }
            _ => {
                let problem = "[body], allowed: one of `vertices` and `rectangle`";
                Err(self.error(None, problem))
            }
        }
    }

    fn surface(
        &self,
        i: usize,
        given: &Spanned<SurfaceEntry>,
        default: &Friction,
    ) -> Result<Surface, InputError> {
        let surface = given.get_ref();
        let key = |name: &str| format!("surface[{i}].{name}");
        let normal = self.numbers(&key("normal"), &surface.normal)?;
        let size = length(normal);
        if size == 0.0 {
            let problem = format!("`{}` is zero, allowed: a direction", key("normal"));
            return Err(self.error(Some(surface.normal.span()), &problem));
        }
        let friction = |name: &str, own: Option<f64>, default: &Option<Spanned<f64>>| {
            let default = default.as_ref().map(|value| *value.get_ref());
            self.friction(
                (&format!("surface {i}"), name),
                own.or(default),
                given.span(),
            )
        };
        let memory = self.memory(&key("memory"), surface.memory.as_ref(), default)?;
        Ok(Surface {
            name: surface.name.clone().unwrap_or_else(|| i.to_string()),
            normal: normal.map(|x| x / size),
            offset: self.number(&key("offset"), &surface.offset, f64::NEG_INFINITY)?,
            friction_static: friction("static", surface.stick, &default.stick)?,
            friction_dynamic: friction("dynamic", surface.dynamic, &default.dynamic)?,
            memory,
        })
    }

    /// A coefficient of friction, and what it belongs to.
    fn friction(
        &self,
        (what, name): (&str, &str),
        value: Option<f64>,
        place: Range<usize>,
    ) -> Result<f64, InputError> {
        match value {
            Some(mu) if mu >= 0.0 && mu.is_finite() => Ok(mu),
            _ => {
                let problem = format!(
                    "{what} has no usable `{name}` friction, allowed: a finite number of at least 0, here or in [friction]"
                );
                Err(self.error(Some(place), &problem))
            }
        }
    }

    /// A memory length, of the surface itself or the common one.
    fn memory(
        &self,
        key: &str,
        own: Option<&Spanned<f64>>,
        default: &Friction,
    ) -> Result<Option<f64>, InputError> {
        match (own, &default.memory) {
            (Some(own), _) => self.number(key, own, 0.0).map(Some),
            (None, Some(given)) => self.number("friction.memory", given, 0.0).map(Some),
            (None, None) => Ok(None),
        }
    }
}

impl Scene {
    /// Reads a scene file.
    ///
    /// # Errors
    /// The file cannot be read, or as for [`Scene::parse`].
    pub fn read(file: &Path) -> Result<Self, InputError> {
        let bytes = stiction_text::read(file);
        let bytes = bytes.map_err(|problem| InputError::of_file(file, problem))?;
        let text =
            String::from_utf8(bytes).map_err(|_| InputError::of_file(file, "is not UTF-8 text"))?;
        Self::parse(file, &text)
    }

    /// Reads a scene from text; `file` is its name in messages.
    ///
    /// # Errors
    /// The text is not TOML, or a required key is missing, of the wrong type or out of range.
    pub fn parse(file: &Path, text: &str) -> Result<Self, InputError> {
        let source = Text { file, text };
        let document: Document = toml::from_str(text)
            .map_err(|error| source.error(error.span(), error.message().trim_end()))?;
        source.check_counts(&document)?;
        let Document { body, spring, .. } = &document;
        let weight = body.weight.as_ref();
        let surfaces = document.surface.iter().enumerate();
        let obstacles = document.obstacle.iter().enumerate();
        let scene = Self {
            vertices: source.vertices(body)?,
            start: source.numbers("body.start", &body.start)?,
            weight: weight.map_or(Ok(0.0), |given| source.number("body.weight", given, 0.0))?,
            holding_point: (document.grasp.point.as_ref())
                .map(|given| source.numbers("grasp.point", given))
                .transpose()?,
            stiffness_translation: source.number(
                "spring.translation",
                &spring.translation,
                f64::MIN_POSITIVE,
            )?,
            stiffness_rotation: source.number("spring.rotation", &spring.rotation, 0.0)?,
            surfaces: surfaces
                .map(|(i, given)| source.surface(i, given, &document.friction))
                .collect::<Result<_, _>>()?,
            obstacles: obstacles
                .map(|(i, given)| source.obstacle(i, given, &document.friction))
                .collect::<Result<_, _>>()?,
        };
        let surfaces: Vec<&str> = scene.surfaces.iter().map(|s| s.name.as_str()).collect();
        if let Some(i) = second(&surfaces) {
            let place = document.surface.get(i).map(Spanned::span);
            let problem = format!("a second surface is named {:?}", surfaces[i]);
            return Err(source.error(place, &problem));
        }
        let obstacles: Vec<&str> = scene.obstacles.iter().map(|s| s.name.as_str()).collect();
        if let Some(i) = second(&obstacles) {
            let place = document.obstacle.get(i).map(Spanned::span);
            let problem = format!("a second obstacle is named {:?}", obstacles[i]);
            return Err(source.error(place, &problem));
        }
        Ok(scene)
    }

    /// The position of a point of the body frame in the world, for a pose of the body.
    pub(crate) fn place(pose: [f64; 3], point: Vec2) -> Vec2 {
        add([pose[0], pose[1]], turned(point, pose[2]))
    }
}

/// The first name that occurred before.
fn second(names: &[&str]) -> Option<usize> {
    let mut known = HashSet::new();
    names.iter().position(|name| !known.insert(name))
}
