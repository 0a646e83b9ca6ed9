//! Scenes.

use std::ffi::CString;
use std::path::PathBuf;

use numpy::{PyArray2, PyArrayMethods};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use stiction_core::{Evolution, Hand};
use stiction_live::drawing::{HATCH, Point, Solids, Window, placed};
use stiction_live::number::Number;
use stiction_live::session::Session;
use stiction_live::{input, scenes};
use stiction_scene::{InputError, Sample, SceneFile, Source, fitted};

use crate::long::{Signals, zeros};
use crate::{positive, refused};

/// The size of a picture, of which hatches and gaps are parts.
const PIXELS: f64 = 400.0;
/// Numbers for each sample of a hand.
const COLUMNS: usize = 5;

/// A scene: a body, the springs that hold it and what it may touch. It is immutable.
#[pyclass(frozen, module = "stiction._stiction")]
pub(crate) struct Scene {
    pub(crate) source: Source,
    file: SceneFile,
}

impl Scene {
    /// The scene, if the solver takes it in f64, which has the largest range.
    fn new(py: Python<'_>, source: Source) -> PyResult<Self> {
        let file = SceneFile::parse(source.clone(), Number::F64.limit()).map_err(refused)?;
        Session::new(&file, Number::F64, Evolution::Path, u32::MAX).map_err(refused)?;
        warn(py, &file.notes)?;
        Ok(Self { source, file })
    }

    /// The scene file for the solver of a number type.
    pub(crate) fn file_in(&self, number: Number) -> Result<SceneFile, InputError> {
        SceneFile::parse(self.source.clone(), number.limit())
    }
}

#[pymethods]
impl Scene {
    /// A scene file (TOML).
    #[staticmethod]
    fn from_toml(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::new(py, Source::read(&path).map_err(refused)?)
    }

    /// The text of a scene file; `name` is the file's name in messages.
    #[staticmethod]
    #[pyo3(signature = (text, name = "scene.toml"))]
    fn from_text(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        Self::new(py, Source::new(name, text))
    }

    /// A bundled scene by its name.
    #[staticmethod]
    fn bundled(py: Python<'_>, name: PathBuf) -> PyResult<Self> {
        let source = scenes::find(&name);
        let unknown = || refused(format!("{}: {}", name.display(), scenes::unknown(&name)));
        Self::new(py, source.ok_or_else(unknown)?)
    }

    /// The text of its file.
    #[getter]
    fn text(&self) -> &str {
        self.source.text()
    }

    /// The name of its file.
    #[getter]
    fn name(&self) -> String {
        self.source.file().display().to_string()
    }

    /// The body's vertices (m), in the body frame.
    #[getter]
    fn vertices(&self) -> Vec<(f64, f64)> {
        self.file.vertices.iter().copied().map(pair).collect()
    }

    /// Names, unit normals and offsets (m) of the surfaces.
    #[getter]
    fn surfaces(&self) -> Vec<(String, (f64, f64), f64)> {
        let all = self.file.surfaces.iter();
        all.map(|surface| (surface.name.clone(), pair(surface.normal), surface.offset))
            .collect()
    }

    /// Names and corners (m) of the obstacles.
    #[getter]
    fn obstacles(&self) -> Vec<(String, Vec<(f64, f64)>)> {
        let corners = |corners: &[[f64; 2]]| corners.iter().copied().map(pair).collect();
        let all = self.file.obstacles.iter();
        all.map(|obstacle| (obstacle.name.clone(), corners(&obstacle.vertices)))
            .collect()
    }

    /// Coefficients of friction, mu_s and mu_d, of the surfaces and of the obstacles.
    #[getter]
    fn frictions(&self) -> (Vec<Point>, Vec<Point>) {
        let (surfaces, obstacles) = (self.file.surfaces.iter(), self.file.obstacles.iter());
        (
            surfaces
                .map(|of| (of.friction_static, of.friction_dynamic))
                .collect(),
            obstacles
                .map(|of| (of.friction_static, of.friction_dynamic))
                .collect(),
        )
    }

    /// The corners of the body (m) at a pose x, y (m), theta (rad), in the world.
    fn placed(&self, pose: [f64; 3]) -> Vec<Point> {
        placed(&self.file.vertices, pose)
    }

    /// What is solid between these limits of x and y (m): a role and points (m) for each polygon, line or point.
    fn shapes(&self, x: Point, y: Point) -> Vec<(&'static str, Vec<Point>)> {
        let window = Window {
            x: x.0..x.1,
            y: y.0..y.1,
        };
        let solids = Solids {
            surfaces: &self.file.surfaces,
            obstacles: &self.file.obstacles,
            window: &window,
            pixel: window.width().max(window.height()) / PIXELS,
            spacing: HATCH,
        };
        let shapes = solids.shapes().into_iter();
        shapes
            .map(|shape| (shape.role.name(), shape.points))
            .collect()
    }

    /// Stiffness of the springs: k_h (N/m), k_theta (N m/rad).
    #[getter]
    fn stiffness(&self) -> (f64, f64) {
        let file = &self.file;
        (file.stiffness_translation, file.stiffness_rotation)
    }

    /// The samples of its own hand, or of a recorded path: t (s), x, y (m), phi (rad), held (0, 1); at a rate (Hz), or at their own times.
    /// With `fits`, a path is placed over the scene.
    #[pyo3(signature = (path = None, rate = None, fits = false))]
    fn hand<'py>(
        &self,
        py: Python<'py>,
        path: Option<PathBuf>,
        rate: Option<f64>,
        fits: bool,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rate = rate.map(|rate| positive("rate", rate)).transpose()?;
        let given = rate.map(|rate| ("rate", rate));
        let (file, mut scene) = (path, self.file.clone());
        if let Some(file) = input::path_file(&scene, file.as_deref()).filter(|_| fits) {
            let (placement, _) = fitted(&scene, file).map_err(refused)?;
            scene.hand.placement = placement;
        }
        let opened = input::open_path(&scene, file.as_deref(), given);
        let (path, rate) = opened.map_err(refused)?;
        warn(py, &input::remarks(&scene, file.as_deref(), &path))?;
        let row = |sample: Sample| -> [f64; COLUMNS] {
            let Hand {
                position: [x, y],
                angle,
                held,
                ..
            } = sample.hand;
            [sample.t, x, y, angle.radians(), f64::from(u8::from(held))]
        };
        let frames = path.frames(rate);
        let numbers = zeros::<f64>(py, frames.len() * COLUMNS)?;
        let count = frames.len();
        let mut open = numbers.readwrite();
        let rows = open.as_slice_mut()?.as_chunks_mut().0;
        py.detach(|| {
            let mut signals = Signals::new();
            for (place, sample) in rows.iter_mut().zip(frames) {
                signals.check()?;
                *place = row(sample);
            }
            PyResult::Ok(())
        })?;
        drop(open);
        numbers.reshape([count, COLUMNS])
    }

    fn __repr__(&self) -> String {
        let (vertices, surfaces) = (self.file.vertices.len(), self.file.surfaces.len());
        let obstacles = self.file.obstacles.len();
        format!(
            "<stiction.Scene {}: {vertices} vertices, {surfaces} surfaces, {obstacles} obstacles>",
            self.source.file().display()
        )
    }
}

/// Warns of what was skipped, assumed or mended in a file, and of what looks wrong: a `UserWarning` for each.
fn warn(py: Python<'_>, notes: &[String]) -> PyResult<()> {
    let category = py.get_type::<PyUserWarning>();
    for note in notes {
        PyErr::warn(py, &category, &CString::new(note.as_str())?, 1)?;
    }
    Ok(())
}

fn pair([x, y]: [f64; 2]) -> (f64, f64) {
    (x, y)
}
