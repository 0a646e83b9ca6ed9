//! Runs every scene of the suite through every setting at every rate: from the suite to rows of accuracy and cost.

use std::time::Duration;

use serde_json::Value;
use stiction_core::{Fixed, Hand, Real, SiFloat, Solver, narrow_hand};
use stiction_scene::InputError;

use super::accuracy::{Accuracy, Errors};
use super::chip::Chip;
use super::cost::{self, Cost};
use super::reference::{Reference, Truth};
use super::setting::{FINEST, Memory, RATES, Setting};
use super::suite::{Case, Group, Suite};
use crate::balance::Residual;
use stiction_live::number::Number;
use stiction_live::record::Frame;
use stiction_live::simulate::Running;

/// The results of a setting at a rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) setting: Setting,
    /// Frames per second (Hz).
    pub(super) rate: f64,
    /// The scenes; `None`: all of them.
    pub(super) group: Option<Group>,
    pub(super) accuracy: Accuracy,
    pub(super) cost: Cost,
}

impl Row {
    /// Returns whether it is the reference of all others with its memory length.
    pub(super) fn is_reference(&self) -> bool {
        let reference = Setting::reference(self.setting.memory);
        (self.setting, self.rate) == (reference, FINEST)
    }

    /// Name and value of every column, in the order of the files.
    pub(super) fn columns(&self) -> Vec<(String, Value)> {
        let setting = &self.setting;
        let named = |(name, value): (&str, Value)| (name.to_owned(), value);
        let mut columns: Vec<(String, Value)> = [
            ("number", setting.number.name().into()),
            ("evolution", setting.evolution.name().into()),
            ("memory", setting.memory.name.into()),
            ("rate_hz", self.rate.into()),
            ("scenes", self.group.map_or("all", Group::name).into()),
        ]
        .map(named)
        .into();
        self.add_accuracy(&mut columns);
        self.add_cost(&mut columns);
        columns
    }

    fn add_accuracy(&self, columns: &mut Vec<(String, Value)>) {
        let accuracy = &self.accuracy;
        let mut add = |name: &str, value: Value| columns.push((name.to_owned(), value));
        add("frames", accuracy.frames.into());
        for (name, unit, spread) in [
            ("position", "um", accuracy.position),
            ("angle", "mrad", accuracy.angle),
        ] {
            for (part, value) in spread.parts() {
                add(&format!("{name}_{part}_{unit}"), value.into());
            }
        }
        add("worst_residual", accuracy.residual.into());
        add("other_state", accuracy.other_state.into());
        add("reference_slips", accuracy.reference_slips.into());
        add("slips_too_many", accuracy.slips_too_many.into());
        add("slips_too_few", accuracy.slips_too_few.into());
        add("not_ok", accuracy.not_ok.into());
    }

    fn add_cost(&self, columns: &mut Vec<(String, Value)>) {
        columns.push(("host_ns".to_owned(), self.cost.host.into()));
        for (chip, counted) in Chip::ALL.iter().zip(self.cost.emulated) {
            let (key, unit) = (chip.key(), chip.unit());
            let time = |counted| chip.microseconds(counted);
            let mut add = |name: &str, value: Option<Value>| {
                columns.push((format!("{key}_{name}"), value.into()));
            };
            add(unit, counted.map(|c| c.mean.into()));
            add(&format!("{unit}_worst"), counted.map(|c| c.worst.into()));
            add("us", counted.map(|c| time(c.mean).into()));
            add("us_worst", counted.map(|c| time(c.worst.into()).into()));
            add("flash_bytes", counted.map(|c| c.flash.into()));
            add("state_bytes", counted.map(|c| c.state.into()));
            add("stack_bytes", counted.map(|c| c.stack.into()));
        }
    }
}

#[derive(Clone, Debug, Default)]
struct Tally {
    errors: Errors,
    spent: Duration,
    steps: usize,
}

impl Tally {
    fn merge(&mut self, other: &Self) {
        self.errors.merge(&other.errors);
        self.spent += other.spent;
        self.steps += other.steps;
    }

    fn row(self, setting: Setting, rate: f64, group: Option<Group>) -> Row {
        let nanoseconds = 1e9 * self.spent.as_secs_f64() / self.steps.max(1) as f64;
        Row {
            setting,
            rate,
            group,
            accuracy: self.errors.finish(),
            cost: Cost {
                host: nanoseconds,
                ..Cost::default()
            },
        }
    }
}

/// Measures all settings at all rates; `done` is called for every finished scene. Each combination has a row over all scenes,
/// followed by one for each group.
pub(super) fn measure(suite: &Suite, mut done: impl FnMut(&Case)) -> Result<Vec<Row>, InputError> {
    let settings: Vec<Setting> = Setting::all().collect();
    let combinations: Vec<_> = (settings.iter())
        .flat_map(|&setting| RATES.map(|rate| (setting, rate)))
        .collect();
    let mut tallies = vec![[(); Group::ALL.len()].map(|()| Tally::default()); combinations.len()];
    for case in &suite.cases {
        for memory in Memory::ALL {
            let case = &case.with(memory);
            let reference = Reference::new(case)?;
            let truths = RATES.map(|rate| reference.at(case.path.frames(Some(rate))));
            let measured = tallies.iter_mut().zip(&combinations);
            for (tallies, &(setting, rate)) in
                measured.filter(|(_, (setting, _))| setting.memory == memory)
            {
                let ride = Ride {
                    case,
                    setting,
                    rate,
                    truths: (RATES.iter().position(|known| *known == rate))
                        .map_or(&[][..], |k| &truths[k]),
                    slips: reference.slips(),
                };
                ride.measure(&mut tallies[case.group as usize])?;
            }
        }
        done(case);
    }
    let rows = combinations.iter().zip(tallies);
    Ok(rows
        .flat_map(|(&(setting, rate), tallies)| {
            let mut all = Tally::default();
            tallies.iter().for_each(|tally| all.merge(tally));
            let groups = Group::ALL.map(Some).into_iter().zip(tallies);
            std::iter::once((None, all))
                .chain(groups)
                .map(move |(group, tally)| tally.row(setting, rate, group))
        })
        .collect())
}

struct Ride<'a> {
    case: &'a Case,
    setting: Setting,
    rate: f64,
    truths: &'a [Truth],
    /// Slips of the reference.
    slips: u64,
}

impl Ride<'_> {
    fn measure(&self, tally: &mut Tally) -> Result<(), InputError> {
        match self.setting.number {
            Number::F64 => self.run::<f64>(tally),
            Number::F32 => self.run::<f32>(tally),
            Number::Fixed => self.run::<Fixed>(tally),
        }
    }

    fn run<R: Real<Si: SiFloat>>(&self, tally: &mut Tally) -> Result<(), InputError> {
        let scene = self.case.scene.scene::<R>()?;
        let solver = Solver::new(scene, self.setting.evolution);
        let frames = || self.case.path.frames(Some(self.rate));
        let hands: Vec<Hand<R::Si>> = frames().map(|sample| narrow_hand(&sample.hand)).collect();
        tally.spent += cost::time(&solver, &hands);
        tally.steps += hands.len().saturating_sub(1);
        let mut residual = Residual::new(&self.case.scene);
        let (mut slips, mut truths) = (0, self.truths.iter());
        Running::new(solver).simulate(frames(), |frame: Frame| {
            residual.add(&frame);
            slips += u64::from(frame.slips);
            if let Some(truth) = truths.next() {
                tally.errors.add(&frame, truth);
            }
            Ok::<_, InputError>(())
        })?;
        tally
            .errors
            .end_scene(slips, self.slips, residual.relative());
        Ok(())
    }
}
