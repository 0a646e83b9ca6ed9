//! The tables of a run in arrays of numpy, which own them: rows are written where numpy has them, and read there.

use bytemuck::{Pod, cast_slice, cast_slice_mut};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadwriteArray1};
use pyo3::prelude::*;
use pyo3::types::PySlice;
use stiction_host_sim::record::Frame;

use crate::rows::{ContactRow, EventRow, FrameRow, Rows};

/// Rows in words of 8 bytes.
pub(crate) type Words = PyArray1<u64>;

/// Frames, contacts and events.
pub(crate) struct Tables {
    pub(crate) frames: Py<Words>,
    pub(crate) contacts: Py<Words>,
    pub(crate) events: Py<Words>,
}

impl Tables {
    /// For reading, with Python's lock.
    pub(crate) fn read<'py>(&self, py: Python<'py>) -> Read<'py> {
        let [frames, contacts, events] =
            [&self.frames, &self.contacts, &self.events].map(|words| words.bind(py).readonly());
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

/// An array with room for so many rows.
fn room<T: Pod>(py: Python<'_>, rows: usize) -> Bound<'_, Words> {
    PyArray1::zeros(py, rows * size_of::<T>() / size_of::<u64>(), false)
}

/// An array of rows.
fn array<'py, T: Pod>(py: Python<'py>, rows: &[T]) -> PyResult<Bound<'py, Words>> {
    let made = room::<T>(py, rows.len());
    made.readwrite()
        .as_slice_mut()?
        .copy_from_slice(cast_slice(rows));
    Ok(made)
}

/// Tables with room for a run.
pub(crate) struct Room<'py> {
    frames: Bound<'py, Words>,
    contacts: Bound<'py, Words>,
}

impl<'py> Room<'py> {
    /// Edge, corner and two vertices have two contacts; a frame with more of them is among obstacles, and rare.
    const CONTACTS: usize = 2;

    pub(crate) fn new(py: Python<'py>, frames: usize) -> Self {
        Self {
            frames: room::<FrameRow>(py, frames),
            contacts: room::<ContactRow>(py, frames * Self::CONTACTS),
        }
    }

    /// What fills them.
    pub(crate) fn open(&self) -> Open<'py> {
        Open {
            frames: self.frames.readwrite(),
            contacts: self.contacts.readwrite(),
        }
    }

    /// As tables, after they were filled.
    ///
    /// # Errors
    /// Memory ends.
    pub(crate) fn tables(self, py: Python<'py>, filled: &Filled) -> PyResult<Tables> {
        let words = filled.contacts * size_of::<ContactRow>() / size_of::<u64>();
        let words = isize::try_from(words)?;
        let contacts = self.contacts.get_item(PySlice::new(py, 0, words, 1))?;
        let mut contacts = contacts.cast_into::<Words>()?;
        if !filled.more.is_empty() {
            let mut all: Vec<u64> = contacts.readonly().as_slice()?.to_vec();
            all.extend_from_slice(cast_slice(&filled.more));
            contacts = array(py, &all)?;
        }
        Ok(Tables {
            frames: self.frames.unbind(),
            contacts: contacts.unbind(),
            events: array(py, &filled.events)?.unbind(),
        })
    }
}

/// Room that is written.
pub(crate) struct Open<'py> {
    frames: PyReadwriteArray1<'py, u64>,
    contacts: PyReadwriteArray1<'py, u64>,
}

impl Open<'_> {
    /// What takes frames.
    ///
    /// # Errors
    /// An array is not contiguous.
    pub(crate) fn filling(&mut self) -> PyResult<Filling<'_>> {
        Ok(Filling {
            frames: cast_slice_mut(self.frames.as_slice_mut()?),
            contacts: cast_slice_mut(self.contacts.as_slice_mut()?),
            next: 0,
            filled: Filled::default(),
        })
    }
}

/// How far room is filled, and what did not fit.
#[derive(Debug, Default)]
pub(crate) struct Filled {
    contacts: usize,
    more: Vec<ContactRow>,
    events: Vec<EventRow>,
}

/// Takes frames.
pub(crate) struct Filling<'a> {
    frames: &'a mut [FrameRow],
    contacts: &'a mut [ContactRow],
    next: u32,
    pub(crate) filled: Filled,
}

impl Filling<'_> {
    /// Adds a frame.
    pub(crate) fn add(&mut self, frame: &Frame) {
        let index = self.next;
        self.next += 1;
        if let Some(row) = self.frames.get_mut(index as usize) {
            *row = FrameRow::new(frame);
        }
        for contact in &frame.contacts {
            let row = ContactRow::new(index, contact);
            match self.contacts.get_mut(self.filled.contacts) {
                Some(place) => {
                    *place = row;
                    self.filled.contacts += 1;
                }
                None => self.filled.more.push(row),
            }
        }
        let events = frame.events.iter();
        let events = events.map(|&event| EventRow::new(index, event));
        self.filled.events.extend(events);
    }
}
