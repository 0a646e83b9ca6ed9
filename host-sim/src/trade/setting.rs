//! What can be chosen: number type, evolution, dial and frame rate.

use stiction_core::{Evolution, Real, SiFloat, Solver};
use stiction_scene::{HostScene, HostSolver};

use crate::number::Number;

/// Frame rates (Hz): the paper's tracker, a motion capture, a haptic device.
pub const RATES: [f64; 3] = [31.0, 100.0, FINEST];

/// The rate (Hz) at which the reference runs.
pub const FINEST: f64 = 1000.0;

/// How exact the solver's searches are to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dial {
    /// The name in tables.
    pub name: &'static str,
    /// Angles of balance (rad), and the ends of slips as parts of the body size, are found to within this; 0: to the last
    /// digits of the number type.
    pub tolerance: f64,
}

impl Dial {
    /// To the last digits of the number type.
    pub(super) const EXACT: Self = Self::new("exact", 0.0);

    /// All positions that are measured.
    pub const ALL: [Self; 4] = [
        Self::EXACT,
        Self::new("1e-5", 1e-5),
        Self::new("1e-4", 1e-4),
        Self::new("1e-3", 1e-3),
    ];

    const fn new(name: &'static str, tolerance: f64) -> Self {
        Self { name, tolerance }
    }
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
    pub(super) const REFERENCE: Self = Self {
        number: Number::F64,
        evolution: Evolution::Path,
        dial: Dial::EXACT,
    };

    /// All combinations; f64, the yardstick, is exact only.
    pub fn all() -> impl Iterator<Item = Self> {
        let pairs = Number::ALL
            .into_iter()
            .flat_map(move |number| Evolution::ALL.map(|evolution| (number, evolution)));
        pairs.flat_map(|(number, evolution)| {
            let setting = move |dial| Self {
                number,
                evolution,
                dial,
            };
            let all = Dial::ALL.into_iter().map(setting);
            all.filter(|setting| setting.number != Number::F64 || setting.dial == Dial::EXACT)
        })
    }

    /// The solver of a scene; R is the number type of this setting.
    pub(super) fn solver<R: Real<Si: SiFloat>>(&self, scene: HostScene<R>) -> HostSolver<R> {
        Solver::new(scene, self.evolution).with_tolerance(R::Si::narrow(self.dial.tolerance))
    }
}
