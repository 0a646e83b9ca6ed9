//! A scene as written in a file: from TOML to checked numbers, and on to a [`Scene`] of the solver. Every message names the
//! key, the line, the value and what is allowed.

use std::path::Path;

use stiction_core::{
    Description, ObstacleDescription, Parameter, Real, Scene, SiFloat, SurfaceDescription,
};

use crate::check::Check;
use crate::clip::{Indices, clipped};
use crate::document::{Body, Document};
use crate::friction::Fallback;
use crate::name::Names;
use crate::obstacle::{ObstacleInfo, obstacles};
use crate::outline::{repaired, size};
use crate::scene_file::HostScene;
use crate::source::{InputError, Source};
use crate::surface::{SurfaceInfo, surfaces};

/// At most this many vertices, wherever the scene runs.
pub const VERTICES: usize = 64;
/// At most this many surfaces.
pub const SURFACES: usize = 16;
/// At most this many obstacles.
pub const OBSTACLES: usize = 32;
/// At most this many corners of all obstacles together.
pub const CORNERS: usize = 128;
/// Nobody holds a body that is larger (m): numbers in millimetres make one.
const LARGEST_HELD: f64 = 4.0;

/// A scene file whose numbers are finite, in range and complete; its hand is ignored. [`WrittenScene::scene_in`] checks
/// whether they make a scene. SI units; see [`Description`] for the meaning of each.
#[derive(Clone, Debug)]
pub struct WrittenScene {
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
    /// How far outside the polygon a hand may be and still grasp (m).
    pub reach: f64,
    /// k_h (N/m)
    pub stiffness_translation: f64,
    /// k_theta (N·m/rad)
    pub stiffness_rotation: f64,
    /// The surfaces, their normals with length 1.
    pub surfaces: Vec<SurfaceInfo>,
    /// The obstacles.
    pub obstacles: Vec<ObstacleInfo>,
    /// What was mended on reading because the file asked for it, and what looks wrong: sentences for its user.
    pub notes: Vec<String>,
    pub(crate) source: Source,
    pub(crate) document: Document,
}

impl WrittenScene {
    /// Reads a scene file for a number type whose largest number is `limit`.
    ///
    /// # Errors
    /// The file cannot be read, is not TOML, or a key is unknown, missing, of the wrong type or out of range.
    pub fn read(file: &Path, limit: f64) -> Result<Self, InputError> {
        Self::parse(Source::read(file)?, limit)
    }

    /// Reads a scene from text.
    ///
    /// # Errors
    /// As for [`WrittenScene::read`].
    pub fn parse(source: Source, limit: f64) -> Result<Self, InputError> {
        let document: Document = source.toml()?;
        document.check_counts(&source)?;
        let check = Check::new(&source, limit);
        let (body, grasp, spring) = (&document.body, &document.grasp, &document.spring);
        let point = |given| check.numbers("grasp.point", given, "x and y");
        let title = source.file().file_stem().unwrap_or_default();
        let (fallback, mut names) = (Fallback::new(check, &document)?, Names::default());
        let (vertices, mut notes) = mended(body, vertices(check, body)?);
        notes.extend(doubted(&vertices));
        Ok(Self {
            title: title.to_string_lossy().into_owned(),
            vertices,
            notes,
            start: check.numbers("body.start", &body.start, "x, y and theta")?,
            weight: check.number_or("body.weight", body.weight.as_ref(), 0.0)?,
            holding_point: grasp.point.as_ref().map(point).transpose()?,
            reach: check.number_or("grasp.reach", grasp.reach.as_ref(), 0.0)?,
            stiffness_translation: check.number("spring.translation", &spring.translation)?,
            stiffness_rotation: check.number("spring.rotation", &spring.rotation)?,
            surfaces: surfaces(check, &document, fallback, &mut names)?,
            obstacles: obstacles(check, &document, fallback, &mut names)?,
            document,
            source,
        })
    }

    /// Checks that the numbers make a scene, wherever the body starts.
    ///
    /// # Errors
    /// The message names the key of the first number that is out of range or does not fit the others.
    pub fn check_numbers(&self) -> Result<(), InputError> {
        let (checked, indices) = self.described::<f64, _>(|description| {
            // The solver checks where the body starts last: first surfaces, then obstacles.
            let surfaces = Description {
                obstacles: &[],
                ..*description
            };
            let obstacles = Description {
                surfaces: &[],
                ..*description
            };
            [surfaces, obstacles].map(|given| HostScene::<f64>::new(&given).map(drop))
        });
        for checked in checked {
            match checked {
                Err(error) if !is_of_start(error.parameter) => {
                    return Err(self.explain(&error, indices.as_ref()));
                }
                Ok(()) | Err(_) => {}
            }
        }
        Ok(())
    }

    /// The scene for a solver.
    ///
    /// # Errors
    /// As for [`WrittenScene::scene_in`].
    pub fn scene<R: Real<Si: SiFloat>>(&self) -> Result<HostScene<R>, InputError> {
        self.scene_in().map(|(scene, _)| scene)
    }

    /// The scene for a solver, and the meaning of its obstacle indices if they differ from those of the file.
    ///
    /// # Errors
    /// The numbers do not make a scene, or it does not fit: the message names the key that the solver's
    /// [`SceneError`](stiction_core::SceneError) refers to.
    pub fn scene_in<R: Real<Si: SiFloat>>(
        &self,
    ) -> Result<(HostScene<R>, Option<Indices>), InputError> {
        let (scene, indices) = self.described::<R, _>(|description| Scene::new(description));
        match scene {
            Ok(scene) => Ok((scene, indices)),
            Err(error) => Err(self.explain(&error, indices.as_ref())),
        }
    }

    /// The scene in the float of a solver, as it is passed to a solver or sent to a board, its obstacles clipped to what the number type can
    /// represent; and the meaning of the solver's obstacle indices if they differ from those of the file.
    pub fn described<R: Real<Si: SiFloat>, T>(
        &self,
        take: impl FnOnce(&Description<'_, R::Si>) -> T,
    ) -> (T, Option<Indices>) {
        let narrow = R::Si::narrow;
        let points = |list: &[[f64; 2]]| -> Vec<[R::Si; 2]> {
            list.iter().map(|point| point.map(narrow)).collect()
        };
        let surface = |s: &SurfaceInfo| SurfaceDescription {
            normal: s.normal.map(narrow),
            offset: narrow(s.offset),
            friction_static: narrow(s.friction_static),
            friction_dynamic: narrow(s.friction_dynamic),
            memory: s.memory.map(narrow),
        };
        let surfaces: Vec<_> = self.surfaces.iter().map(surface).collect();
        let (clipped, indices) = clipped::<R>(self);
        let corners: Vec<_> = clipped.iter().map(|o| points(&o.vertices)).collect();
        let obstacle = |(o, vertices): (&ObstacleInfo, _)| ObstacleDescription {
            vertices,
            friction_static: narrow(o.friction_static),
            friction_dynamic: narrow(o.friction_dynamic),
            memory: o.memory.map(narrow),
        };
        let corners = corners.iter().map(Vec::as_slice);
        let obstacles: Vec<_> = clipped.iter().zip(corners).map(obstacle).collect();
        let taken = take(&Description {
            vertices: &points(&self.vertices),
            start: self.start.map(narrow),
            weight: narrow(self.weight),
            holding_point: self.holding_point.map(|point| point.map(narrow)),
            reach: narrow(self.reach),
            stiffness_translation: narrow(self.stiffness_translation),
            stiffness_rotation: narrow(self.stiffness_rotation),
            surfaces: &surfaces,
            obstacles: &obstacles,
        });
        (taken, indices)
    }

    /// Puts the body's start, the holding point and the reach where another scene has them.
    pub fn begin_as(&mut self, other: &Self) {
        (self.start, self.holding_point) = (other.start, other.holding_point);
        self.reach = other.reach;
    }

    /// The file.
    pub const fn source(&self) -> &Source {
        &self.source
    }
}

/// Whether it says that the body starts inside something.
const fn is_of_start(parameter: Parameter) -> bool {
    matches!(
        parameter,
        Parameter::Penetration { .. } | Parameter::Overlap(_)
    )
}

/// The vertices, mended if the file asks for it, and what was changed.
fn mended(body: &Body, vertices: Vec<[f64; 2]>) -> (Vec<[f64; 2]>, Vec<String>) {
    if body.repair != Some(true) {
        return (vertices, Vec::new());
    }
    let (vertices, changes) = repaired(&vertices);
    let changes = changes
        .iter()
        .map(|change| format!("`body.vertices`: {change}"));
    (vertices, changes.collect())
}

fn doubted(vertices: &[[f64; 2]]) -> Option<String> {
    let size = size(vertices);
    (size > LARGEST_HELD).then(|| format!("the body is {size:.1} m large: lengths are in metres"))
}

fn vertices(check: Check<'_>, body: &Body) -> Result<Vec<[f64; 2]>, InputError> {
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
        (Some(_), Some(rectangle)) => Err(check.source().error_at(
            rectangle.span().start,
            "`body.rectangle` is given in addition to `body.vertices`, allowed: one of the two",
        )),
        (None, None) => Err(check
            .source()
            .error("[body] has neither `vertices` nor `rectangle`, allowed: one of the two")),
    }
}
