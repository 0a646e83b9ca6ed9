//! The compiled half of the Python package `stiction`: scenes, solvers and runs of `stiction-host-sim`. The pure Python half, from
//! tables to plots, is in `package/`.

mod frame;
mod long;
mod rows;
mod run;
mod scene;
mod solver;
mod tables;

use pyo3::prelude::*;
use stiction_core::Evolution;
use stiction_live::number::{Number, parse_kind};

/// See `stiction`.
#[pymodule]
mod _stiction {
    #[pymodule_export]
    use super::frame::Frame;
    #[pymodule_export]
    use super::run::Run;
    #[pymodule_export]
    use super::scene::Scene;
    #[pymodule_export]
    use super::solver::Solver;

    use pyo3::prelude::*;
    use stiction_core::{Event, StateKind, Status};

    /// The names that numbers stand for, in order, and the version.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("STATES", StateKind::ALL.map(StateKind::name).to_vec())?;
        module.add("STATUSES", Status::ALL.map(Status::name).to_vec())?;
        module.add("EVENTS", Event::ALL.map(Event::name).to_vec())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}

/// A Python error about a value.
fn refused(problem: impl ToString) -> PyErr {
    pyo3::exceptions::PyValueError::new_err(problem.to_string())
}

/// A number type and an evolution by their names.
fn kind(number: &str, evolution: &str) -> PyResult<(Number, Evolution)> {
    parse_kind(number, evolution).map_err(refused)
}

/// A number above 0.
fn positive(name: &str, value: f64) -> PyResult<f64> {
    if value > 0.0 && value.is_finite() {
        return Ok(value);
    }
    Err(refused(format!(
        "`{name}` is {value:?}, allowed: a finite number above 0"
    )))
}
