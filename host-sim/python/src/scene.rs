//! Scenes.

use std::path::PathBuf;

use pyo3::prelude::*;
use stiction_host_sim::number::Number;
use stiction_host_sim::scenes;
use stiction_scene::{InputError, SceneFile, Source};

use crate::refused;

/// A scene: a body, what holds it and what it may touch. It does not change.
#[pyclass(frozen, module = "stiction._stiction")]
pub(crate) struct Scene {
    pub(crate) source: Source,
    file: SceneFile,
}

impl Scene {
    fn new(source: Source) -> PyResult<Self> {
        let file = SceneFile::parse(source.clone(), Number::F64.limit()).map_err(refused)?;
        Ok(Self { source, file })
    }

    /// For the solver of a number type.
    pub(crate) fn file_in(&self, number: Number) -> Result<SceneFile, InputError> {
        SceneFile::parse(self.source.clone(), number.limit())
    }
}

#[pymethods]
impl Scene {
    /// A scene file (TOML).
    #[staticmethod]
    fn from_toml(path: PathBuf) -> PyResult<Self> {
        Self::new(Source::read(&path).map_err(refused)?)
    }

    /// The text of a scene file; `name` is that of the file in messages.
    #[staticmethod]
    #[pyo3(signature = (text, name = "scene.toml"))]
    fn from_text(text: &str, name: &str) -> PyResult<Self> {
        Self::new(Source::new(name, text))
    }

    /// A bundled scene by its name.
    #[staticmethod]
    fn bundled(name: PathBuf) -> PyResult<Self> {
        let source = scenes::find(&name);
        let unknown = || refused(format!("{}: {}", name.display(), scenes::unknown()));
        Self::new(source.ok_or_else(unknown)?)
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

    /// The body's vertices (m), in its own frame.
    #[getter]
    fn vertices(&self) -> Vec<[f64; 2]> {
        self.file.vertices.clone()
    }

    /// Names, unit normals and offsets (m) of the surfaces.
    #[getter]
    fn surfaces(&self) -> Vec<(String, [f64; 2], f64)> {
        let all = self.file.surfaces.iter();
        all.map(|surface| (surface.name.clone(), surface.normal, surface.offset)).collect()
    }

    /// Names and corners (m) of the obstacles.
    #[getter]
    fn obstacles(&self) -> Vec<(String, Vec<[f64; 2]>)> {
        let all = self.file.obstacles.iter();
        all.map(|obstacle| (obstacle.name.clone(), obstacle.vertices.clone())).collect()
    }

    /// Stiffness of the springs: k_h (N/m), k_theta (N m/rad).
    #[getter]
    fn stiffness(&self) -> [f64; 2] {
        [self.file.stiffness_translation, self.file.stiffness_rotation]
    }

    /// The samples of its own hand: t (s), x, y (m), phi (rad), depth (m), held; at a rate (Hz), or at its own. For `Solver.run`.
    #[pyo3(signature = (rate = None))]
    fn hand(&self, rate: Option<f64>) -> PyResult<Vec<[f64; 6]>> {
        let path = stiction_host_sim::input::open_path(&self.file, None, rate.map(|rate| ("rate", rate)));
        let (path, rate) = path.map_err(refused)?;
        let row = |sample: stiction_scene::Sample| {
            let ([x, y], held) = (sample.hand.position, sample.hand.held);
            let phi = sample.hand.angle.radians();
            [sample.t, x, y, phi, sample.hand.depth, f64::from(u8::from(held))]
        };
        Ok(path.frames(rate).map(row).collect())
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
