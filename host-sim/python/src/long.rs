//! Work of any length without Python's lock: Ctrl-C ends it, and a lack of memory is a `MemoryError`.

use std::collections::TryReserveError;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use numpy::{Element, PyArray1};
use pyo3::exceptions::{PyMemoryError, PyRuntimeError};
use pyo3::prelude::*;

/// Time between two looks at Python's signals: Ctrl-C is answered within 0.1 s also where the system is busy.
const PERIOD: Duration = Duration::from_millis(20);
/// Frames between two looks at the clock, which takes about 30 ns, a frame 200 ns to 1 ms.
const FRAMES: u32 = 16;

/// Looks at Python's signals from time to time.
pub(crate) struct Signals {
    frames: u32,
    looked: Instant,
}

impl Signals {
    pub(crate) fn new() -> Self {
        Self {
            frames: 0,
            looked: Instant::now(),
        }
    }

    /// To be called for every frame of the work: an error of Python's if a signal ends it, `KeyboardInterrupt` for Ctrl-C.
    pub(crate) fn check(&mut self) -> PyResult<()> {
        self.frames += 1;
        if self.frames < FRAMES {
            return Ok(());
        }
        self.frames = 0;
        if self.looked.elapsed() < PERIOD {
            return Ok(());
        }
        self.looked = Instant::now();
        pending()
    }
}

/// Runs the handlers of signals that have arrived.
fn pending() -> PyResult<()> {
    Python::attach(|py| py.check_signals())
}

/// The result of work that cannot look at signals itself. A signal leaves it to its own end.
pub(crate) fn aside<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> PyResult<T> {
    let (sender, receiver) = channel();
    thread::Builder::new().spawn(move || sender.send(work()))?;
    loop {
        match receiver.recv_timeout(PERIOD) {
            Ok(done) => return Ok(done),
            Err(RecvTimeoutError::Timeout) => pending()?,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the work ended without a result"));
            }
        }
    }
}

/// The error where memory is lacking.
pub(crate) fn no_memory(error: TryReserveError) -> PyErr {
    PyMemoryError::new_err(error.to_string())
}

/// An array of zeros in numpy's memory, which uses large pages.
pub(crate) fn zeros<T: Element>(py: Python<'_>, count: usize) -> PyResult<Bound<'_, PyArray1<T>>> {
    let numpy = py.import("numpy")?;
    let made = numpy.call_method1("zeros", (count, numpy::dtype::<T>(py)))?;
    Ok(made.cast_into()?)
}
