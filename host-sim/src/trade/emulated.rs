//! The cost of settings on emulated chips: the bundled scenes of the suite through every setting that is useful on the chip. From
//! scenes to the instructions or cycles of a frame, the stack, the state, and the flash, all of the same solver.

use rayon::prelude::*;
use stiction_core::{Evolution, Hand};
use stiction_scene::{NumberType, SceneModel, rust_source};
use stiction_tools::process::EmulatorError;

use super::cost::Emulated;
use super::measure::Row;
use super::setting::{Memory, RATES, Setting};
use super::suite::{Case, Group, Suite};
use crate::emulator::{Chip, Counter, Profile, footprint, job};
use crate::number::Number;

/// How images are built.
const PROFILE: Profile = Profile::Device;

/// The counts of a setting at a rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Count {
    chip: Chip,
    setting: Setting,
    rate: f64,
    cost: Emulated,
}

impl Count {
    /// Copies them to their rows: that of all scenes, and that of the bundled ones.
    pub(super) fn enter(&self, rows: &mut [Row]) {
        let groups = [None, Some(Group::Bundled)];
        let its_own = rows.iter_mut().filter(|row| {
            (row.setting, row.rate) == (self.setting, self.rate) && groups.contains(&row.group)
        });
        for row in its_own {
            row.cost.emulated[self.chip as usize] = Some(self.cost);
        }
    }
}

/// A number type on a chip.
#[derive(Clone, Copy)]
struct Build {
    chip: Chip,
    number: NumberType,
}

impl Build {
    /// Every chip with the number type that suits it; a chip without a single-precision unit also with f32.
    fn all() -> impl Iterator<Item = Self> {
        let number = |chip: Chip| (chip == Chip::CortexM0).then_some(NumberType::F32);
        Chip::ALL.into_iter().flat_map(move |chip| {
            let numbers = number(chip).into_iter().chain([chip.number()]);
            numbers.map(move |number| Self { chip, number })
        })
    }

    fn settings(&self) -> impl Iterator<Item = Setting> {
        let number = Number::from(self.number);
        let counted =
            move |setting: &Setting| setting.number == number && setting.memory != Memory::NONE;
        Setting::all().filter(counted)
    }

    /// The solver for all scenes with an evolution: its counter and its flash (bytes).
    fn solver(&self, cases: &[&Case], evolution: Evolution) -> Result<Built, EmulatorError> {
        let models = cases.iter().map(|case| SceneModel::smallest(&case.scene));
        let (Some(model), Some(first)) = (models.reduce(SceneModel::with), cases.first()) else {
            return Err(EmulatorError::Output("no scene to count".to_owned()));
        };
        let code = rust_source(&first.scene, model, self.number, evolution);
        Ok(Built {
            counter: Counter::of_model(self.chip.board(), PROFILE, &code)?,
            flash: footprint(self.chip.flash_board(), PROFILE, &code)?,
        })
    }
}

/// A solver on a chip.
struct Built {
    counter: Counter,
    /// Its increase of an image's size (bytes).
    flash: u64,
}

impl Built {
    /// Runs scenes through a setting at a rate.
    fn count(
        &self,
        cases: &[&Case],
        (setting, rate): (Setting, f64),
    ) -> Result<Emulated, EmulatorError> {
        let mut cost = Emulated {
            flash: self.flash,
            ..Emulated::default()
        };
        let (mut sum, mut steps) = (0, 0);
        for case in cases {
            let samples = case.path.frames(Some(rate));
            let hands: Vec<Hand<f64>> = samples.map(|sample| sample.hand).collect();
            let scene = setting.memory.of(&case.scene);
            let counted =
                self.counter
                    .count(&job(&scene, (setting.evolution, u32::MAX), &hands))?;
            for frame in counted.steps() {
                sum += u64::from(frame.instructions);
                steps += 1;
                cost.worst = cost.worst.max(frame.instructions);
            }
            cost.state = counted.totals.state;
            cost.stack = cost.stack.max(counted.totals.stack);
        }
        cost.mean = sum as f64 / f64::from(steps.max(1_u32));
        Ok(cost)
    }
}

/// How many times [`count`] reports that a setting is complete at a rate.
pub(super) fn extent() -> usize {
    let settings = Build::all().map(|build| build.settings().count());
    settings.sum::<usize>() * RATES.len()
}

/// Counts on all chips, as many at the same time as this computer has cores; `done` is called for every setting at a rate. All
/// figures of a setting are those of one solver, which has everything that the scenes need.
///
/// # Errors
/// Fails if the emulator or a target is missing, or an image cannot be built or run.
pub(super) fn count(
    suite: &Suite,
    done: impl Fn(&str) + Sync,
) -> Result<Vec<Count>, EmulatorError> {
    let bundled = suite
        .cases
        .iter()
        .filter(|case| case.group == Group::Bundled);
    let cases: Vec<&Case> = bundled.collect();
    let solvers: Vec<_> = Build::all()
        .flat_map(|build| Evolution::ALL.map(|evolution| (build, evolution)))
        .collect();
    let counts = solvers.par_iter().map(|(build, evolution)| {
        let solver = build.solver(&cases, *evolution)?;
        let mut counts = Vec::new();
        for setting in build.settings().filter(|s| s.evolution == *evolution) {
            for rate in RATES {
                let cost = solver.count(&cases, (setting, rate))?;
                done(build.chip.name());
                counts.push(Count {
                    chip: build.chip,
                    setting,
                    rate,
                    cost,
                });
            }
        }
        Ok(counts)
    });
    let counts: Result<Vec<_>, EmulatorError> = counts.collect();
    Ok(counts?.into_iter().flatten().collect())
}
