//! What can be chosen: number type, evolution, dial and frame rate.

use stiction_core::{Evolution, Real, Solver};

use crate::number::{Number, SiFloat};
use crate::scene_file::{HostScene, HostSolver};

/// Frame rates (Hz): the paper's tracker, a motion capture, a haptic device.
pub const RATES: [f64; 3] = [31.0, 100.0, FINEST];

/// The rate (Hz) at which the reference runs.
pub const FINEST: f64 = 1000.0;

/// How exact the solver's searches are to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dial {
    /// The name in tables.
    pub name: &'static str,
}

impl Dial {
    /// To the last digits of the number type.
    pub const EXACT: Self = Self { name: "exact" };

    /// All positions that are measured.
    pub const ALL: [Self; 1] = [Self::EXACT];
}

/// A setting of the solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Number type.
    pub number: Number,
    /// Evolution within a frame.
    pub evolution: Evolution,
    /// Accuracy.
    pub dial: Dial,
}

impl Setting {
    /// What every other setting is measured against, at [`FINEST`].
    pub const REFERENCE: Self = Self {
        number: Number::F64,
        evolution: Evolution::Path,
        dial: Dial::EXACT,
    };

    /// All combinations.
    pub fn all() -> impl Iterator<Item = Self> {
        Number::ALL.into_iter().flat_map(|number| {
            [Evolution::Path, Evolution::Frame]
                .into_iter()
                .flat_map(move |evolution| {
                    Dial::ALL.into_iter().map(move |dial| Self {
                        number,
                        evolution,
                        dial,
                    })
                })
        })
    }

    /// The name of the evolution on the command line.
    pub const fn evolution_name(&self) -> &'static str {
        match self.evolution {
            Evolution::Path => "path",
            Evolution::Frame => "frame",
        }
    }

    /// The solver of a scene; R is the number type of this setting.
    pub(super) fn solver<R: Real<Si: SiFloat>>(&self, scene: HostScene<R>) -> HostSolver<R> {
        Solver::new(scene, self.evolution)
    }
}
