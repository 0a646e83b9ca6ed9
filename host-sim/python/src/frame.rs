//! The answer to one sample of the hand. Its values become Python's when they are asked for, so that a step is fast.

use bytemuck::cast_slice;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::PyTypeInfo;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyIterator, PyTuple};
use stiction_live::record;

use crate::refused;
use crate::rows::ContactRow;
use crate::tables::{Contacts, Tables, Words};

/// The answer to a sample of the hand: eight values with names, which can also be taken by number and unpacked, in the order `pose`,
/// `wrench`, `state`, `status`, `events`, `slips`, `contacts`, `behind`. It is immutable.
#[pyclass(frozen, module = "stiction")]
pub(crate) struct Frame(pub(crate) record::Frame);

/// Frames, contacts and events.
type Three = (Py<Words>, Py<Words>, Py<Words>);

const FIELDS: [&str; 8] = [
    "pose", "wrench", "state", "status", "events", "slips", "contacts", "behind",
];

#[pymethods]
impl Frame {
    /// The frame in the first rows of three tables.
    #[new]
    fn new(
        py: Python<'_>,
        frames: Py<Words>,
        contacts: Py<Words>,
        events: Py<Words>,
    ) -> PyResult<Self> {
        let read = Tables::new(frames, Contacts::Table(contacts), events).read(py)?;
        let rows = read.rows()?;
        rows.check().map_err(refused)?;
        let frame = rows.iter().next().map(Self);
        frame.ok_or_else(|| refused("`frames` has no row, allowed: one"))
    }

    /// x, y (m), theta (rad) of the body, world frame.
    #[getter]
    fn pose<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        read_only(py, self.0.pose)
    }

    /// Force (N) and moment about the holding point (N m) of the hand on the body.
    #[getter]
    fn wrench<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        read_only(py, self.0.wrench)
    }

    /// One of `STATES`.
    #[getter]
    fn state(&self) -> &'static str {
        self.0.state.name()
    }

    /// What limited the answer: "ok", or another of `STATUSES`.
    #[getter]
    fn status(&self) -> &'static str {
        self.0.status.name()
    }

    /// The events of the frame, in order, from `EVENTS`.
    #[getter]
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.0.events.iter().map(|event| event.name()))
    }

    /// Slips that ended in this frame.
    #[getter]
    fn slips(&self) -> u32 {
        self.0.slips
    }

    /// A structured array of type `CONTACT`.
    #[getter]
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        static TABLE: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        let table = TABLE.import(py, "stiction._tables", "contacts")?;
        let row = |contact| ContactRow::new(0, contact);
        let rows: Vec<_> = self.0.contacts.iter().map(row).collect();
        table.call1((rows.len(), PyBytes::new(py, cast_slice(&rows))))
    }

    /// The fraction of the hand's displacement that is left to follow, 0 to 1; nan without a budget.
    #[getter]
    fn behind(&self) -> f64 {
        self.0.behind.unwrap_or(f64::NAN)
    }

    fn __len__(&self) -> usize {
        FIELDS.len()
    }

    fn __iter__<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyIterator>> {
        values(this)?.try_iter()
    }

    fn __getitem__<'py>(
        this: &Bound<'py, Self>,
        index: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        values(this)?.as_any().get_item(index)
    }

    fn __reduce__<'py>(this: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Three)> {
        let py = this.py();
        let tables = Tables::of_frame(py, &this.get().0);
        let contacts = tables.contacts(py)?;
        let class = Self::type_object(py).into_any();
        Ok((class, (tables.frames, contacts, tables.events)))
    }

    fn __repr__(&self) -> String {
        let [x, y, theta] = self.0.pose;
        format!(
            "<stiction.Frame {}, {}: x {x} m, y {y} m, theta {theta} rad, {} contacts>",
            self.state(),
            self.status(),
            self.0.contacts.len()
        )
    }
}

/// The values in order.
fn values<'py>(frame: &Bound<'py, Frame>) -> PyResult<Bound<'py, PyTuple>> {
    let values: PyResult<Vec<_>> = FIELDS.iter().map(|name| frame.getattr(*name)).collect();
    PyTuple::new(frame.py(), values?)
}

fn read_only(py: Python<'_>, values: [f64; 3]) -> Bound<'_, PyArray1<f64>> {
    let array = PyArray1::from_slice(py, &values);
    array.readwrite().make_nonwriteable();
    array
}
