//! Solvers: step by step, or over whole arrays.

use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use stiction_core::{Angle, Evolution, Hand, TrackerSample};
use stiction_host_sim::number::Number;
use stiction_host_sim::options::{parse_evolution, parse_number};
use stiction_host_sim::record;
use stiction_host_sim::session::Session;
use stiction_scene::{LivePlacement, Sample, SceneFile};

use crate::refused;
use crate::rows::Rows;
use crate::run::Run;
use crate::scene::Scene;

/// A solver with its run.
#[pyclass(module = "stiction")]
pub(crate) struct Solver {
    scene: Py<Scene>,
    file: SceneFile,
    number: Number,
    evolution: Evolution,
    budget: Option<u32>,
    session: Session,
    /// Samples so far.
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
    fn new(
        py: Python<'_>,
        scene: Py<Scene>,
        number: &str,
        evolution: &str,
        budget: Option<u32>,
    ) -> PyResult<Self> {
        let problem = |name: &str, value: &str| {
            let (name, value) = (name.to_owned(), value.to_owned());
            move |allowed: String| refused(format!("`{name}` is {value:?}, {allowed}"))
        };
        let kind = parse_number(number).map_err(problem("number", number))?;
        let evolution = parse_evolution(evolution).map_err(problem("evolution", evolution))?;
        if budget == Some(0) {
            return Err(refused("`budget` is 0, allowed: None, or a whole number above 0"));
        }
        let file = scene.borrow(py).file_in(kind).map_err(refused)?;
        let session =
            Session::new(&file, kind, evolution, budget.unwrap_or(u32::MAX)).map_err(refused)?;
        Ok(Self {
            scene,
            file,
            number: kind,
            evolution,
            budget,
            session,
            samples: 0,
        })
    }

    /// One frame: the hand goes to its new pose.
    #[pyo3(signature = (x, y, phi, *, held = true, depth = 0.0, t = None))]
    fn step(&mut self, x: f64, y: f64, phi: f64, held: bool, depth: f64, t: Option<f64>) -> Run {
        let sample = Sample {
            t: t.unwrap_or(self.samples as f64 * 1e-3),
            hand: hand([x, y, phi], (held, depth)),
        };
        self.samples += 1;
        let mut rows = Rows::with_room(1);
        rows.add(&self.session.step(&sample));
        self.run_of(rows)
    }

    /// All rows of an array, from the scene's start: (N, 3) x, y (m), phi (rad), or (N, 7) poses of a tracker: position (m) and quaternion
    /// (x, y, z, w), placed as the scene's `[hand]` says. Nothing of the array is copied, and other threads run meanwhile.
    #[pyo3(signature = (hand, *, t = None, held = None, rate = 1000.0))]
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
        if columns != 3 && columns != 7 {
            return Err(refused(format!(
                "`hand` has {columns} columns, allowed: 3 (x, y, phi) or 7 (position and quaternion)"
            )));
        }
        if !(rate > 0.0 && rate.is_finite()) {
            return Err(refused(format!("`rate` is {rate}, allowed: a finite number above 0")));
        }
        let (t, held) = (t.as_ref().map(|t| t.as_array()), held.as_ref().map(|held| held.as_array()));
        for (name, length) in [
            ("t", t.as_ref().map(|t| t.len())),
            ("held", held.as_ref().map(|held| held.len())),
        ] {
            if let Some(length) = length.filter(|&length| length != count) {
                return Err(refused(format!("`{name}` has {length} elements, allowed: {count}")));
            }
        }
        let mut tracker = match columns {
            7 => Some(self.tracker()?),
            _ => None,
        };
        let mut session = self.session()?;
        let rows = py.detach(|| {
            let mut rows = Rows::with_room(count);
            let mut samples = (0..count).map(|i| {
                let row = array.row(i);
                let is_held = held.as_ref().is_none_or(|held| held[i]);
                let hand = match &mut tracker {
                    None => self::hand([row[0], row[1], row[2]], (is_held, 0.0)),
                    Some(tracker) => {
                        let pose = TrackerSample {
                            position: [row[0], row[1], row[2]],
                            orientation: [row[3], row[4], row[5], row[6]],
                            held: is_held,
                        };
                        tracker.hand(Some(&pose))
                    }
                };
                let t = t.as_ref().map_or(i as f64 / rate, |t| t[i]);
                Sample { t, hand }
            });
            session.run(&mut samples, &mut |frame| rows.add(frame));
            rows
        });
        self.session = session;
        self.samples = count as u64;
        Ok(self.run_of(rows))
    }

    /// A copy that goes on from here by itself.
    fn snapshot(&self, py: Python<'_>) -> Self {
        Self {
            scene: self.scene.clone_ref(py),
            file: self.file.clone(),
            number: self.number,
            evolution: self.evolution,
            budget: self.budget,
            session: self.session.clone(),
            samples: self.samples,
        }
    }

    /// Back to a snapshot of this solver, or of another one of the same scene.
    fn restore(&mut self, snapshot: &Self) {
        self.session = snapshot.session.clone();
        self.samples = snapshot.samples;
    }

    /// Back to the scene's start.
    fn reset(&mut self) -> PyResult<()> {
        self.session = self.session()?;
        self.samples = 0;
        Ok(())
    }

    #[getter]
    fn scene(&self, py: Python<'_>) -> Py<Scene> {
        self.scene.clone_ref(py)
    }

    #[getter]
    fn number(&self) -> &'static str {
        self.number.name()
    }

    #[getter]
    fn evolution(&self) -> &'static str {
        self.evolution.name()
    }

    #[getter]
    fn budget(&self) -> Option<u32> {
        self.budget
    }

    /// Frames so far.
    fn __len__(&self) -> usize {
        self.samples as usize
    }
}

impl Solver {
    fn run_of(&self, rows: Rows) -> Run {
        Run::new(record::Run::of(&self.file, self.number, self.evolution), rows, &self.file)
    }

    fn tracker(&self) -> PyResult<LivePlacement> {
        let live = self.file.hand.placement.live();
        live.ok_or_else(|| refused("`plane` of the scene's [hand]: the axes are not two different ones"))
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
