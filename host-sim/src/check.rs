//! `stiction check`: whether a trace obeys every law, from nothing but the scene and the trace; the judge knows nothing of the
//! solver.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use stiction_core::Evolution;
use stiction_judge::{Bounds, InputError, Judge, Scene, Survey, Trace};

use crate::number::Number;
use crate::options::evolution_parser;
use crate::report;
use crate::scenes;

/// The arguments of `stiction check`.
#[derive(Args, Clone, Debug)]
pub struct CheckArgs {
    /// Trace (jsonl, csv) of `stiction run`, or of any other program
    trace: PathBuf,
    /// Scene file (TOML) that the trace is of, or the name of a bundled scene
    #[arg(long)]
    scene: PathBuf,
    /// Number type of the solver: how exact the trace can be
    #[arg(long, value_enum, default_value_t = Number::F32)]
    number: Number,
    /// path: slips begin anywhere on the hand's straight line between two frames; frame: after the first event of a frame at
    /// its end
    #[arg(long, default_value = "path", value_parser = evolution_parser())]
    evolution: Evolution,
    /// So many of the worst frames are listed
    #[arg(long, value_name = "N", default_value_t = 10)]
    worst: usize,
    /// No report: the exit status alone tells
    #[arg(long)]
    quiet: bool,
}

/// Judges a trace and prints a report; false where a frame breaks a law.
///
/// # Errors
/// Scene or trace cannot be used, or the trace is empty.
pub fn check(args: &CheckArgs) -> Result<bool, InputError> {
    let scene = open_scene(&args.scene)?;
    let frames = Trace::open(&args.trace, &scene)?;
    let mut judged = judge(scene, args.number, args.evolution);
    let mut survey = Survey::new(args.worst);
    let mut incomplete = 0;
    for frame in frames {
        let (line, frame) = frame?;
        let t = frame.t;
        incomplete += u64::from(!frame.complete);
        survey.add(line, t, &judged.next(frame));
    }
    if survey.frames == 0 {
        let problem = "there is no record in it, allowed: at least one";
        return Err(InputError::of_file(&args.trace, problem));
    }
    if !args.quiet {
        report::print(&verdict(&survey, incomplete));
    }
    Ok(survey.is_lawful())
}

/// A judge of what the solver gives in a number type and an evolution.
pub fn judge(scene: Scene, number: Number, evolution: Evolution) -> Judge {
    let bounds = if number.is_single() {
        Bounds::SINGLE
    } else {
        Bounds::DOUBLE
    };
    let evolution = match evolution {
        Evolution::Path => stiction_judge::Evolution::Path,
        Evolution::Frame => stiction_judge::Evolution::Frame,
    };
    Judge::new(scene, bounds, evolution)
}

/// A scene file, or the bundled scene of a name.
fn open_scene(name: &Path) -> Result<Scene, InputError> {
    if name.exists() {
        return Scene::read(name);
    }
    match scenes::find(name) {
        Some(source) => Scene::parse(source.file(), source.text()),
        None => Err(InputError::of_file(name, scenes::unknown())),
    }
}

/// The report: every law, then the worst frames.
pub fn verdict(survey: &Survey, incomplete: u64) -> String {
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
