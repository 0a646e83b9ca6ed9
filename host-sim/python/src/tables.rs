//! The tables of a run as numpy arrays. Rows are written into numpy's memory, or numpy takes over theirs.

use std::collections::TryReserveError;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

use bytemuck::{Pod, cast_slice, cast_slice_mut, cast_vec};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use stiction_live::record::{ContactRecord, Frame};
use stiction_live::session;

use crate::long::{Signals, no_memory, zeros};
use crate::rows::{ContactRow, EventRow, FrameRow, Rows};

/// Rows in words of 8 bytes.
pub(crate) type Words = PyArray1<u64>;

/// An array of rows.
fn array<T: Pod>(py: Python<'_>, rows: Vec<T>) -> Py<Words> {
    Words::from_vec(py, cast_vec(rows)).unbind()
}

pub(crate) struct Tables {
    pub(crate) frames: Py<Words>,
    pub(crate) events: Py<Words>,
    contacts: Mutex<Contacts>,
}

/// Contacts as a table, or the data from which it is computed.
pub(crate) enum Contacts {
    Table(Py<Words>),
    Later(Box<dyn session::Contacts>),
}

impl Tables {
    pub(crate) fn new(frames: Py<Words>, contacts: Contacts, events: Py<Words>) -> Self {
        Self {
            frames,
            events,
            contacts: Mutex::new(contacts),
        }
    }

    /// The words of the contacts, which are computed on the first access.
    pub(crate) fn contacts(&self, py: Python<'_>) -> PyResult<Py<Words>> {
        let locked = self.contacts.lock_py_attached(py);
        let mut contacts = locked.unwrap_or_else(PoisonError::into_inner);
        let table = match &*contacts {
            Contacts::Table(table) => return Ok(table.clone_ref(py)),
            Contacts::Later(later) => array(py, py.detach(|| ContactRows::of(later.as_ref()))?),
        };
        *contacts = Contacts::Table(table.clone_ref(py));
        Ok(table)
    }

    /// The tables for reading, with Python's lock.
    pub(crate) fn read<'py>(&self, py: Python<'py>) -> PyResult<Read<'py>> {
        let contacts = self.contacts(py)?;
        let [frames, contacts, events] =
            [&self.frames, &contacts, &self.events].map(|words| words.bind(py).readonly());
        Ok(Read {
            frames,
            contacts,
            events,
        })
    }
}

/// Tables that nobody writes to.
pub(crate) struct Read<'py> {
    frames: PyReadonlyArray1<'py, u64>,
    contacts: PyReadonlyArray1<'py, u64>,
    events: PyReadonlyArray1<'py, u64>,
}

impl Read<'_> {
    /// Their rows.
    pub(crate) fn rows(&self) -> PyResult<Rows<'_>> {
        Ok(Rows {
            frames: cast_slice(self.frames.as_slice()?),
            contacts: cast_slice(self.contacts.as_slice()?),
            events: cast_slice(self.events.as_slice()?),
        })
    }
}

#[derive(Default)]
struct ContactRows {
    rows: Vec<ContactRow>,
    frames: u32,
}

impl ContactRows {
    fn of(contacts: &dyn session::Contacts) -> PyResult<Vec<ContactRow>> {
        let (mut all, mut signals, mut outcome) = (Self::default(), Signals::new(), Ok(()));
        contacts.each(&mut |contacts| {
            outcome = signals.check().and_then(|()| all.add(contacts));
            flow(&outcome)
        });
        outcome.map(|()| all.rows)
    }

    fn add(&mut self, contacts: &[ContactRecord]) -> PyResult<()> {
        self.rows.try_reserve(contacts.len()).map_err(no_memory)?;
        let row = |contact| ContactRow::new(self.frames, contact);
        self.rows.extend(contacts.iter().map(row));
        self.frames += 1;
        Ok(())
    }
}

/// An error breaks off.
fn flow(outcome: &PyResult<()>) -> ControlFlow<()> {
    match outcome {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    }
}

/// Consecutive frames and their events.
pub(crate) struct FrameRows<'a> {
    frames: &'a mut [FrameRow],
    filled: u32,
    events: Vec<EventRow>,
    signals: Signals,
    outcome: PyResult<()>,
}

impl FrameRows<'_> {
    pub(crate) fn add(&mut self, frame: &Frame) -> ControlFlow<()> {
        self.outcome = self.signals.check().and_then(|()| self.add_row(frame));
        flow(&self.outcome)
    }

    fn add_row(&mut self, frame: &Frame) -> PyResult<()> {
        let count = frame.events.len();
        self.events.try_reserve(count).map_err(no_memory)?;
        let event = |&event| EventRow::new(self.filled, event);
        self.events.extend(frame.events.iter().map(event));
        if let Some(row) = self.frames.get_mut(self.filled as usize) {
            *row = FrameRow::new(frame);
        }
        self.filled += 1;
        Ok(())
    }
}

impl Tables {
    /// Tables of a number of frames, which are filled without Python's lock.
    pub(crate) fn filled(
        py: Python<'_>,
        frames: usize,
        fill: impl FnOnce(&mut FrameRows<'_>) -> Result<Box<dyn session::Contacts>, TryReserveError>
        + Send,
    ) -> PyResult<Self> {
        let words = zeros::<u64>(py, frames * size_of::<FrameRow>() / size_of::<u64>())?;
        let mut open = words.readwrite();
        let mut rows = FrameRows {
            frames: cast_slice_mut(open.as_slice_mut()?),
            filled: 0,
            events: Vec::new(),
            signals: Signals::new(),
            outcome: Ok(()),
        };
        let contacts = py.detach(|| fill(&mut rows)).map_err(no_memory)?;
        rows.outcome?;
        let events = array(py, rows.events);
        drop(open);
        Ok(Self::new(words.unbind(), Contacts::Later(contacts), events))
    }

    pub(crate) fn of_frame(py: Python<'_>, frame: &Frame) -> Self {
        let contact = |contact| ContactRow::new(0, contact);
        let event = |&event| EventRow::new(0, event);
        Self::new(
            array(py, vec![FrameRow::new(frame)]),
            Contacts::Table(array(py, frame.contacts.iter().map(contact).collect())),
            array(py, frame.events.iter().map(event).collect()),
        )
    }
}
