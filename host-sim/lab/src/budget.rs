//! Measures the effect of a budget: random drags on emulated chips, without a budget and with the one that fits a tick: the cost
//! of a piece of work, how many steps are behind the hand and for how long, and the cost of the longest step. Needs QEMU, except for the
//! M0+.

use std::error::Error;

use stiction_core::{Evolution, Hand, Status};
use stiction_host_sim::columns::thousands;
use stiction_host_sim::trade::chip::Chip;
use stiction_host_sim::trade::{self, Case};

use crate::emulator::{Board, Counted, Counter, Frame, Profile, job};
use crate::markdown::{Destination, Table};

/// The fraction of a tick for the step: the rest is for the line, the forces and interrupts.
const PART: f64 = 0.875;
/// Quantiles over all steps (%).
const PARTS: [f64; 4] = [50.0, 99.0, 99.9, 99.99];

/// Ticks per second (Hz), and hands per second, that are demanded of a chip.
const fn rate(chip: Chip) -> u32 {
    match chip {
        Chip::CortexM0 => 250,
        Chip::CortexM4F | Chip::CortexM33 | Chip::CortexM0Plus => 1000,
    }
}

/// The capacity of a tick: in instructions, or in cycles if those are counted.
fn tick(chip: Chip) -> f64 {
    1e6 / f64::from(rate(chip)) / chip.microseconds(1.0)
}

fn counted(
    chip: Chip,
    (evolution, budget): (Evolution, u32),
    drags: &[Case],
) -> Result<Vec<Counted>, Box<dyn Error>> {
    let counter = Counter::new(Board::of(chip), chip.number(), Profile::Device)?;
    let ride = |case: &Case| {
        let samples = case.path.frames(Some(f64::from(rate(chip))));
        let hands: Vec<Hand<f64>> = samples.map(|sample| sample.hand).collect();
        Ok(counter.count(&job(&case.scene, evolution, &hands), budget)?)
    };
    drags.iter().map(ride).collect()
}

/// The bounds for fractions of all steps, and the longest step.
fn steps_within(taken: &Taken) -> String {
    let within = taken.within.map(|part| thousands(part.into())).join(" / ");
    format!("{within}, {}", thousands(taken.most.into()))
}

/// Cycles per instruction, as text.
fn per_instruction(chip: Chip) -> String {
    match chip {
        Chip::CortexM0Plus => "counted".to_owned(),
        Chip::CortexM4F | Chip::CortexM33 | Chip::CortexM0 => chip.cycles().to_string(),
    }
}

struct Taken {
    steps: usize,
    mean: f64,
    most: u32,
    /// The instructions that a fraction of the steps, from [`PARTS`], does not exceed.
    within: [u32; PARTS.len()],
    /// Instructions per piece of work: on average, and at most in a step.
    unit: [f64; 2],
    behind: usize,
    /// The largest number of consecutive steps in which the body is behind.
    longest: usize,
    over: usize,
    /// The deepest stack of a step (bytes).
    stack: u32,
}

fn taken(drags: &[Counted], tick: f64) -> Taken {
    let steps = || drags.iter().flat_map(Counted::steps);
    let count = steps().count();
    let sum: f64 = steps().map(|step| f64::from(step.instructions)).sum();
    let work: f64 = steps().map(|step| f64::from(step.work)).sum();
    let mut sorted: Vec<u32> = steps().map(|step| step.instructions).collect();
    sorted.sort_unstable();
    let within = |percent: f64| {
        let last = (percent / 100.0 * count as f64).ceil() as usize;
        sorted.get(last.saturating_sub(1)).copied().unwrap_or(0)
    };
    let of_unit = |step: &Frame| f64::from(step.instructions) / f64::from(step.work);
    let most_of_unit = steps().map(of_unit).fold(0.0, f64::max);
    let is_behind = |step: &Frame| step.pose.status == Status::Behind;
    let runs = drags
        .iter()
        .flat_map(|drag| drag.steps().split(|step| !is_behind(step)));
    Taken {
        steps: count,
        mean: sum / count.max(1) as f64,
        most: sorted.last().copied().unwrap_or(0),
        within: PARTS.map(within),
        unit: [sum / work, most_of_unit],
        behind: steps().filter(|step| is_behind(step)).count(),
        longest: runs.map(<[Frame]>::len).max().unwrap_or(0),
        over: steps()
            .filter(|step| f64::from(step.instructions) > tick)
            .count(),
        stack: drags
            .iter()
            .map(|drag| drag.totals.stack)
            .max()
            .unwrap_or(0),
    }
}

fn row(chip: Chip, evolution: Evolution, drags: &[Case]) -> Result<[String; 15], Box<dyn Error>> {
    let tick = tick(chip);
    let free = taken(&counted(chip, (evolution, u32::MAX), drags)?, tick);
    let [mean, most] = free.unit;
    let budget = ((tick * PART / mean) as u32).max(1);
    let bound = taken(&counted(chip, (evolution, budget), drags)?, tick);
    eprintln!(
        "{} {}: mean {:.0}",
        chip.name(),
        evolution.name(),
        free.mean
    );
    let longest = bound.longest as f64 * 1000.0 / f64::from(rate(chip));
    let longest_step = chip.microseconds(f64::from(bound.most)) / 1000.0;
    Ok([
        chip.name().to_owned(),
        chip.megahertz().to_string(),
        rate(chip).to_string(),
        per_instruction(chip),
        evolution.name().to_owned(),
        format!("{mean:.0} / {most:.0}"),
        steps_within(&free),
        thousands(tick as u64),
        budget.to_string(),
        thousands(bound.steps as u64),
        bound.behind.to_string(),
        format!("{longest:.0}"),
        format!("{longest_step:.2}"),
        bound.over.to_string(),
        thousands(u64::from(free.stack)),
    ])
}

/// Measures so many drags.
///
/// # Errors
/// QEMU or a target is missing, or the document cannot be written.
pub fn budget(drags: usize, output: Destination) -> Result<(), Box<dyn Error>> {
    let drags: Vec<Case> = trade::drags().take(drags).collect::<Result<_, _>>()?;
    let mut table = Table::new(
        "chip | MHz: | tick (Hz): | cycles per instruction: | evolution | instructions per piece: | \
         without a budget: 50 / 99 / 99.9 / 99.99 % of the steps, longest: | of a tick: | budget (pieces): | steps: | behind: | \
         longest behind (ms): | longest step (ms): | steps over the tick: | deepest stack (bytes):",
    );
    for chip in Chip::ALL {
        for evolution in Evolution::ALL {
            table.row(row(chip, evolution, &drags)?);
        }
    }
    let text = format!(
        "Written by `cargo run --release -p stiction-lab -- budget --write`: {} random drags of 4 s through a solver of 8 vertices and\n\
         4 surfaces, on emulated chips. For the M0+, cycles are counted, with waits for the flash by a model of its cache. For the others, instructions are counted, and the cycles per\n\
         instruction are an estimated upper bound of the average. The cost of a piece of work is given in instructions (M0+: cycles): on\n\
         average / on average of the most expensive step. The budget is what fits into seven eighths of a tick at the first of these costs.\n\n{table}",
        drags.len()
    );
    Ok(output.put("host-sim/TRADE.md", "budget", &text)?)
}
