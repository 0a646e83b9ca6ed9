//! The cost of settings on emulated chips: the bundled scenes of the suite through every setting that is useful on the chip. From
//! scenes to the instructions or cycles of a frame, the stack, the state, and the flash, all of the same solver.

use rayon::prelude::*;
use stiction_core::{Evolution, Hand};
use stiction_host_sim::firmware::process::EmulatorError;
use stiction_host_sim::trade::chip::Chip;
use stiction_host_sim::trade::counts::Count;
use stiction_host_sim::trade::{Case, Emulated, Group, Memory, RATES, Setting, Suite};
use stiction_live::number::Number;
use stiction_scene::{NumberType, SceneModel, rust_source};

use crate::emulator::{Board, Counter, Profile, footprint, job};

const PROFILE: Profile = Profile::Device;

/// A number type on a chip.
#[derive(Clone, Copy, Debug)]
pub struct Build {
    /// The chip.
    pub chip: Chip,
    /// The number type.
    pub number: NumberType,
}

impl Build {
    /// Every chip with the number type that suits it; a chip without a single-precision unit also with f32.
    pub fn all() -> impl Iterator<Item = Self> {
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
            counter: Counter::of_model(Board::of(self.chip), PROFILE, &code)?,
            flash: footprint(Board::with_flash_of(self.chip), PROFILE, &code)?,
        })
    }
}

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
            let counted = self
                .counter
                .count(&job(&scene, setting.evolution, &hands), u32::MAX)?;
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

/// Counts these settings, as many at the same time as this computer has cores. All figures of a setting are those of one solver, which has
/// everything that the scenes need.
///
/// # Errors
/// Fails if the emulator or a target is missing, or an image cannot be built or run.
pub fn count(
    suite: &Suite,
    builds: &[Build],
    is_counted: impl Fn(&Setting, f64) -> bool + Sync,
) -> Result<Vec<Count>, EmulatorError> {
    let bundled = suite
        .cases
        .iter()
        .filter(|case| case.group == Group::Bundled);
    let cases: Vec<&Case> = bundled.collect();
    let of_build = |build: &Build| {
        let settings = build.settings();
        let rates = settings.flat_map(|setting| RATES.map(|rate| (setting, rate)));
        let counted = rates.filter(|(setting, rate)| is_counted(setting, *rate));
        counted.collect::<Vec<_>>()
    };
    let solvers: Vec<_> = builds
        .iter()
        .flat_map(|build| Evolution::ALL.map(|evolution| (*build, evolution)))
        .collect();
    let counts = solvers.par_iter().map(|(build, evolution)| {
        let mut counted = of_build(build);
        counted.retain(|(setting, _)| setting.evolution == *evolution);
        if counted.is_empty() {
            return Ok(Vec::new());
        }
        let solver = build.solver(&cases, *evolution)?;
        let count = |(setting, rate)| {
            let cost = solver.count(&cases, (setting, rate))?;
            eprintln!(
                "{}: {} at {rate} Hz",
                build.chip.name(),
                setting.memory.name
            );
            Ok(Count {
                chip: build.chip,
                setting,
                rate,
                cost,
            })
        };
        counted.into_iter().map(count).collect()
    });
    let counts: Result<Vec<Vec<Count>>, EmulatorError> = counts.collect();
    Ok(counts?.concat())
}
