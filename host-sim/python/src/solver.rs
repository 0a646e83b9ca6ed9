//! Solvers: step by step, or over whole arrays.

use std::sync::Arc;

use numpy::ndarray::ArrayView1;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use stiction_core::{Angle, Evolution, Hand, TrackerSample};
use stiction_live::number::Number;
use stiction_live::session::Session;
use stiction_scene::{LivePlacement, Sample, SceneFile};

use crate::frame::Frame;
use crate::run::{Head, Run};
use crate::scene::Scene;
use crate::tables::Tables;
use crate::{kind, positive, refused};

/// Samples per second if no times are given (Hz).
const RATE: f64 = 1000.0;

/// A solver with its run.
#[pyclass(module = "stiction._stiction")]
pub(crate) struct Solver {
    file: Arc<SceneFile>,
    head: Arc<Head>,
    number: Number,
    evolution: Evolution,
    budget: Option<u32>,
    session: Session,
    /// The placement of a tracker's poses, after the first of them.
    tracker: Option<LivePlacement>,
    /// The number of samples so far.
    samples: u64,
}

impl Solver {
    fn session(&self) -> PyResult<Session> {
        let budget = self.budget.unwrap_or(u32::MAX);
        Session::new(&self.file, self.number, self.evolution, budget).map_err(refused)
    }
}

#[pymethods]
impl Solver {
    #[new]
    #[pyo3(signature = (scene, *, number = "f32", evolution = "path", budget = None))]
    fn new(scene: &Scene, number: &str, evolution: &str, budget: Option<u32>) -> PyResult<Self> {
        let (kind, evolution) = kind(number, evolution)?;
        if budget == Some(0) {
            return Err(refused(
                "`budget` is 0, allowed: None, or a whole number above 0",
            ));
        }
        let file = scene.file_in(kind).map_err(refused)?;
        let session =
            Session::new(&file, kind, evolution, budget.unwrap_or(u32::MAX)).map_err(refused)?;
        Ok(Self {
            head: Head::new(&file, kind, evolution),
            file: Arc::new(file),
            number: kind,
            evolution,
            budget,
            session,
            tracker: None,
            samples: 0,
        })
    }

    /// One frame: the hand moves to x, y (m), phi (rad).
    fn step(
        &mut self,
        x: f64,
        y: f64,
        phi: f64,
        held: bool,
        depth: f64,
        t: Option<f64>,
    ) -> PyResult<Frame> {
        let t = t.unwrap_or(self.samples as f64 / RATE);
        if !t.is_finite() {
            return Err(refused(format!("`t` is {t}, allowed: a finite number")));
        }
        let sample = Sample {
            t,
            hand: hand([x, y, phi], (held, depth)),
        };
        self.samples += 1;
        Ok(Frame(self.session.step(&sample)))
    }

    /// Steps through all rows of an array: (N, 3) x, y (m), phi (rad), or (N, 7) poses of a tracker: position (m) and quaternion
    /// (x, y, z, w), placed as in the scene's `[hand]`. The array is not copied, and other threads run meanwhile. Contacts are computed on
    /// demand. After an error, the solver is where it was.
    #[pyo3(signature = (hand, *, t, held, rate))]
    fn run(
        &mut self,
        py: Python<'_>,
        hand: PyReadonlyArray2<'_, f64>,
        t: Option<PyReadonlyArray1<'_, f64>>,
        held: Option<PyReadonlyArray1<'_, bool>>,
        rate: f64,
    ) -> PyResult<Run> {
        let array = hand.as_array();
        let (count, columns) = array.dim();
        let rate = positive("rate", rate)?;
        if u32::try_from(count).is_err() {
            return Err(refused(format!(
                "`hand` has {count} rows, allowed: at most {}",
                u32::MAX
            )));
        }
        let t = t.as_ref().map(|t| t.as_array());
        let held = held.as_ref().map(|held| held.as_array());
        of_length("t", t.map(|t| t.len()), count)?;
        of_length("held", held.map(|held| held.len()), count)?;
        if let Some((row, time)) = t.and_then(|t| lost(t)) {
            return Err(refused(format!(
                "`t`, row {row}: {time}, allowed: a finite number"
            )));
        }
        let samples = self.samples;
        let time = |i: usize| t.map_or((samples + i as u64) as f64 / rate, |t| t[i]);
        let is_held = |i: usize| held.is_none_or(|held| held[i]);
        match columns {
            3 => {
                let samples = (0..count).map(|i| Sample {
                    t: time(i),
                    hand: self::hand([0, 1, 2].map(|k| array[[i, k]]), (is_held(i), 0.0)),
                });
                self.follow(py, count, samples)
            }
            7 => {
                let mut tracker = match &self.tracker {
                    Some(tracker) => tracker.clone(),
                    None => self.placement()?,
                };
                let samples = (0..count).map(|i| Sample {
                    t: time(i),
                    hand: tracker.hand(Some(&TrackerSample {
                        position: [0, 1, 2].map(|k| array[[i, k]]),
                        orientation: [3, 4, 5, 6].map(|k| array[[i, k]]),
                        held: is_held(i),
                    })),
                });
                let run = self.follow(py, count, samples)?;
                self.tracker = Some(tracker);
                Ok(run)
            }
            _ => Err(refused(format!(
                "`hand` has {columns} columns, allowed: 3 (x, y, phi) or 7 (position and quaternion)"
            ))),
        }
    }

    /// A copy that continues independently from here.
    fn snapshot(&self) -> Self {
        Self {
            file: Arc::clone(&self.file),
            head: Arc::clone(&self.head),
            number: self.number,
            evolution: self.evolution,
            budget: self.budget,
            session: self.session.clone(),
            tracker: self.tracker.clone(),
            samples: self.samples,
        }
    }

    /// Returns to a snapshot.
    fn restore(&mut self, snapshot: &Self) -> PyResult<()> {
        if !Arc::ptr_eq(&self.head, &snapshot.head) {
            return Err(refused(
                "`snapshot` belongs to another solver, allowed: one of this solver",
            ));
        }
        self.session = snapshot.session.clone();
        self.tracker = snapshot.tracker.clone();
        self.samples = snapshot.samples;
        Ok(())
    }

    /// Returns to the scene's start.
    fn reset(&mut self) -> PyResult<()> {
        self.session = self.session()?;
        self.tracker = None;
        self.samples = 0;
        Ok(())
    }

    /// The number type.
    #[getter]
    fn number(&self) -> &'static str {
        self.number.name()
    }

    /// The evolution.
    #[getter]
    fn evolution(&self) -> &'static str {
        self.evolution.name()
    }

    /// The pieces of work that a frame may take.
    #[getter]
    fn budget(&self) -> Option<u32> {
        self.budget
    }

    /// The number of frames so far.
    fn __len__(&self) -> usize {
        self.samples as usize
    }
}

impl Solver {
    /// The run of a number of samples, without Python's lock.
    fn follow(
        &mut self,
        py: Python<'_>,
        count: usize,
        mut samples: impl Iterator<Item = Sample> + Send,
    ) -> PyResult<Run> {
        let mut session = self.session.clone();
        let tables = Tables::filled(py, count, |rows| {
            session.run(&mut samples, &mut |frame| rows.add(frame))
        })?;
        self.session = session;
        self.samples += count as u64;
        Ok(Run::new(Arc::clone(&self.head), tables))
    }

    fn placement(&self) -> PyResult<LivePlacement> {
        let live = self.file.hand.placement.live();
        live.ok_or_else(|| {
            refused("`plane` of the scene's [hand]: the axes are not two different ones")
        })
    }
}

/// The first time that is not finite, with its row.
fn lost(times: ArrayView1<'_, f64>) -> Option<(usize, f64)> {
    let mut rows = times.into_iter().copied().enumerate();
    rows.find(|(_, time)| !time.is_finite())
}

fn of_length(name: &str, length: Option<usize>, count: usize) -> PyResult<()> {
    match length.filter(|&length| length != count) {
        None => Ok(()),
        Some(length) => Err(refused(format!(
            "`{name}` has {length} elements, allowed: {count}"
        ))),
    }
}

fn hand([x, y, phi]: [f64; 3], (held, depth): (bool, f64)) -> Hand<f64> {
    let hand = Hand {
        depth,
        angle: Angle::from_radians(phi),
        ..Hand::new(x, y, 0.0)
    };
    if held { hand } else { hand.released() }
}
