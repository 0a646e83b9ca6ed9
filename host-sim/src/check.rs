//! `stiction check`: tests whether a trace obeys every law, using only the scene, the trace and the hand's path; the judge knows
//! nothing of the solver.

mod hand;

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use stiction_core::Evolution;
use stiction_judge::{Bounds, InputError, Judge, STATUSES, Scene, Status, Survey, Trace};

use crate::input::source;
use crate::options::{evolution_parser, parse_rate};
use crate::report;
use crate::shell::scene_completer;
use stiction_live::number::Number;

/// The arguments of `stiction check`.
#[derive(Args, Clone, Debug)]
pub struct CheckArgs {
    /// Trace (jsonl, csv) of `stiction run`, or of any other program
    trace: PathBuf,
    /// Scene file (TOML) that the trace is of, or the name of a bundled scene
    #[arg(long, add = scene_completer())]
    scene: PathBuf,
    /// Number type of the solver: how exact the trace can be
    #[arg(long, value_enum, default_value_t = Number::F32)]
    number: Number,
    /// path: slips begin anywhere on the hand's straight line between two frames; frame: after the first event of a frame at
    /// its end
    #[arg(long, default_value = "path", value_parser = evolution_parser())]
    evolution: Evolution,
    /// Hand path (csv, tum, txt) that the trace's hand has to be, instead of the one in the scene file; none: it is not compared
    #[arg(long, value_name = "FILE")]
    hand: Option<PathBuf>,
    /// Place the path of --hand over the scene, as `run --fit` does
    #[arg(long, requires = "hand")]
    fit: bool,
    /// Hand frames per second of the trace; without it, the hand is compared at the times of the trace
    #[arg(long, value_name = "HZ", value_parser = parse_rate, allow_negative_numbers = true)]
    rate: Option<f64>,
    /// Number of the worst frames to list
    #[arg(long, value_name = "N", default_value_t = 10)]
    worst: usize,
    /// Print no report; the exit status says whether the trace is lawful
    #[arg(long)]
    quiet: bool,
}

/// The contents of a report in addition to the laws.
#[derive(Clone, Debug, Default)]
pub struct Remarks {
    /// Frames without all contacts.
    pub incomplete: u64,
    /// Number of frames for each status except `ok`.
    pub statuses: BTreeMap<Status, u64>,
    /// About the hand's path.
    pub hand: Option<String>,
}

impl Remarks {
    /// Adds a frame.
    pub fn add(&mut self, frame: &stiction_judge::Frame) {
        self.incomplete += u64::from(!frame.complete);
        if frame.status != Status::Ok {
            *self.statuses.entry(frame.status).or_default() += 1;
        }
    }
}

/// Judges a trace and prints a report; returns false if a frame breaks a law.
///
/// # Errors
/// Fails if scene, trace or the hand's path cannot be used, or the trace is empty.
pub fn check(args: &CheckArgs) -> Result<bool, Box<dyn Error>> {
    let scene = Scene::parse(source(&args.scene)?)?;
    let frames = Trace::open(&args.trace, &scene)?;
    let mut given = hand::given(args)?;
    let mut judged = judge(scene, args.number, args.evolution);
    let mut survey = Survey::new(args.worst);
    let mut notes = Remarks::default();
    for frame in frames {
        let (line, frame) = frame?;
        let t = frame.t;
        notes.add(&frame);
        let of_hand = given.as_mut().ok();
        let of_hand = of_hand.map(|given| given.finding(&frame, judged.bounds()));
        let mut findings = judged.next(frame);
        findings.extend(of_hand);
        survey.add(line, t, &findings);
    }
    if survey.frames == 0 {
        let problem = "there is no record in it, allowed: at least one";
        return Err(InputError::of_file(&args.trace, problem).into());
    }
    notes.hand = match given {
        Err(why) => Some(format!("the hand was not compared with a path: {why}")),
        Ok(given) => given.remark(),
    };
    if !args.quiet {
        report::print(&verdict(&survey, &notes));
    }
    Ok(survey.is_lawful())
}

/// A judge of the solver's results in a number type and an evolution.
pub fn judge(scene: Scene, number: Number, evolution: Evolution) -> Judge {
    let bounds = if number.is_single() {
        Bounds::SINGLE
    } else {
        Bounds::DOUBLE
    };
    Judge::new(scene, bounds, evolution)
}

/// The report: every law, the limits of frames, then the worst frames.
pub fn verdict(survey: &Survey, notes: &Remarks) -> String {
    let mut text = format!(
        "{} frames, {} unlawful\n\n  {:<45}{:>10}{:>10}{:>14}{:>10}\n",
        survey.frames, survey.unlawful, "law", "frames", "broken", "worst/allowed", "line"
    );
    // Writing to a string does not fail.
    for (name, law) in &survey.laws {
        let (worst, line) = law.worst;
        let (frames, broken, severity) = (law.frames, law.broken, worst.severity());
        let _ = writeln!(
            text,
            "  {name:<45}{frames:>10}{broken:>10}{severity:>14.2e}{line:>10}"
        );
    }
    if !notes.statuses.is_empty() {
        text.push_str("\nframes with a status\n");
    }
    for status in STATUSES {
        if let Some(frames) = notes.statuses.get(&status) {
            let _ = writeln!(text, "  {:<45}{frames:>10}", status.name());
        }
    }
    if let Some(hand) = &notes.hand {
        let _ = writeln!(text, "\n{hand}");
    }
    let incomplete = notes.incomplete;
    if incomplete > 0 {
        let _ = writeln!(
            text,
            "\n{incomplete} frames have more contacts than the columns of a CSV trace: their balance is not judged"
        );
    }
    if !survey.worst.is_empty() {
        text.push_str("\nworst frames\n");
    }
    for violation in &survey.worst {
        let finding = violation.finding;
        let _ = writeln!(
            text,
            "  line {}, t = {:?}: {}: {:.3e}, allowed {:.1e}",
            violation.line, violation.t, finding.law, finding.residual, finding.bound
        );
    }
    text
}
