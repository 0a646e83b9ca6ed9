//! The tables of a run as arrays of numpy, which take the memory of the rows.

use std::sync::{Mutex, PoisonError};

use bytemuck::{Pod, cast_slice, cast_vec};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use stiction_host_sim::record::{ContactRecord, Frame};
use stiction_host_sim::session;

use crate::rows::{ContactRow, EventRow, FrameRow, Rows};

/// Rows in words of 8 bytes.
pub(crate) type Words = PyArray1<u64>;

/// An array of rows.
fn array<T: Pod>(py: Python<'_>, rows: Vec<T>) -> Py<Words> {
    Words::from_vec(py, cast_vec(rows)).unbind()
}

/// Frames, contacts and events.
pub(crate) struct Tables {
    pub(crate) frames: Py<Words>,
    pub(crate) events: Py<Words>,
    contacts: Mutex<Contacts>,
}

/// Contacts as a table, or what it is made of.
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

    /// The words of the contacts, which are made when they are asked for first.
    pub(crate) fn contacts(&self, py: Python<'_>) -> Py<Words> {
        let locked = self.contacts.lock_py_attached(py);
        let mut contacts = locked.unwrap_or_else(PoisonError::into_inner);
        let table = match &*contacts {
            Contacts::Table(table) => return table.clone_ref(py),
            Contacts::Later(later) => array(py, py.detach(|| ContactRows::of(later.as_ref()).rows)),
        };
        *contacts = Contacts::Table(table.clone_ref(py));
        table
    }

    /// For reading, with Python's lock.
    pub(crate) fn read<'py>(&self, py: Python<'py>) -> Read<'py> {
        let contacts = self.contacts(py);
        let [frames, contacts, events] =
            [&self.frames, &contacts, &self.events].map(|words| words.bind(py).readonly());
        Read {
            frames,
            contacts,
            events,
        }
    }
}

/// Tables that nobody writes.
pub(crate) struct Read<'py> {
    frames: PyReadonlyArray1<'py, u64>,
    contacts: PyReadonlyArray1<'py, u64>,
    events: PyReadonlyArray1<'py, u64>,
}

impl Read<'_> {
    /// Their rows.
    ///
    /// # Errors
    /// An array is not contiguous.
    pub(crate) fn rows(&self) -> PyResult<Rows<'_>> {
        Ok(Rows {
            frames: cast_slice(self.frames.as_slice()?),
            contacts: cast_slice(self.contacts.as_slice()?),
            events: cast_slice(self.events.as_slice()?),
        })
    }
}

/// The contacts of frames, one after the other.
#[derive(Default)]
struct ContactRows {
    rows: Vec<ContactRow>,
    frames: u32,
}

impl ContactRows {
    fn of(contacts: &dyn session::Contacts) -> Self {
        let mut all = Self::default();
        contacts.each(&mut |contacts| all.add(contacts));
        all
    }

    /// Those of the next frame.
    fn add(&mut self, contacts: &[ContactRecord]) {
        let row = |contact| ContactRow::new(self.frames, contact);
        self.rows.extend(contacts.iter().map(row));
        self.frames += 1;
    }
}

/// Frames and their events, one after the other.
#[derive(Default)]
pub(crate) struct FrameRows {
    frames: Vec<FrameRow>,
    events: Vec<EventRow>,
}

impl FrameRows {
    /// With room for so many frames.
    pub(crate) fn with_capacity(frames: usize) -> Self {
        Self {
            frames: Vec::with_capacity(frames),
            events: Vec::new(),
        }
    }

    /// The next frame.
    pub(crate) fn add(&mut self, frame: &Frame) {
        let index = self.frames.len() as u32;
        let event = |&event| EventRow::new(index, event);
        self.events.extend(frame.events.iter().map(event));
        self.frames.push(FrameRow::new(frame));
    }

    /// As tables, with contacts that are made later.
    pub(crate) fn tables(self, py: Python<'_>, contacts: Box<dyn session::Contacts>) -> Tables {
        let (frames, events) = (array(py, self.frames), array(py, self.events));
        Tables::new(frames, Contacts::Later(contacts), events)
    }
}

/// The tables of one frame.
pub(crate) fn of_frame(py: Python<'_>, frame: &Frame) -> Tables {
    let (mut rows, mut contacts) = (FrameRows::default(), ContactRows::default());
    rows.add(frame);
    contacts.add(&frame.contacts);
    let (frames, events) = (array(py, rows.frames), array(py, rows.events));
    Tables::new(frames, Contacts::Table(array(py, contacts.rows)), events)
}
