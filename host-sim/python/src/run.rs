//! Runs: what a solver gave, as tables; judged, written as traces, drawn.

use std::path::PathBuf;

use bytemuck::{Pod, cast_slice, pod_collect_to_vec};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use stiction_core::Evolution;
use stiction_host_sim::check::{Notes, judge, verdict};
use stiction_host_sim::number::Number;
use stiction_host_sim::options::{parse_evolution, parse_number};
use stiction_host_sim::trace::{Format, TraceWriter};
use stiction_host_sim::{plot, record};
use stiction_judge::{Survey, Trace};
use stiction_scene::SceneFile;

use crate::refused;
use crate::rows::{ContactRow, EventRow, FrameRow, Rows};
use crate::scene::Scene;

/// What a solver gave: frames, contacts and events.
#[pyclass(frozen, subclass, module = "stiction")]
pub(crate) struct Run {
    /// Scene, number type and evolution; without frames.
    head: record::Run,
    text: String,
    rows: Rows,
}

impl Run {
    pub(crate) fn new(head: record::Run, rows: Rows, scene: &SceneFile) -> Self {
        Self {
            head,
            text: scene.source().text().to_owned(),
            rows,
        }
    }

    fn trace(&self, file: &std::path::Path, format: Format) -> std::io::Result<()> {
        let mut writer = TraceWriter::create(file, format, &self.head)?;
        for frame in self.rows.iter() {
            writer.write(&frame)?;
        }
        writer.finish()
    }
}

fn bytes<'py, T: Pod>(py: Python<'py>, rows: &[T]) -> Bound<'py, PyArray1<u8>> {
    PyArray1::from_slice(py, cast_slice(rows))
}

/// Rows of a table, from the bytes of its array.
fn rows<T: Pod>(name: &str, bytes: &PyReadonlyArray1<'_, u8>) -> PyResult<Vec<T>> {
    let bytes = bytes.as_slice()?;
    let size = size_of::<T>();
    if bytes.len() % size != 0 {
        let length = bytes.len();
        return Err(refused(format!("`{name}` has {length} bytes, allowed: rows of {size}")));
    }
    Ok(pod_collect_to_vec(bytes))
}

#[pymethods]
impl Run {
    /// From tables: the bytes of their arrays.
    #[staticmethod]
    fn _of(
        py: Python<'_>,
        scene: Py<Scene>,
        (number, evolution): (&str, &str),
        frames: PyReadonlyArray1<'_, u8>,
        contacts: PyReadonlyArray1<'_, u8>,
        events: PyReadonlyArray1<'_, u8>,
    ) -> PyResult<Self> {
        let number: Number = parse_number(number).map_err(refused)?;
        let evolution: Evolution = parse_evolution(evolution).map_err(refused)?;
        let file = scene.borrow(py).file_in(number).map_err(refused)?;
        let frames: Vec<FrameRow> = rows("frames", &frames)?;
        let contacts: Vec<ContactRow> = rows("contacts", &contacts)?;
        let events: Vec<EventRow> = rows("events", &events)?;
        let rows = Rows::of(frames, contacts, events).map_err(refused)?;
        Ok(Self::new(record::Run::of(&file, number, evolution), rows, &file))
    }

    #[getter]
    fn _frames<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        bytes(py, &self.rows.frames)
    }

    #[getter]
    fn _contacts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        bytes(py, &self.rows.contacts)
    }

    #[getter]
    fn _events<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        bytes(py, &self.rows.events)
    }

    #[getter]
    fn _text(&self) -> &str {
        &self.text
    }

    #[getter]
    fn _title(&self) -> &str {
        &self.head.title
    }

    #[getter]
    fn number(&self) -> &'static str {
        self.head.number.name()
    }

    #[getter]
    fn evolution(&self) -> &'static str {
        self.head.evolution.name()
    }

    fn __len__(&self) -> usize {
        self.rows.frames.len()
    }

    /// Writes a trace, `.jsonl` or `.csv`, as `stiction run --out` does.
    fn write_trace(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let Some(format) = Format::of(&path) else {
            let name = path.display();
            return Err(refused(format!("{name}: allowed: a file name that ends in .jsonl or .csv")));
        };
        py.detach(|| self.trace(&path, format))
            .map_err(|error| PyOSError::new_err(format!("{}: {error}", path.display())))
    }

    /// Judges every frame by the laws alone: how many are unlawful, and the report.
    fn _judge(&self, py: Python<'_>) -> PyResult<(u64, String)> {
        py.detach(|| {
            let failed = |error: std::io::Error| error.to_string();
            let folder = tempfile::tempdir().map_err(failed)?;
            let file = folder.path().join("trace.jsonl");
            self.trace(&file, Format::JsonLines).map_err(failed)?;
            let scene = stiction_judge::Scene::parse(&file, &self.text);
            let scene = scene.map_err(|error| error.to_string())?;
            let frames = Trace::open(&file, &scene).map_err(|error| error.to_string())?;
            let mut judge = judge(scene, self.head.number, self.head.evolution);
            let mut survey = Survey::new(10);
            let mut notes = Notes::default();
            for frame in frames {
                let (line, frame) = frame.map_err(|error| error.to_string())?;
                let t = frame.t;
                notes.add(&frame);
                survey.add(line, t, &judge.next(frame));
            }
            Ok((survey.unlawful, verdict(&survey, &notes)))
        })
        .map_err(|problem: String| refused(problem))
    }

    /// The pictures of `stiction run --plot`: names and SVG.
    fn figures(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        py.detach(|| {
            let mut run = self.head.clone();
            run.frames = self.rows.iter().collect();
            plot::svgs(&run).map_err(|error| error.to_string())
        })
        .map_err(refused)
    }
}
