//! Runs: the answers of a solver, as tables; judged, written as traces, drawn.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use stiction_core::Evolution;
use stiction_host_sim::check::{Remarks, judge, verdict};
use stiction_host_sim::plot;
use stiction_host_sim::trace::{Format, TraceWriter};
use stiction_judge::{Survey, Trace};
use stiction_live::number::Number;
use stiction_live::record;
use stiction_scene::{SceneFile, Source};

use crate::long::{Signals, aside, no_memory};
use crate::refused;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::tables::{Contacts, Tables, Words};

/// The common properties of the runs of a scene in a number type and an evolution.
pub(crate) struct Head {
    /// Without frames.
    run: record::Run,
    text: String,
}

impl Head {
    pub(crate) fn new(scene: &SceneFile, number: Number, evolution: Evolution) -> Arc<Self> {
        Arc::new(Self {
            run: record::Run::of(scene, number, evolution),
            text: scene.source().text().to_owned(),
        })
    }
}

/// The answers of a solver: frames, contacts and events.
#[pyclass(frozen, module = "stiction._stiction")]
pub(crate) struct Run {
    head: Arc<Head>,
    tables: Tables,
}

impl Run {
    pub(crate) fn new(head: Arc<Head>, tables: Tables) -> Self {
        Self { head, tables }
    }
}

fn write(head: &Head, rows: Rows<'_>, file: &Path, format: Format) -> PyResult<()> {
    let named = |error: io::Error| PyOSError::new_err(format!("{}: {error}", file.display()));
    let mut writer = TraceWriter::create(file, format, &head.run).map_err(named)?;
    let mut signals = Signals::new();
    for frame in rows.iter() {
        signals.check()?;
        writer.write(&frame).map_err(named)?;
    }
    writer.finish().map_err(named)
}

/// The run with its frames.
fn recorded(head: &Head, rows: Rows<'_>) -> PyResult<record::Run> {
    // The frames, what they hold, and as much again for the lists that a drawing makes of them: their many allocations cannot fail
    // one by one.
    let bytes = 2 * (size_of::<record::Frame>() * rows.frames.len() + rows.bytes());
    let mut room = Vec::<u8>::new();
    room.try_reserve_exact(bytes).map_err(no_memory)?;
    drop(room);
    let (mut run, mut signals) = (head.run.clone(), Signals::new());
    for frame in rows.iter() {
        signals.check()?;
        run.frames.push(frame);
    }
    Ok(run)
}

#[pymethods]
impl Run {
    /// A run from the words of three tables.
    #[staticmethod]
    fn of(
        py: Python<'_>,
        scene: Py<Scene>,
        kind: (String, String),
        frames: Py<Words>,
        contacts: Py<Words>,
        events: Py<Words>,
    ) -> PyResult<Self> {
        let (number, evolution) = crate::kind(&kind.0, &kind.1)?;
        let file = scene.get().file_in(number).map_err(refused)?;
        let tables = Tables::new(frames, Contacts::Table(contacts), events);
        tables.read(py)?.rows()?.check().map_err(refused)?;
        Ok(Self::new(Head::new(&file, number, evolution), tables))
    }

    /// The words of the frames.
    #[getter]
    fn frames(&self, py: Python<'_>) -> Py<Words> {
        self.tables.frames.clone_ref(py)
    }

    /// The words of the contacts, which are computed on the first access.
    #[getter]
    fn contacts(&self, py: Python<'_>) -> PyResult<Py<Words>> {
        self.tables.contacts(py)
    }

    /// The words of the events.
    #[getter]
    fn events(&self, py: Python<'_>) -> Py<Words> {
        self.tables.events.clone_ref(py)
    }

    /// The number type.
    #[getter]
    fn number(&self) -> &'static str {
        self.head.run.number.name()
    }

    /// The evolution.
    #[getter]
    fn evolution(&self) -> &'static str {
        self.head.run.evolution.name()
    }

    /// Writes a trace, `.jsonl` or `.csv`, as `stiction run --out` does.
    fn write_trace(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let Some(format) = Format::of(&path) else {
            let name = path.display();
            return Err(refused(format!(
                "{name}: allowed: a file name that ends in .jsonl or .csv"
            )));
        };
        let (head, read) = (&self.head, self.tables.read(py)?);
        let rows = read.rows()?;
        py.detach(|| write(head, rows, &path, format))
    }

    /// Judges every frame by the laws alone: returns how many are unlawful, and the report.
    fn judge(&self, py: Python<'_>) -> PyResult<(u64, String)> {
        let (head, read) = (&self.head, self.tables.read(py)?);
        let rows = read.rows()?;
        py.detach(|| judged(head, rows))
    }

    /// The pictures of `stiction run --plot`: names and SVG.
    fn figures(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        let (head, read) = (&self.head, self.tables.read(py)?);
        let rows = read.rows()?;
        py.detach(|| {
            let run = recorded(head, rows)?;
            aside(move || plot::svgs(&run))?.map_err(refused)
        })
    }
}

/// The judge reads a trace.
fn judged(head: &Head, rows: Rows<'_>) -> PyResult<(u64, String)> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("trace.jsonl");
    write(head, rows, &file, Format::JsonLines)?;
    let source = Source::new(&file, head.text.as_str());
    let scene = stiction_judge::Scene::parse(source).map_err(refused)?;
    let frames = Trace::open(&file, &scene).map_err(refused)?;
    let mut judge = judge(scene, head.run.number, head.run.evolution);
    let mut survey = Survey::new(WORST);
    let (mut remarks, mut signals) = (Remarks::default(), Signals::new());
    for frame in frames {
        signals.check()?;
        let (line, frame) = frame.map_err(refused)?;
        let t = frame.t;
        remarks.add(&frame);
        survey.add(line, t, &judge.next(frame));
    }
    Ok((survey.unlawful, verdict(&survey, &remarks)))
}

/// The number of worst frames that are listed, as by `stiction check`.
const WORST: usize = 10;
