//! How one solver fares where rounding decides: laws and statuses, level tops, mirror images, rates of the hand, frames cut into parts.

use crate::case::{Case, flip};
use crate::compare::slips;
use crate::families::Family;
use crate::lawful::Lawful;
use crate::subject::Solver;
use crate::tally::{Spread, Tally};
use std::ops::Range;
use stiction_judge::{Frame, Status};

/// What a measure found: a line of figures, and a line for each seed that is to blame for them.
pub(crate) struct Measured {
    /// The figures.
    pub(crate) line: String,
    /// The seeds that are to blame, in words.
    pub(crate) seeds: Vec<String>,
}

/// A measure of a solver on the seeds of a family.
pub(crate) type Measure = fn(&Family, Solver, Range<u64>) -> Measured;

/// Name, measure, what it is in words.
pub(crate) const MEASURES: [(&str, Measure, &str); 5] = [
    (
        "laws",
        laws,
        "frames with a status or with broken laws; runs that the judge refuses",
    ),
    (
        "tops",
        tops,
        "runs that are caught, flagged, or refused by the judge; those caught leave the twin over one half-plane",
    ),
    ("mirror", mirror, "runs whose mirror image moves otherwise"),
    (
        "rates",
        rates,
        "slips at eight rates of the hand from 20 to 3000 Hz",
    ),
    (
        "cut",
        cut,
        "runs that end otherwise if every frame is cut into seven",
    ),
];

/// A body that leaves its twin by this (L, rad) is caught: far above what tops that differ by a micrometre do to it.
const CAUGHT: f64 = 0.02;
/// The rates (Hz).
const RATES: [f64; 8] = [20.0, 50.0, 72.0, 90.0, 100.0, 144.0, 1000.0, 3000.0];
/// Parts of a frame.
const PARTS: usize = 7;

/// Whether a status other than `ok` and `jammed` limits the answer.
fn is_flagged(frame: &Frame) -> bool {
    !matches!(frame.status, Status::Ok | Status::Jammed)
}

/// The cases of the seeds.
fn cases(family: &Family, seeds: Range<u64>) -> impl Iterator<Item = (u64, Case)> {
    let case = family.case;
    seeds.map_while(move |seed| Some((seed, case(seed)?)))
}

fn laws(family: &Family, solver: Solver, seeds: Range<u64>) -> Measured {
    let [mut runs, mut frames, mut alone, mut refused, mut missing] = [0_u64; 5];
    let (mut statuses, mut broken, mut to_blame) = (Tally::default(), Tally::default(), Vec::new());
    for (seed, case) in cases(family, seeds) {
        let Ok(run) = solver.run(&case) else {
            missing += 1;
            continue;
        };
        let mut lawful = Lawful::new(&case, solver);
        let mut first = None;
        for (i, frame) in run.iter().enumerate() {
            if frame.status != Status::Ok {
                statuses.add(frame.status.name());
            }
            alone += u64::from(!lawful.alone(frame).is_empty());
            let findings = lawful.next(frame);
            if let Some(finding) = findings.first() {
                first = first.or(Some((i, finding.law)));
            }
        }
        runs += 1;
        frames += run.len() as u64;
        let flagged = run.iter().filter(|frame| is_flagged(frame)).count();
        if let Some((i, law)) = first {
            refused += 1;
            broken.add(law);
            to_blame.push(format!(
                "{seed}: frame {i}: {law}; frames with a status: {flagged}"
            ));
        } else if flagged > 0 {
            to_blame.push(format!("{seed}: frames with a status: {flagged}"));
        }
    }
    Measured {
        line: format!(
            "runs {runs} (not run {missing}), frames {frames}; statuses {statuses}; frames that break a law alone {alone}; \
             runs refused {refused}: {broken}"
        ),
        seeds: to_blame,
    }
}

fn tops(family: &Family, solver: Solver, seeds: Range<u64>) -> Measured {
    let [
        mut runs,
        mut caught,
        mut flagged,
        mut refused,
        mut missing,
        mut faulty,
    ] = [0_u64; 6];
    let mut to_blame = Vec::new();
    for (seed, case) in cases(family, seeds) {
        let Some(twin) = &case.twin else {
            continue;
        };
        let flat = Case::new(twin.clone(), case.hands.clone());
        let (Ok(run), Ok(flat)) = (solver.run(&case), solver.run(&flat)) else {
            missing += 1;
            continue;
        };
        let off = run
            .iter()
            .zip(&flat)
            .position(|(a, b)| case.apart(a.pose, b.pose) > CAUGHT);
        let flag = run.iter().position(is_flagged);
        let level = case.level.as_ref().unwrap_or(&case.among);
        let law = first_law(Lawful::new(&case, solver), &run)
            .and_then(|_| first_law(Lawful::in_scene(level, solver), &run));
        runs += 1;
        caught += u64::from(off.is_some());
        flagged += u64::from(flag.is_some());
        refused += u64::from(law.is_some());
        if off.is_some() || flag.is_some() || law.is_some() {
            faulty += 1;
            to_blame.push(format!(
                "{seed}: caught {off:?}, flagged {flag:?}, refused {law:?}"
            ));
        }
    }
    Measured {
        line: format!(
            "runs {runs} (not run {missing}): caught {caught}, flagged {flagged}, refused {refused}; any of these {faulty}"
        ),
        seeds: to_blame,
    }
}

/// The first frame of a run that breaks a law.
fn first_law(mut lawful: Lawful, run: &[Frame]) -> Option<(usize, &'static str)> {
    let broken = |(i, frame)| lawful.next(frame).first().map(|finding| (i, finding.law));
    run.iter().enumerate().find_map(broken)
}

fn mirror(family: &Family, solver: Solver, seeds: Range<u64>) -> Measured {
    let [mut runs, mut flagged, mut silent, mut missing] = [0_u64; 4];
    let (mut most, mut to_blame) = (Spread::default(), Vec::new());
    for (seed, case) in cases(family, seeds) {
        let (Ok(run), Ok(image)) = (solver.run(&case), solver.run(&case.mirrored())) else {
            missing += 1;
            continue;
        };
        runs += 1;
        let apart = |(a, b): (&Frame, &Frame)| case.apart(a.pose, flip(b.pose));
        let bound = solver.digits.equal();
        let off = run.iter().zip(&image).map(apart);
        most.add(off.clone().fold(0.0, f64::max));
        let Some(frame) = off.clone().position(|apart| apart > bound) else {
            continue;
        };
        let has_status = run.iter().chain(&image).any(is_flagged);
        flagged += u64::from(has_status);
        silent += u64::from(!has_status);
        let most = off.fold(0.0, f64::max);
        to_blame.push(format!(
            "{seed}: frame {frame}, up to {most:.1e}, status {has_status}"
        ));
    }
    Measured {
        line: format!(
            "runs {runs} (not run {missing}): differ without a status {silent}, with one {flagged}; largest distance of a run, \
             50 / 90 / 99 / 99.9 / 100 %: {most}"
        ),
        seeds: to_blame,
    }
}

fn rates(family: &Family, solver: Solver, seeds: Range<u64>) -> Measured {
    let [mut runs, mut uneven, mut missing] = [0_u64; 3];
    let mut lines = Vec::new();
    for (seed, case) in cases(family, seeds) {
        let slips = RATES.map(|rate| solver.run(&case.at(rate)).map(|run| slips(&run)));
        let Ok(counts) = slips.iter().cloned().collect::<Result<Vec<u64>, _>>() else {
            missing += 1;
            continue;
        };
        runs += 1;
        let mut sorted = counts.clone();
        sorted.sort_unstable();
        let (least, middle, most) = (sorted[0], sorted[4], sorted[7]);
        let is_even = (most - least) as f64 <= (0.02 * middle as f64).max(1.0);
        uneven += u64::from(!is_even);
        let remark = if is_even { "" } else { " uneven" };
        lines.push(format!("{seed}: {counts:?}{remark}"));
    }
    Measured {
        line: format!(
            "scenes {runs} (not run {missing}): slips not within 1 % of the middle one, or within one slip, at all of {RATES:?} Hz: {uneven}"
        ),
        seeds: lines,
    }
}

fn cut(family: &Family, solver: Solver, seeds: Range<u64>) -> Measured {
    let [mut runs, mut flagged, mut silent, mut at_end, mut missing] = [0_u64; 5];
    let (mut most, mut to_blame) = (Spread::default(), Vec::new());
    for (seed, case) in cases(family, seeds) {
        let (Ok(run), Ok(parts)) = (solver.run(&case), solver.run(&case.cut(PARTS))) else {
            missing += 1;
            continue;
        };
        runs += 1;
        let apart = |(a, b): (&Frame, &Frame)| case.apart(a.pose, b.pose);
        let off = run.iter().zip(parts.iter().step_by(PARTS)).map(apart);
        let bound = solver.digits.equal();
        let largest = off.clone().fold(0.0, f64::max);
        most.add(largest);
        let Some(frame) = off.clone().position(|apart| apart > bound) else {
            continue;
        };
        at_end += u64::from(off.clone().next_back().is_some_and(|apart| apart > bound));
        let has_status = run.iter().chain(&parts).any(is_flagged);
        flagged += u64::from(has_status);
        silent += u64::from(!has_status);
        to_blame.push(format!(
            "{seed}: frame {frame}, up to {largest:.1e}, status {has_status}"
        ));
    }
    Measured {
        line: format!(
            "runs {runs} (not run {missing}): differ without a status {silent}, with one {flagged}, still at the end {at_end}; largest distance of a run, \
             50 / 90 / 99 / 99.9 / 100 %: {most}"
        ),
        seeds: to_blame,
    }
}
