//! The settings of a run, as given by the options of `stiction run`: the hand's path, the number type, the evolution, the rate
//! and the budget.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use stiction_core::{Evolution, Real, SiFloat};
use stiction_scene::{InputError, Sample, SceneFile};

use crate::options::{evolution_parser, parse_budget, parse_rate};
use stiction_live::number::Number;
use stiction_live::record::Frame;
use stiction_live::simulate::{Kind, Running, Task, with_solver};

/// What may be chosen besides the scene.
#[derive(Args, Clone, Debug)]
pub(crate) struct Settings {
    /// Recorded hand path (csv, tum, txt) instead of the one in the scene file
    #[arg(long, value_name = "FILE")]
    pub(crate) hand: Option<PathBuf>,
    /// Place the path of --hand over the scene: it begins where the body is held at its start, and units, plane and angles that look wrong
    /// are mended; the keys that do the same are printed
    #[arg(long, requires = "hand")]
    pub(crate) fit: bool,
    /// Number type of the solver
    #[arg(long, value_enum, default_value_t = Number::F32)]
    pub(crate) number: Number,
    /// path: events are found along the hand's straight line between two frames; frame: from the first event of a
    /// frame the hand jumps to its end
    #[arg(long, default_value = "path", value_parser = evolution_parser())]
    pub(crate) evolution: Evolution,
    /// Hand frames per second, instead of the rate in the scene file
    #[arg(long, value_name = "HZ", value_parser = parse_rate, allow_negative_numbers = true)]
    pub(crate) rate: Option<f64>,
    /// Units of work that a frame may take, 1 or more; it does one piece of work at least. What is left of a frame is done with
    /// the next one
    #[arg(long, value_name = "UNITS", value_parser = parse_budget, allow_negative_numbers = true)]
    pub(crate) budget: Option<u32>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            hand: None,
            fit: false,
            number: Number::F32,
            evolution: Evolution::Path,
            rate: None,
            budget: None,
        }
    }
}

impl Settings {
    /// Runs a scene over the hand's motion and passes every frame to `sink`; returns the run time of the solver's steps.
    pub(crate) fn simulate<E: From<InputError>>(
        &self,
        scene: &SceneFile,
        samples: impl Iterator<Item = Sample>,
        sink: impl FnMut(Frame) -> Result<(), E>,
    ) -> Result<Duration, E> {
        let kind = Kind {
            number: self.number,
            evolution: self.evolution,
            budget: self.budget.unwrap_or(u32::MAX),
        };
        with_solver(scene, kind, WholeRun(samples, sink))?
    }
}

/// A run from the first sample to the last, and the sink of its frames.
struct WholeRun<I, F>(I, F);

impl<I: Iterator<Item = Sample>, F: FnMut(Frame) -> Result<(), E>, E> Task for WholeRun<I, F> {
    type Done = Result<Duration, E>;

    fn with<R: Real<Si: SiFloat>>(self, running: Running<R>) -> Self::Done
    where
        Running<R>: Send + Sync,
    {
        running.simulate(self.0, self.1)
    }
}
