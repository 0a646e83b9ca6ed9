//! What settings cost on emulated chips: the bundled scenes of the suite through every setting that makes sense on the chip.
//! From scenes to the instructions of a frame, the stack, the state, and the flash.

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

/// What was counted of a setting at a rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Count {
    chip: Chip,
    setting: Setting,
    rate: f64,
    cost: Emulated,
}

impl Count {
    /// Puts it into its rows: that of all scenes, and that of the bundled ones.
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

/// What a chip computes with.
struct Build {
    chip: Chip,
    number: NumberType,
}

/// Fixed point is for the chip that has no unit for single precision.
const BUILDS: [Build; 3] = [
    Build {
        chip: Chip::CortexM4F,
        number: NumberType::F32,
    },
    Build {
        chip: Chip::CortexM0,
        number: NumberType::F32,
    },
    Build {
        chip: Chip::CortexM0,
        number: NumberType::Fixed,
    },
];

impl Build {
    fn settings(&self) -> impl Iterator<Item = Setting> {
        let number = Number::from(self.number);
        let counted =
            move |setting: &Setting| setting.number == number && setting.memory != Memory::NONE;
        Setting::all().filter(counted)
    }

    /// The flash of the solver of a scene (bytes), by evolution.
    fn flash(&self, case: &Case, evolution: Evolution) -> Result<u64, EmulatorError> {
        let model = SceneModel::smallest(&case.scene);
        let code = rust_source(&case.scene, model, self.number, evolution);
        footprint(self.chip.board(), PROFILE, &code)
    }

    /// Scenes through a setting at a rate.
    fn count(
        &self,
        counter: &Counter,
        cases: &[&Case],
        (setting, rate): (Setting, f64),
    ) -> Result<Emulated, EmulatorError> {
        let mut cost = Emulated::default();
        let (mut sum, mut steps) = (0, 0);
        for case in cases {
            let samples = case.path.frames(Some(rate));
            let hands: Vec<Hand<f64>> = samples.map(|sample| sample.hand).collect();
            let scene = setting.memory.of(&case.scene);
            let counted = counter.count(&job(&scene, setting.evolution, &hands))?;
            for frame in counted.steps() {
                sum += u64::from(frame.instructions);
                steps += 1;
                cost.worst = cost.worst.max(frame.instructions);
            }
            cost.state = counted.totals.state;
            cost.stack = cost.stack.max(counted.totals.stack);
        }
        cost.instructions = sum as f64 / f64::from(steps.max(1_u32));
        Ok(cost)
    }
}

/// How many times [`count`] says that a setting is done at a rate.
pub(super) fn extent() -> usize {
    let settings = BUILDS.iter().flat_map(Build::settings);
    settings.count() * RATES.len()
}

/// Counts on all chips; `done` hears of every setting at a rate. Flash is that of the first scene's solver.
///
/// # Errors
/// The emulator or a target is missing, or an image cannot be built or run.
pub(super) fn count(
    suite: &Suite,
    mut done: impl FnMut(&str),
) -> Result<Vec<Count>, EmulatorError> {
    let bundled = suite
        .cases
        .iter()
        .filter(|case| case.group == Group::Bundled);
    let cases: Vec<&Case> = bundled.collect();
    let mut counts = Vec::new();
    for build in &BUILDS {
        let counter = Counter::new(build.chip.board(), build.number, PROFILE)?;
        for setting in build.settings() {
            for rate in RATES {
                let cost = build.count(&counter, &cases, (setting, rate))?;
                done(build.chip.name());
                counts.push(Count {
                    chip: build.chip,
                    setting,
                    rate,
                    cost,
                });
            }
        }
    }
    // After all counting: every scene's footprint is built anew, and so are the images after it.
    for build in &BUILDS {
        for evolution in Evolution::ALL {
            let Some(case) = cases.first() else { continue };
            let flash = build.flash(case, evolution)?;
            let its_own = counts.iter_mut().filter(|count| {
                let setting = &count.setting;
                (count.chip, setting.number, setting.evolution)
                    == (build.chip, Number::from(build.number), evolution)
            });
            its_own.for_each(|count| count.cost.flash = flash);
        }
    }
    Ok(counts)
}
